// Sums are refused before they are taken, with the numbers.
#include "scene/memory_budget.h"

#include <gtest/gtest.h>

#include "scene/byte_counts.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

std::string refusal(MemoryBudget& budget, std::uint64_t bytes,
                    MemoryBudget::Cause cause = MemoryBudget::Cause::File) {
  try {
    cause == MemoryBudget::Cause::File ? budget.hold(bytes, "its images")
                                       : budget.promise(bytes, "its images", cause);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(MemoryBudget, SumsCountNotParts) {
  MemoryBudget budget({kProgramBytes + 1000, true});
  EXPECT_EQ(refusal(budget, 600), "");
  EXPECT_NE(refusal(budget, 600), "") << "the second of two halves";
  EXPECT_EQ(refusal(budget, 400), "");
  EXPECT_NE(refusal(budget, 1), "");
  EXPECT_EQ(budget.peak(), kProgramBytes + 1000);
}

TEST(MemoryBudget, WhatPassesIsNotHeld) {
  MemoryBudget budget({kProgramBytes + 1000, true});
  budget.pass(900, "a moment");
  budget.pass(900, "another");
  EXPECT_EQ(budget.peak(), kProgramBytes + 900);
  EXPECT_THROW(budget.pass(1001, "too much"), InputError);
}

TEST(MemoryBudget, WhatIsPromisedComesOnTopOfWhatIsHeldNotOfWhatPasses) {
  MemoryBudget budget({kProgramBytes + 1000, true});
  budget.promise(900, "a film");
  EXPECT_EQ(budget.peak(), kProgramBytes);
  budget.pass(900, "a moment");
  EXPECT_EQ(refusal(budget, 100), "");
  EXPECT_NE(refusal(budget, 1), "");
  EXPECT_THROW(budget.promise(1, "more"), InputError);
}

TEST(MemoryBudget, NumbersThatLookAlikeAreSaidInFull) {
  MemoryBudget budget({500'000'000, true});
  EXPECT_NE(refusal(budget, 410'000'001).find("500000001 bytes with all else; the limit is 500000000 bytes"),
            std::string::npos);
}

TEST(MemoryBudget, TheRefusalHasTheNumbersAndTheWayOut) {
  MemoryBudget budget({500'000'000, true});
  budget.hold(10'000'000, "its text");
  EXPECT_EQ(
      refusal(budget, 671'000'000),
      "its images would take 671 MB, 771 MB with all else; the limit is 500 MB: a larger --memory-limit "
      "allows more");
}

TEST(MemoryBudget, NoSumIsTooLargeToBeRefused) {
  MemoryBudget budget({1ULL << 60, true});
  EXPECT_NE(refusal(budget, ~0ULL), "");
  EXPECT_NE(refusal(budget, ~0ULL - 1), "");
}

TEST(MemoryBudget, ASmallFileCannotFillALargeMachine) {
  constexpr std::uint64_t kMachine = 1'000'000'000'000;
  MemoryBudget budget({kMachine, false});
  budget.sawFile(2'000'000);
  const std::string text = refusal(budget, 10'000'000'000);
  EXPECT_NE(text.find("the limit is 4.51 GB for input of 2 MB: --memory-limit SIZE allows more"),
            std::string::npos)
      << text;
  EXPECT_EQ(refusal(budget, 10'000'000'000, MemoryBudget::Cause::CommandLine), "")
      << "that is the user's own";
  EXPECT_EQ(refusal(budget, 4'000'000'000), "") << "and takes nothing away from the file";
  budget.sawFile(100'000'000);
  EXPECT_EQ(refusal(budget, 10'000'000'000), "") << "a large file may ask for more";
}

TEST(MemoryBudget, WhatIsChosenIsTheOnlyLimit) {
  MemoryBudget budget({1'000'000'000'000, true});
  EXPECT_EQ(refusal(budget, 10'000'000'000), "");
}

TEST(ByteCounts, AreReadAsPeopleWriteThem) {
  EXPECT_EQ(parseBytes("800000"), 800'000U);
  EXPECT_EQ(parseBytes("500M"), 500'000'000U);
  EXPECT_EQ(parseBytes("500MB"), 500'000'000U);
  EXPECT_EQ(parseBytes("4g"), 4'000'000'000U);
  EXPECT_EQ(parseBytes("1.5 GB"), 1'500'000'000U);
  EXPECT_EQ(parseBytes("2GiB"), 2ULL << 30);
  EXPECT_EQ(parseBytes("512Ki"), 512U << 10);
  EXPECT_EQ(parseBytes("12kB"), 12'000U);
  for (const char* text : {"", "M", "-1G", "0", "nan", "inf", "1e9", "4 parsecs", "4GG", "4Gi B", "1,5G",
                           " 4G", "4G ", "99999999999T", "0x10"})
    EXPECT_EQ(parseBytes(text), std::nullopt) << text;
}

TEST(ByteCounts, AreWrittenWithThreeDigits) {
  EXPECT_EQ(formatBytes(0), "0 B");
  EXPECT_EQ(formatBytes(999), "999 B");
  EXPECT_EQ(formatBytes(12'500'000), "12.5 MB");
  EXPECT_EQ(formatBytes(2'000'000'000), "2 GB");
}

}  // namespace
}  // namespace whittle
