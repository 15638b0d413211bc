// The viewer's pictures of a small scene, for tests that look at them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "gnomon/scene/load.hpp"
#include "render/shared_context.hpp"
#include "stage.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

inline constexpr int kWidth = 160, kHeight = 90;

/// The hangar: small, and thin shadows everywhere.
inline Stage& stage() {
  static Stage* const hangar = new Stage(load("builtin:hangar", LoadLimits{}.triangles));
  return *hangar;
}

inline State hangar() {
  State state;
  state.scene = "builtin:hangar";
  state.a.plan.resolution.max_size = state.b.plan.resolution.max_size = 256;
  return state;
}

inline Image picture(const State& state) {
  EXPECT_EQ(stage().draw(state, kWidth, kHeight, true), "");
  if (stage().truth_progress()) {
    stage().finish_truth();
    EXPECT_EQ(stage().draw(state, kWidth, kHeight, true), "");
  }
  return stage().canvas().image();
}

inline double share_equal(const Image& a, const Image& b, int begin, int end) {
  std::size_t equal = 0, all = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = begin; x < end; ++x, ++all) {
      const auto at =
          4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x));
      equal += std::equal(&a.rgba[at], &a.rgba[at] + 3, &b.rgba[at]) ? 1 : 0;
    }
  }
  return static_cast<double>(equal) / static_cast<double>(std::max<std::size_t>(all, 1));
}

}  // namespace gnomon::tool::view
