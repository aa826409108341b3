// How much memory a run may take, and the sums that are held against it before anything is taken. Costs are
// those of the process: what a thing takes on this side and, on a CPU device, on the other.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace whittle {

/// The most that a process may take, and who says so.
struct MemoryLimit {
  std::uint64_t bytes = 0;
  bool isChosen = false;  ///< by --memory-limit; otherwise what the machine has
  bool isUlimit = false;  ///< less than that: what `ulimit` leaves the process
};

/// What a process takes before it has read a scene: the program, the drivers, a compiled kernel or two.
inline constexpr std::uint64_t kProgramBytes = 90'000'000;

class MemoryBudget {
 public:
  /// Who wants the memory. What a file asks for is bound by the file's own size as well, so that a small one
  /// cannot fill a large machine; what the command line asks for is not.
  enum class Cause : std::uint8_t { File, CommandLine };

  explicit MemoryBudget(const MemoryLimit& limit) : limit_(limit), held_(kProgramBytes), peak_(held_) {}

  /// Throws InputError, one line with the numbers, where `bytes` more are too much. `what` takes them: a
  /// plural, for instance "its 40 images, 168 megapixels in all,".
  void hold(std::uint64_t bytes, std::string_view what);
  /// The same for what is taken and given back before anything else is held.
  void pass(std::uint64_t bytes, std::string_view what);
  /// Of this process, whatever it is given: `bytes` beside kProgramBytes.
  void promiseProgram(std::uint64_t bytes);
  /// The same for what will be taken once everything is loaded, beside all that is held then.
  void promise(std::uint64_t bytes, std::string_view what, Cause cause = Cause::File);
  /// Throws InputError where a file without --memory-limit asks for that many values to be read, again and
  /// again the same mostly: a small one shall not take long either.
  void checkReads(double values, std::string_view what) const;
  /// Bytes of a file that is read: they raise what the scene may take.
  void sawFile(std::uint64_t bytes) { fileBytes_ += bytes; }

  /// The most that was held or passed at once.
  std::uint64_t peak() const { return peak_; }

 private:
  void check(std::uint64_t before, std::uint64_t bytes, std::string_view what, Cause cause) const;
  std::uint64_t most(Cause cause) const;

  MemoryLimit limit_;
  std::uint64_t held_;
  std::uint64_t promised_ = 0;
  std::uint64_t commandLine_ = 0;  ///< of `promised_`
  std::uint64_t fileBytes_ = 0;
  std::uint64_t peak_;
};

}  // namespace whittle
