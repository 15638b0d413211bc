// Does every omission say in words what was left out and why?
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>

#include "gnomon/plan.hpp"

namespace gnomon::test {
namespace {

constexpr OmissionKind kKinds[] = {
    OmissionKind::cascade_without_receiver, OmissionKind::cascade_without_caster,
    OmissionKind::depth_without_receiver,   OmissionKind::depth_not_visible,
    OmissionKind::warp_without_gain,        OmissionKind::warp_in_stable_fit,
    OmissionKind::part_without_caster,      OmissionKind::partition_without_gain,
    OmissionKind::partition_in_stable_fit,  OmissionKind::face_without_receiver,
    OmissionKind::face_without_caster,      OmissionKind::resolution_without_gain,
    OmissionKind::depth_near_light,         OmissionKind::option_ignored,
    OmissionKind::view_without_receiver,    OmissionKind::pages_coarsened,
    OmissionKind::points_left_coarser,      OmissionKind::points_beyond_levels,
    OmissionKind::shape_without_gain,       OmissionKind::plane_without_receiver,
    OmissionKind::plane_without_caster,     OmissionKind::cascade_on_planes,
    OmissionKind::faces_less_divided,       OmissionKind::receiver_near_light,
    OmissionKind::cascade_without_gain};

TEST(Omission, the_list_above_holds_every_kind) {
  for (std::size_t i = 0; i < std::size(kKinds); ++i) EXPECT_EQ(static_cast<std::size_t>(kKinds[i]), i);
  // A kind beyond the last has no words: one that is added without a place in the list would have some.
  const OmissionText beyond = describe({static_cast<OmissionKind>(std::size(kKinds)), 1, 2.0, 3.0, 0});
  EXPECT_STREQ(beyond.what.data(), "");
}

TEST(Omission, every_kind_has_words_that_end_within_their_arrays) {
  for (const OmissionKind kind : kKinds) {
    // The longest numbers there are.
    const OmissionText text = describe({kind, 2147483647, -1.2345678e-300, 1.2345678e300, 0});
    for (const auto& [begin, size] :
         {std::pair{text.what.data(), text.what.size()}, std::pair{text.why.data(), text.why.size()}}) {
      const std::size_t length = strnlen(begin, size);
      EXPECT_GT(length, 3u) << static_cast<int>(kind);
      EXPECT_LT(length, size) << static_cast<int>(kind);
    }
  }
}

TEST(Omission, an_option_that_is_none_has_no_words) {
  for (const double option : {-1.0, 1e300, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_STREQ(describe({OmissionKind::option_ignored, -1, option, 0.0, 0}).what.data(), "") << option;
}

// "the objective with it is inf of the objective without".
TEST(Omission, a_ratio_without_bound_has_words_and_no_number) {
  for (const OmissionKind kind : {OmissionKind::warp_without_gain, OmissionKind::partition_without_gain,
                                  OmissionKind::shape_without_gain}) {
    for (const double ratio :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      const std::string why = describe({kind, 1, ratio, 0.0, 0}).why.data();
      EXPECT_EQ(why.find("inf"), std::string::npos) << why;
      EXPECT_EQ(why.find("nan"), std::string::npos) << why;
      EXPECT_NE(why.find("no bound"), std::string::npos) << why;
    }
  }
}

TEST(Omission, a_cascade_is_named_by_its_number_and_depths) {
  const OmissionText text = describe({OmissionKind::cascade_without_receiver, 3, 120.0, 500.0, 1048576});
  EXPECT_STREQ(text.what.data(), "cascade 3");
  const std::string why = text.why.data();
  EXPECT_NE(why.find("120"), std::string::npos) << why;
  EXPECT_NE(why.find("500"), std::string::npos) << why;
  EXPECT_NE(why.find("receiver"), std::string::npos) << why;
}

TEST(Omission, no_two_kinds_read_the_same) {
  for (const OmissionKind a : kKinds) {
    for (const OmissionKind b : kKinds) {
      if (a == b) continue;
      EXPECT_STRNE(describe({a, 1, 2.0, 3.0, 0}).why.data(), describe({b, 1, 2.0, 3.0, 0}).why.data());
    }
  }
}

TEST(Omission, statuses_have_names_of_their_own) {
  EXPECT_EQ(to_string(PlanStatus::ok), "ok");
  EXPECT_EQ(to_string(PlanStatus::nothing_visible), "nothing_visible");
  EXPECT_EQ(to_string(PlanStatus::no_caster), "no_caster");
  EXPECT_EQ(to_string(PlanStatus::invalid_input), "invalid_input");
}

}  // namespace
}  // namespace gnomon::test
