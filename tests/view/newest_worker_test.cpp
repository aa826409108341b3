// The thread that does the newest work of each kind.
#include "view/newest_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <string>
#include <thread>

namespace whittle::test {
namespace {

/// Holds a worker at its work until it is let go.
class Gate {
 public:
  std::function<void()> work() {
    return [this] {
      began_.set_value();
      open_.get_future().wait();
    };
  }
  void waitUntilBegun() { began_.get_future().wait(); }
  void open() { open_.set_value(); }

 private:
  std::promise<void> began_, open_;
};

TEST(NewestWorker, DoesTheNewestOfEachKindInTheirOrder) {
  Gate gate;
  std::string done;  // the worker's alone until `last` is there
  std::promise<void> last;
  view::NewestWorker worker(2);
  worker.give(gate.work(), 1);
  gate.waitUntilBegun();
  EXPECT_FALSE(worker.hasNewer());
  for (const char letter : {'a', 'b', 'c'})
    worker.give(
        [&done, &last, letter] {
          done += letter;
          last.set_value();
        },
        1);
  for (const char letter : {'1', '2'}) worker.give([&done, letter] { done += letter; }, 0);
  EXPECT_TRUE(worker.hasNewer());
  gate.open();
  last.get_future().wait();
  EXPECT_EQ(done, "2c");
}

TEST(NewestWorker, ClosingTellsWhatIsUnderWay) {
  std::atomic<bool> sawClosing{false};
  {
    std::promise<void> begun;
    view::NewestWorker worker;
    worker.give([&] {
      begun.set_value();
      while (!worker.hasNewer()) std::this_thread::yield();
      sawClosing = true;
    });
    begun.get_future().wait();
  }
  EXPECT_TRUE(sawClosing);
}

}  // namespace
}  // namespace whittle::test
