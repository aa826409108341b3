// The programs that stay compiled on a device. Whoever moves settings about for hours would otherwise fill
// the memory with programs that nothing asks for again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <string>
#include <utility>

#include "cl/program.h"

namespace whittle {

/// Those used last. What drops out is let go by name alone: whoever holds the program may go on with it.
class KeptPrograms {
 public:
  explicit KeptPrograms(std::size_t most = kMost) : most_(most) {}

  /// Null: it isn't there. What is found is the one used last.
  const cl::Program* find(const std::string& key);
  /// In the place of the one that was used longest ago, where there are `most`.
  void keep(const std::string& key, const cl::Program& program);
  /// All that were ever kept.
  std::uint64_t total() const { return total_; }
  std::size_t size() const { return programs_.size(); }

 private:
  /// A render has three; switching five settings on and off in every way came to 30 on PoCL 3.1, which takes
  /// 4 MB for each.
  static constexpr std::size_t kMost = 32;

  std::size_t most_;
  std::uint64_t total_ = 0;
  std::list<std::pair<std::string, cl::Program>> programs_;  ///< the one used last comes first
};

}  // namespace whittle
