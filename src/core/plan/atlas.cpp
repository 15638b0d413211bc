// One texture for all maps of a plan.
// Based on: Jylanki, "A Thousand Ways to Pack the Bin", 2010 (skyline, bottom-left).
#include "gnomon/atlas.hpp"

#include <algorithm>

namespace gnomon {
namespace {

/// The upper rim of what is placed: steps from left to right.
class Skyline {
 public:
  explicit Skyline(int width) noexcept : step_{{{0, width, 0}}} {}

  /// Lowest place for a rectangle, the leftmost of equals; y is -1 where it is too wide.
  [[nodiscard]] TexelRect lowest_place(int width, int height) const noexcept {
    TexelRect best{0, -1, width, height};
    for (int i = 0; i < count_; ++i) {
      const int y = rest_on(i, width);
      if (y >= 0 && (best.y < 0 || y < best.y)) best = {at(i).x, y, width, height};
    }
    return best;
  }

  void raise(const TexelRect& placed) noexcept {
    Skyline next(0);
    next.count_ = 0;
    const int left = placed.x, right = placed.x + placed.width;
    for (int i = 0; i < count_; ++i) {
      const Step s = at(i);
      const int end = s.x + s.width;
      if (s.x < left) next.add({s.x, std::min(end, left) - s.x, s.y});
      if (s.x <= left && left < end) next.add({left, placed.width, placed.y + placed.height});
      if (end > right) next.add({std::max(s.x, right), end - std::max(s.x, right), s.y});
    }
    *this = next;
  }

 private:
  struct Step {
    int x, width, y;
  };
  [[nodiscard]] const Step& at(int i) const noexcept { return step_[static_cast<std::size_t>(i)]; }
  void add(const Step& step) noexcept {
    if (step.width > 0) step_[static_cast<std::size_t>(count_++)] = step;
  }
  /// Where a rectangle that begins at step i comes to rest; -1 where it leaves the texture.
  [[nodiscard]] int rest_on(int i, int width) const noexcept {
    int y = 0;
    for (; i < count_ && width > 0; ++i) {
      y = std::max(y, at(i).y);
      width -= at(i).width;
    }
    return width > 0 ? -1 : y;
  }

  // Each map adds at most two steps.
  std::array<Step, 2 * kMaxMaps + 2> step_;
  int count_ = 1;
};

std::int64_t texels_of(const ShadowPlan& plan) noexcept {
  std::int64_t texels = 0;
  for (const ShadowMap& map : plan.maps()) texels += std::int64_t{map.width} * map.height;
  return texels;
}

}  // namespace

Atlas pack_atlas(const ShadowPlan& plan, int width, int height) noexcept {
  std::array<int, kMaxMaps> order{};
  const auto count = static_cast<std::size_t>(plan.map_count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<int>(i);
  const auto map = [&](int i) -> const ShadowMap& { return plan.map[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.begin() + plan.map_count, [&](int a, int b) {
    if (map(a).height != map(b).height) return map(a).height > map(b).height;
    return map(a).width != map(b).width ? map(a).width > map(b).width : a < b;
  });
  Atlas atlas;
  Skyline skyline(width);
  for (std::size_t i = 0; i < count; ++i) {
    const TexelRect place = skyline.lowest_place(map(order[i]).width, map(order[i]).height);
    if (place.y < 0 || place.y + place.height > height) return {};
    skyline.raise(place);
    atlas.place[static_cast<std::size_t>(order[i])] = place;
  }
  if (count == 0) return atlas;
  atlas.width = width;
  atlas.height = height;
  atlas.count = plan.map_count;
  atlas.efficiency =
      static_cast<double>(texels_of(plan)) / (static_cast<double>(width) * static_cast<double>(height));
  return atlas;
}

Atlas pack_atlas(const ShadowPlan& plan) noexcept {
  if (plan.map_count == 0) return {};
  // Areas double from one try to the next; of one area, from the squarest to the longest. Eight of the
  // largest maps fit into 2^17 squared.
  constexpr int kLargestExponent = 34;
  for (int area = 0; area <= kLargestExponent; ++area) {
    if (texels_of(plan) > std::int64_t{1} << area) continue;
    constexpr int kLongestSide = 17;
    for (int wide = (area + 1) / 2; wide <= std::min(area, kLongestSide); ++wide) {
      for (const int exponent : {wide, area - wide}) {
        const Atlas atlas = pack_atlas(plan, 1 << exponent, 1 << (area - exponent));
        if (atlas.count > 0) return atlas;
      }
    }
  }
  return {};
}

double array_efficiency(const ShadowPlan& plan) noexcept {
  if (plan.map_count == 0) return 0.0;
  int width = 0, height = 0;
  for (const ShadowMap& map : plan.maps()) {
    width = std::max(width, map.width);
    height = std::max(height, map.height);
  }
  return static_cast<double>(texels_of(plan)) /
         (static_cast<double>(width) * static_cast<double>(height) * plan.map_count);
}

glm::dmat4 atlas_from_clip(const Atlas& atlas, const ClipSpace& clip_space, int map) noexcept {
  const TexelRect& place = atlas.place[static_cast<std::size_t>(map)];
  const double w = atlas.width, h = atlas.height;
  glm::dmat4 into(1.0);
  into[0][0] = place.width / w;
  into[1][1] = place.height / h;
  into[3][0] = place.x / w;
  into[3][1] = place.y / h;
  return into * texture_from_clip(clip_space);
}

}  // namespace gnomon
