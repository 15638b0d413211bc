// How a law runs over random input: RapidCheck with a number of cases that the law chooses, the same each
// run.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>

namespace gnomon::test {

/// Which share of the inputs of laws that draw many this run draws: 1, or with GNOMON_DRAWS=N in the environment an Nth.
/// `./dev test` draws a quarter, `./dev check` all.
[[nodiscard]] inline int draws_divisor() {
  const char* const divisor = std::getenv("GNOMON_DRAWS");
  return divisor == nullptr ? 1 : std::max(1, std::atoi(divisor));
}
/// How many inputs a law with `cases` of them draws in this run.
[[nodiscard]] inline int draws(int cases) {
  constexpr int kMany = 1000;
  return cases < kMany ? cases : cases / draws_divisor();
}
/// What a count comes to at least in this run that comes to `all` where all inputs are drawn: so no law holds by
/// looking at nothing.
[[nodiscard]] inline std::uint64_t of_all_draws(std::uint64_t all) {
  return all / static_cast<std::uint64_t>(draws_divisor());
}

/// Whether RapidCheck's RC_PARAMS or GNOMON_LAW_SEED, which a program may change between two laws, chose a seed in place
/// of the suite's own.
[[nodiscard]] inline bool seed_is_given() {
  return std::getenv("RC_PARAMS") != nullptr || std::getenv("GNOMON_LAW_SEED") != nullptr;
}

/// Runs `property` on `cases` random inputs and fails the current test with the smallest input that breaks
/// it. The seed is fixed, so that a red build is red again on the next machine; RC_PARAMS="seed=..." draws
/// other input.
template <typename Property>
void for_all(int cases, Property&& property) {
  constexpr std::uint64_t kSeed = 20110523;
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  const char* const seed = std::getenv("GNOMON_LAW_SEED");
  if (std::getenv("RC_PARAMS") == nullptr) params.seed = seed != nullptr ? std::strtoull(seed, nullptr, 10) : kSeed;
  params.maxSuccess = draws(cases);
  rc::detail::TestMetadata metadata;
  metadata.id = metadata.description = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto result = rc::detail::checkTestable(std::forward<Property>(property), metadata, params);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  ADD_FAILURE() << text.str();
}

/// Fails the property with what the numbers were.
template <typename... Parts>
void require(bool holds, const Parts&... parts) {
  if (holds) return;
  std::ostringstream text;
  text.precision(17);
  ((text << parts << ' '), ...);
  RC_FAIL(text.str());
}

/// In [0, 1), shrinking to 0; the whole range from the first case on.
[[nodiscard]] inline double unit() {
  constexpr int kSteps = 1 << 28;
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, kSteps)) / static_cast<double>(kSteps);
}
[[nodiscard]] inline double between(double low, double high) {
  return low + (high - low) * unit();
}
/// One of 0 ... count - 1.
[[nodiscard]] inline int pick(int count) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, count));
}
[[nodiscard]] inline bool chance(double share) {
  return unit() > 1.0 - share;
}

}  // namespace gnomon::test
