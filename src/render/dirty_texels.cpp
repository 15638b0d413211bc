// Which rectangles of a map could a moved caster have changed?
#include "dirty_texels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace gnomon::render {
namespace {

enum class Reach : std::uint8_t { none, part, all };

/// How far rounding reaches: in texels, by the steps of a rasterizer, and as a share of the terms that make
/// up a place.
constexpr double kRoom = 1.0 / 16.0, kRounding = 1e-6;

/// The image of a box: its corners, texels from the map's lower left corner.
struct Image {
  std::array<glm::dvec2, 8> corner;
  glm::dvec2 room{0.0};
};

Reach image_of(const ShadowMap& map, const Box& box, Image& out) noexcept {
  if (box.empty()) return Reach::none;
  bool behind = false, before = false;
  const glm::dvec2 size(map.width, map.height);
  const glm::dmat4& m = map.clip_from_world;
  std::array<bool, 4> beyond;  // one of the map's sides, all corners
  beyond.fill(true);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 at((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                        (corner & 4) != 0 ? box.max.z : box.min.z, 1.0);
    const glm::dvec4 clip = m * at;
    (clip.w > 0.0 ? before : behind) = true;
    glm::dvec2 terms(0.0);
    for (int i = 0; i < 4; ++i) terms += glm::abs(glm::dvec2(m[i]) * at[i]);
    const glm::dvec2 room = kRoom + kRounding * terms / std::abs(clip.w) * size;
    const glm::dvec2 sides = 1.0 + 2.0 * room / size;
    const glm::dvec2 low_side = sides * clip.w + glm::dvec2(clip),
                     high_side = sides * clip.w - glm::dvec2(clip);
    const std::array<bool, 4> out_of{low_side.x < 0.0, high_side.x < 0.0, low_side.y < 0.0,
                                     high_side.y < 0.0};
    for (std::size_t side = 0; side < 4; ++side) beyond[side] = beyond[side] && out_of[side];
    out.corner[static_cast<std::size_t>(corner)] = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
    out.room = glm::max(out.room, room);
  }
  if (!before || std::find(beyond.begin(), beyond.end(), true) != beyond.end()) return Reach::none;
  if (behind || !map.shape->affine) return Reach::all;
  return Reach::part;
}

/// The texels of a map whose centres lie between two corners; empty where there are none.
TexelRect texels_between(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& size) noexcept {
  const glm::dvec2 from = glm::max(glm::ceil(low - 0.5), glm::dvec2(0.0)),
                   to = glm::min(glm::floor(high - 0.5) + 1.0, size);
  if (!(to.x > from.x && to.y > from.y)) return {};
  return {static_cast<int>(from.x), static_cast<int>(from.y), static_cast<int>(to.x - from.x),
          static_cast<int>(to.y - from.y)};
}

TexelRect bounds_of(const Image& image, const glm::dvec2& size) noexcept {
  glm::dvec2 low = image.corner[0], high = low;
  for (const glm::dvec2& corner : image.corner) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  return texels_between(low - image.room, high + image.room, size);
}

/// The part of the image in rows [first, end): its outline is made of the box's edges.
TexelRect band_of(const Image& image, int first, int end, const glm::dvec2& size) noexcept {
  const double bottom = first + 0.5 - image.room.y, top = end - 0.5 + image.room.y;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (const std::size_t axis : {1u, 2u, 4u}) {
      if ((corner & axis) != 0) continue;
      const glm::dvec2 a = image.corner[corner], b = image.corner[corner | axis];
      if (std::min(a.y, b.y) > top || std::max(a.y, b.y) < bottom) continue;
      for (const double y : {bottom, top}) {
        const double along = a.y == b.y ? 0.0 : std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0);
        low = std::min(low, a.x + (b.x - a.x) * along);
        high = std::max(high, a.x + (b.x - a.x) * along);
      }
      if (a.y == b.y) {
        low = std::min(low, b.x);
        high = std::max(high, b.x);
      }
    }
  }
  return texels_between({low - image.room.x, 1.0 * first}, {high + image.room.x, 1.0 * end}, size);
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
void add(const TexelRect& image, std::size_t most, DirtyTexels& out) noexcept {
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
  if (out.count < most) {
    out.rectangle[out.count++] = added;
    return;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < out.count; ++i) {
    if (waste(added, out.rectangle[i]) < waste(added, out.rectangle[best])) best = i;
  }
  const TexelRect both = joined(added, out.rectangle[best]);
  out.rectangle[best] = out.rectangle[--out.count];
  add(both, most, out);
}

/// Adds the image of a box by its outline: in bands of rows, those of all boxes beginning at the same rows,
/// so that those of a box before and after join.
void add_bands(const Image& image, const TexelRect& bounds, const glm::dvec2& size,
               DirtyTexels& out) noexcept {
  constexpr int kBands = 8;
  const int height = static_cast<int>(std::bit_ceil(static_cast<unsigned>(bounds.height / kBands + 1)));
  for (int row = bounds.y / height * height; row < bounds.y + bounds.height; row += height) {
    const int first = std::max(row, bounds.y), end = std::min(row + height, bounds.y + bounds.height);
    const TexelRect band = band_of(image, first, end, size);
    if (!band.empty()) add(band, DirtyTexels::kMost, out);
  }
}

/// Calls `add_image` with the image of each box, its bounds in texels and the map's size.
template <typename AddImage>
DirtyTexels dirty_texels(const ShadowMap& map, std::span<const Box> moved_world,
                         AddImage&& add_image) noexcept {
  const glm::dvec2 size(map.width, map.height);
  DirtyTexels out;
  for (const Box& box : moved_world) {
    Image image;
    const Reach reach = image_of(map, box, image);
    if (reach == Reach::all) {
      out.whole = true;
      out.count = 0;
      return out;
    }
    if (reach == Reach::none) continue;
    const TexelRect bounds = bounds_of(image, size);
    if (bounds.empty()) continue;
    add_image(image, bounds, size, out);
  }
  return out;
}

}  // namespace

DirtyTexels dirty_bounds(const ShadowMap& map, std::span<const Box> moved_world) noexcept {
  return dirty_texels(map, moved_world,
                      [](const Image&, const TexelRect& bounds, const glm::dvec2&, DirtyTexels& out) {
                        add(bounds, DirtyTexels::kMostBounds, out);
                      });
}

DirtyTexels dirty_outlines(const ShadowMap& map, std::span<const Box> moved_world) noexcept {
  // Each band is compared with all rectangles.
  constexpr std::size_t kMostOutlined = 128;
  if (moved_world.size() <= kMostOutlined) return dirty_texels(map, moved_world, add_bands);
  return dirty_texels(map, moved_world,
                      [](const Image&, const TexelRect& bounds, const glm::dvec2&, DirtyTexels& out) {
                        add(bounds, DirtyTexels::kMost, out);
                      });
}

bool may_touch(const ShadowMap& map, const Box& box, std::span<const TexelRect> rectangles) noexcept {
  Image image;
  const Reach reach = image_of(map, box, image);
  if (reach != Reach::part) return reach == Reach::all && !rectangles.empty();
  const TexelRect b = bounds_of(image, glm::dvec2(map.width, map.height));
  return std::any_of(rectangles.begin(), rectangles.end(), [&b](const TexelRect& r) {
    return b.x < r.x + r.width && r.x < b.x + b.width && b.y < r.y + r.height && r.y < b.y + b.height;
  });
}

}  // namespace gnomon::render
