// main() of every test program. ctest runs all cases of a file in one process (cmake/gtest_files.cmake), so
// what ctest did for each case is done here: a time limit of its own, and statuses of their own for a run in
// which every case was skipped and for one without any case.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/// A sanitizer makes everything slower: WHITTLE_SLOWER says by how much.
constexpr unsigned kCaseSeconds = 600 * WHITTLE_SLOWER;
constexpr int kSkipped = 77;  ///< SKIP_RETURN_CODE of the entries

std::array<char, 512> timeoutText;  ///< made before the case starts: a signal handler may only write

void onAlarm(int /*signal*/) {
  [[maybe_unused]] const auto written =
      ::write(STDOUT_FILENO, timeoutText.data(), std::strlen(timeoutText.data()));
  ::_exit(1);
}

class TimeLimit : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& info) override {
    const std::string text = std::string("\n[  FAILED  ] ") + info.test_suite_name() + "." + info.name() +
                             ": still running after " + std::to_string(kCaseSeconds) + " s\n";
    timeoutText.fill('\0');
    text.copy(timeoutText.data(), timeoutText.size() - 1);
    ::alarm(kCaseSeconds);
  }
  void OnTestEnd(const testing::TestInfo& /*info*/) override { ::alarm(0); }
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::signal(SIGALRM, onAlarm);
  // What users have compiled is not what the tests are about.
  ::setenv("WHITTLE_CACHE_DIR", "/nonexistent/whittle", 0);
  auto& tests = *testing::UnitTest::GetInstance();
  tests.listeners().Append(new TimeLimit);  // gtest deletes it
  const int status = RUN_ALL_TESTS();
  if (status != 0 || testing::GTEST_FLAG(list_tests)) return status;
  if (tests.test_to_run_count() == 0) {
    std::puts("[  FAILED  ] no case of that name");
    return 1;
  }
  return tests.skipped_test_count() == tests.test_to_run_count() ? kSkipped : 0;
}
