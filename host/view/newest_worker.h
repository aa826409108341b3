// A thread of its own that does what it is given: of each kind only the newest, kinds in their order. Whoever
// gives it work never waits.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace whittle::view {

class NewestWorker {
 public:
  /// Of `kinds` kinds of work, the first kind before the others.
  explicit NewestWorker(std::size_t kinds = 1);
  /// Waits for the work that is under way; what has not begun is dropped.
  ~NewestWorker();
  NewestWorker(const NewestWorker&) = delete;
  NewestWorker& operator=(const NewestWorker&) = delete;

  /// In the place of any of the same kind that has not begun. It must not throw.
  void give(std::function<void()> work, std::size_t kind = 0);
  /// Whether work waits, or the worker is being closed: what is under way may end early.
  bool hasNewer() const;

 private:
  void loop();
  std::function<void()>* firstWaiting();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::function<void()>> waiting_;  ///< [kind] empty: nothing
  bool isClosing_ = false;
  std::thread thread_;  ///< last: it uses all of the above
};

}  // namespace whittle::view
