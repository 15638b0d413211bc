// Which rectangles of a map could a moved caster have changed?
#include "dirty_texels.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace gnomon::render {
namespace {

enum class Reach : std::uint8_t { none, part, all };

/// Texels round a box's image that rounding may reach.
constexpr double kRoom = 2.0;

Reach image_of(const ShadowMap& map, const Box& box, TexelRect& out) noexcept {
  if (box.empty()) return Reach::none;
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  bool behind = false, before = false;
  const glm::dvec2 size(map.width, map.height);
  const glm::dvec2 sides = 1.0 + 2.0 * kRoom / size;
  std::array<bool, 4> beyond;  // one of the map's sides, all corners
  beyond.fill(true);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4((corner & 1) != 0 ? box.max.x : box.min.x,
                                                             (corner & 2) != 0 ? box.max.y : box.min.y,
                                                             (corner & 4) != 0 ? box.max.z : box.min.z, 1.0);
    (clip.w > 0.0 ? before : behind) = true;
    const glm::dvec2 low_side = sides * clip.w + glm::dvec2(clip),
                     high_side = sides * clip.w - glm::dvec2(clip);
    const std::array<bool, 4> out_of{low_side.x < 0.0, high_side.x < 0.0, low_side.y < 0.0,
                                     high_side.y < 0.0};
    for (std::size_t side = 0; side < 4; ++side) beyond[side] = beyond[side] && out_of[side];
    low = glm::min(low, glm::dvec2(clip) / clip.w);
    high = glm::max(high, glm::dvec2(clip) / clip.w);
  }
  if (!before || std::find(beyond.begin(), beyond.end(), true) != beyond.end()) return Reach::none;
  if (behind || !map.shape->affine) return Reach::all;
  const glm::dvec2 first = glm::floor((low * 0.5 + 0.5) * size - kRoom),
                   end = glm::ceil((high * 0.5 + 0.5) * size + kRoom);
  if (!(end.x > 0.0 && end.y > 0.0 && first.x < size.x && first.y < size.y)) return Reach::none;
  const glm::dvec2 from = glm::max(first, glm::dvec2(0.0)), to = glm::min(end, size);
  out = {static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(to.x - from.x),
         static_cast<int>(to.y - from.y)};
  return Reach::part;
}

TexelRect joined(const TexelRect& a, const TexelRect& b) noexcept {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

double area(const TexelRect& r) noexcept {
  return 1.0 * r.width * r.height;
}

/// Texels that joining two of them draws besides.
double waste(const TexelRect& a, const TexelRect& b) noexcept {
  return area(joined(a, b)) - area(a) - area(b);
}

/// Joins rectangles that overlap or lie close, and the two that waste least where there are too many.
void add(const TexelRect& image, DirtyTexels& out) noexcept {
  TexelRect added = image;
  for (std::size_t i = 0; i < out.count;) {
    if (waste(added, out.rectangle[i]) > 0.0) {
      ++i;
      continue;
    }
    added = joined(added, out.rectangle[i]);
    out.rectangle[i] = out.rectangle[--out.count];
    i = 0;
  }
  if (out.count < DirtyTexels::kMost) {
    out.rectangle[out.count++] = added;
    return;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < out.count; ++i) {
    if (waste(added, out.rectangle[i]) < waste(added, out.rectangle[best])) best = i;
  }
  const TexelRect both = joined(added, out.rectangle[best]);
  out.rectangle[best] = out.rectangle[--out.count];
  add(both, out);
}

}  // namespace

DirtyTexels dirty_texels(const ShadowMap& map, std::span<const Box> moved_world) noexcept {
  DirtyTexels out;
  for (const Box& box : moved_world) {
    TexelRect image{};
    const Reach reach = image_of(map, box, image);
    if (reach == Reach::all) {
      out.whole = true;
      out.count = 0;
      return out;
    }
    if (reach == Reach::part) add(image, out);
  }
  return out;
}

}  // namespace gnomon::render
