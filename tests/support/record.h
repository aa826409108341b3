// Rows of the table of numerical cases (experiments/run e10): what a check of a case expected, what
// came out, how far off it was, how far it may be. A row is a property of its test in gtest's
// report, as JSON.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

namespace whittle::test {

/// One check. Numbers as text are for people; `error` and `limit` are what passes or fails.
struct CaseRow {
  std::string id;            ///< "14": of the numbered cases; "O3": one of our own
  std::string construction;  ///< scene or rays
  std::string expectation;   ///< and where it comes from
  std::string result;
  double error = 0;
  std::string unit;  ///< of error and limit: "relative", "ulp", "rays", …
  double limit = 0;
};

inline std::string rowText(const CaseRow& r, const std::string& verdict) {
  const auto number = [](double v) { return fmt::format("{:.3g}", v); };
  return nlohmann::ordered_json{{"case", r.id},
                                {"construction", r.construction},
                                {"expectation", r.expectation},
                                {"result", r.result},
                                {"error", number(r.error)},
                                {"unit", r.unit},
                                {"limit", number(r.limit)},
                                {"verdict", verdict}}
      .dump();
}

/// Adds a row to the running test's report.
inline void report(const CaseRow& row, const std::string& verdict) {
  const auto& result = *::testing::UnitTest::GetInstance()->current_test_info()->result();
  ::testing::Test::RecordProperty(fmt::format("row_{:03}", result.test_property_count()),
                                  rowText(row, verdict));
}

/// Passes if the error is a number of at most the limit, and fails the running test otherwise.
inline void record(const CaseRow& row) {
  const bool passes = row.error <= row.limit;
  report(row, passes ? "pass" : "FAIL");
  EXPECT_TRUE(passes) << "case " << row.id << ", " << row.construction << ": " << row.expectation
                      << ", found " << row.result << "; error " << row.error << " " << row.unit << ", limit "
                      << row.limit;
}

/// A boundary that is known and measured: what lies beyond it is wrong and documented so.
inline void recordKnownLimit(const CaseRow& row) { report(row, "known limit"); }

/// Rows whose checks stand elsewhere in the running test: how many of `of` things were wrong, 0 allowed.
inline void recordCount(const std::string& id, const std::string& construction,
                        const std::string& expectation, std::size_t wrong, std::size_t of,
                        const std::string& unit) {
  record({id, construction, expectation, fmt::format("{} of {} {} wrong", wrong, of, unit),
          static_cast<double>(wrong), unit, 0});
}

/// The largest error of a series; NaN counts as infinite, and so does a series of nothing.
class Worst {
 public:
  void absolute(double found, double expected) { add(std::abs(found - expected), found, expected); }
  void relative(double found, double expected) {
    const double off = found == expected ? 0.0 : std::abs(found - expected) / std::abs(expected);
    add(off, found, expected);
  }
  double error() const { return count_ > 0 ? error_ : INFINITY; }
  /// Where it was worst.
  std::string result() const {
    return fmt::format("{:.7g} for {:.7g} of {} values", found_, expected_, count_);
  }
  std::size_t count() const { return count_; }

 private:
  void add(double off, double found, double expected) {
    ++count_;
    if (std::isnan(off)) off = INFINITY;
    if (off < error_) return;
    error_ = off, found_ = found, expected_ = expected;
  }

  double error_ = 0, found_ = 0, expected_ = 0;
  std::size_t count_ = 0;
};

/// Cases that take minutes run whole in the experiment, and shortened in the suite.
inline bool longCases() {
  const char* asked = std::getenv("WHITTLE_LONG_CASES");
  return asked && std::string(asked) == "1";
}

}  // namespace whittle::test
