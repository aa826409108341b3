// See newest_worker.h.
#include "view/newest_worker.h"

#include <algorithm>
#include <utility>

namespace whittle::view {

NewestWorker::NewestWorker(std::size_t kinds) : waiting_(kinds), thread_([this] { loop(); }) {}

NewestWorker::~NewestWorker() {
  {
    const std::lock_guard lock(mutex_);
    isClosing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void NewestWorker::give(std::function<void()> work, std::size_t kind) {
  {
    const std::lock_guard lock(mutex_);
    waiting_[kind] = std::move(work);
  }
  changed_.notify_all();
}

/// Null: none. The lock is held.
std::function<void()>* NewestWorker::firstWaiting() {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [](const auto& w) { return bool(w); });
  return found == waiting_.end() ? nullptr : &*found;
}

bool NewestWorker::hasNewer() const {
  const std::lock_guard lock(mutex_);
  return isClosing_ || std::any_of(waiting_.begin(), waiting_.end(), [](const auto& w) { return bool(w); });
}

void NewestWorker::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return isClosing_ || firstWaiting(); });
    if (isClosing_) return;
    std::function<void()> work = std::exchange(*firstWaiting(), nullptr);
    lock.unlock();
    work();
    work = nullptr;  // what it holds is let go here, not under the lock
    lock.lock();
  }
}

}  // namespace whittle::view
