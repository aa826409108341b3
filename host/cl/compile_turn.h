// Processes that want the same kernels at once compile them once.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace whittle {

/// Of several processes that want the same kernels, one compiles, and the others wait until they find its
/// work on disk: twenty compilers side by side take twenty times as long as one.
class CompileTurn {
 public:
  /// Waits while another process has the turn for `key`. Where PoCL keeps nothing on disk, or on a file
  /// system without locks, nobody waits. The wait ends with the other process, however that one ends.
  explicit CompileTurn(const std::string& key);
  /// The same of a folder other than PoCL's, by a file there.
  CompileTurn(const std::string& key, const std::filesystem::path& folder);
  ~CompileTurn();
  CompileTurn(const CompileTurn&) = delete;
  CompileTurn& operator=(const CompileTurn&) = delete;

  /// False: another process has compiled meanwhile, and what it made is on disk.
  bool isMine() const { return mine_; }
  /// The kernels are on disk. A turn that ends without this is taken by one of those who wait.
  void done();

 private:
  unsigned char timesDone() const;

  int file_ = -1;
  off_t slot_ = 0;
  bool mine_ = false;
};

}  // namespace whittle
