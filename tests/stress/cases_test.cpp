// Does every extreme case get the answer it must, and without a floating-point exception on the way?
#include "cases.hpp"

#include <gtest/gtest.h>

#include "support/float_traps.hpp"

namespace gnomon::stress {

void PrintTo(const ExtremeCase& extreme, std::ostream* out) {
  *out << extreme.input;
}

namespace {

class ExtremeCases : public testing::TestWithParam<ExtremeCase> {};

TEST_P(ExtremeCases, holds) {
  Check check;
  GetParam().run(check);
  // A build without the renderer has no filters to feed.
  if (check.skipped()) GTEST_SKIP() << check.found();
  EXPECT_TRUE(check.passed()) << check.found();
  EXPECT_GT(check.checks(), 0);
}

class FiniteCases : public testing::TestWithParam<ExtremeCase> {};

TEST_P(FiniteCases, raise_no_floating_point_exception) {
  EXPECT_TRUE(test::runs_without_trap([&] {
    Check check;
    GetParam().run(check);
  }));
}

std::string name_of(const testing::TestParamInfo<ExtremeCase>& info) {
  return "row_" + std::to_string(info.param.row) + "_" + std::string(info.param.name);
}
INSTANTIATE_TEST_SUITE_P(All, ExtremeCases, testing::ValuesIn(all_cases().begin(), all_cases().end()),
                         name_of);

std::vector<ExtremeCase> finite_cases() {
  std::vector<ExtremeCase> cases;
  for (const ExtremeCase& extreme : all_cases()) {
    if (extreme.finite_input) cases.push_back(extreme);
  }
  return cases;
}
INSTANTIATE_TEST_SUITE_P(All, FiniteCases, testing::ValuesIn(finite_cases()), name_of);

TEST(Cases, most_feed_numbers_alone) {
  EXPECT_EQ(finite_cases().size(), 27u);
}

TEST(Cases, are_32_in_order) {
  ASSERT_EQ(all_cases().size(), 32u);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(all_cases()[i].row, static_cast<int>(i) + 1);
}

TEST(Cases, one_that_fails_says_what_and_stays_failed) {
  const ExtremeCase wrong{0, "wrong", "", "", [](Check& check) {
                            check.that(1 + 1 == 2, "sums");
                            for (const int sum : {3, 4}) check.that(1 + 1 == sum, "sums of another kind");
                            check.note("found", 2.0);
                          }};
  const CaseRow row = run_case(wrong);
  EXPECT_EQ(row.verdict, "fails");
  EXPECT_EQ(row.found, "not so: sums of another kind (found 2)");
  const ExtremeCase absent{0, "absent", "", "", [](Check& check) { check.skip("not built"); }};
  EXPECT_EQ(run_case(absent).verdict, "skipped");
}

}  // namespace
}  // namespace gnomon::stress
