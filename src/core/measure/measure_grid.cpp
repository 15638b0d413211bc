// The points at which errors are measured: found by drawing each box where it appears in the image.
#include "measure/measure_grid.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/body.hpp"
#include "geometry/box_walk.hpp"

namespace gnomon {
namespace {

/// Of a dot product of three, with room: relative to what is summed.
constexpr double kRounding = 1e-12;

struct Range {
  double low, high;
};

/// dot(p - origin, axis) over the box.
Range along(const glm::dvec3& centre, const glm::dvec3& half, const glm::dvec3& axis) noexcept {
  const glm::dvec3 size = glm::abs(axis);
  const double middle = glm::dot(centre, axis), reach = glm::dot(half, size);
  const double slack = kRounding * (glm::dot(glm::abs(centre), size) + reach);
  return {middle - reach - slack, middle + reach + slack};
}

/// Columns or rows whose rays may pass between these image positions; a pixel more on each side for rounding.
/// Whatever is no number leaves everything in.
void pixels_between(Range image, double low, double high, int count, int (&out)[2]) noexcept {
  const double scale = count / (high - low);
  const double first = std::floor((image.low - low) * scale - 0.5);
  const double last = std::ceil((image.high - low) * scale - 0.5);
  // Chosen before they are turned into whole numbers: numbers beyond an int raise an exception.
  const double from = first > 0.0 ? min_of(first, count) : 0.0;
  const double to = last < count - 1 ? max_of(last, -1.0) : count - 1;
  out[0] = static_cast<int>(from);
  out[1] = static_cast<int>(to);
}

/// x / depth over both ranges, with depth > 0.
Range over_depth(Range x, Range depth) noexcept {
  return {x.low / (x.low < 0.0 ? depth.low : depth.high), x.high / (x.high < 0.0 ? depth.high : depth.low)};
}

/// The sides of what rays between these rows show, and of a pixel more on each side, in world space.
std::array<Plane, 6> sides_between(const Camera& camera, const CameraAxes& axes, const MeasureOptions& grid,
                                   std::int64_t first_row, std::int64_t last_row) noexcept {
  const double column = (camera.right - camera.left) / grid.columns,
               row = (camera.top - camera.bottom) / grid.rows;
  Camera band = camera;
  band.left -= column;
  band.right += column;
  band.bottom = camera.bottom + row * static_cast<double>(first_row - 1);
  band.top = camera.bottom + row * static_cast<double>(last_row + 2);
  std::array<Plane, 6> sides = frustum_planes(band, axes, camera.near_depth, camera.far_depth);
  for (Plane& side : sides) side.offset -= glm::dot(side.normal, camera.position);
  return sides;
}

/// Boxes that any ray of the piece meets are marked.
struct MarkQuery {
  static constexpr bool kCuts = false;
  VisiblePiece& piece;

  [[nodiscard]] std::uint32_t wanted(const CasterBlock& block) const noexcept { return block.occupied; }
  [[nodiscard]] std::uint32_t inside(const CasterBlock& block, std::uint32_t lanes,
                                     bool leaf) const noexcept {
    if (!leaf) return lanes;
    for_each_bit(lanes, [&](std::size_t lane) { piece.mark(lane_box(block, lane)); });
    return 0;
  }
};

}  // namespace

VisiblePiece::VisiblePiece(const Camera& camera, const CameraAxes& axes, const MeasureOptions& grid,
                           const DepthTable& table, bool thin) noexcept
    : camera_(camera),
      axes_(axes),
      grid_(grid),
      table_(table),
      words_((table.count + 63) / 64),
      with_thin_(thin) {}

void VisiblePiece::find(const Boxes& boxes, std::int64_t first, std::int64_t rays) noexcept {
  first_ = first;
  end_ = first + rays;
  std::fill_n(bits_.begin(), rays * words_, std::uint64_t{0});
  std::fill_n(thin_.begin(), rays, std::numeric_limits<double>::infinity());
  MarkQuery query{*this};
  // In world space: what marks is the arithmetic of depths_in_box.
  const std::array<Plane, 6> sides =
      sides_between(camera_, axes_, grid_, first_ / grid_.columns, (end_ - 1) / grid_.columns);
  BoxWalk(sides, boxes, glm::dvec3(0.0), query).whole();
}

bool VisiblePiece::footprint(const Box& box, Footprint& out) const noexcept {
  const glm::dvec3 half = (box.max - box.min) * 0.5;
  const glm::dvec3 centre = (box.min - camera_.position) + half;
  Range depth = along(centre, half, axes_.forward);
  const auto begin = table_.depth.begin(), end = begin + table_.count;
  out.depth[0] = static_cast<int>(std::lower_bound(begin, end, depth.low) - begin);
  out.depth[1] = static_cast<int>(std::upper_bound(begin, end, depth.high) - begin) - 1;
  const bool between = out.depth[0] > out.depth[1];
  if (between && !with_thin_) return false;
  if (depth.high < camera_.near_depth || depth.low > camera_.far_depth) return false;
  Range x = along(centre, half, axes_.right), y = along(centre, half, axes_.up);
  if (!camera_.orthographic) {
    // Only what lies at depths of the table counts, or in view where boxes are thin: those round the eye end,
    // too.
    const double least =
        with_thin_ ? camera_.near_depth : table_.depth[static_cast<std::size_t>(out.depth[0])];
    depth = {max_of(depth.low, least), depth.high};
    depth.high = max_of(depth.high, depth.low);
    x = over_depth(x, depth);
    y = over_depth(y, depth);
  }
  pixels_between(x, camera_.left, camera_.right, grid_.columns, out.column);
  pixels_between(y, camera_.bottom, camera_.top, grid_.rows, out.row);
  out.row[0] = static_cast<int>(std::max<std::int64_t>(out.row[0], first_ / grid_.columns));
  out.row[1] = static_cast<int>(std::min<std::int64_t>(out.row[1], (end_ - 1) / grid_.columns));
  return out.column[0] <= out.column[1] && out.row[0] <= out.row[1];
}

void VisiblePiece::mark(const Box& box) noexcept {
  Footprint where;
  if (!footprint(box, where)) return;
  const DepthInterval range{camera_.near_depth, camera_.far_depth};
  for (int row = where.row[0]; row <= where.row[1]; ++row) {
    const std::int64_t of_row = std::int64_t{row} * grid_.columns;
    const auto column = static_cast<int>(std::max<std::int64_t>(where.column[0], first_ - of_row));
    const auto last = static_cast<int>(std::min<std::int64_t>(where.column[1], end_ - 1 - of_row));
    for (int c = column; c <= last; ++c) {
      const PixelRay ray = pixel_ray(camera_, axes_, grid_, c, row);
      const DepthInterval inside = depths_in_box(box, ray.start, ray.step, range);
      if (inside.begin > inside.end || mark(of_row + c, inside, where) || !with_thin_) continue;
      // The table may hold a part of the depths.
      if (grid_.depths > kTableDepths && !between_depths(camera_, grid_, inside)) continue;
      double& nearest = thin_[static_cast<std::size_t>(of_row + c - first_)];
      nearest = min_of(nearest, inside.begin);
    }
  }
}

bool VisiblePiece::mark(std::int64_t ray, DepthInterval part, const Footprint& where) noexcept {
  if (where.depth[0] > where.depth[1]) return false;
  const auto begin = table_.depth.begin() + where.depth[0], end = table_.depth.begin() + where.depth[1] + 1;
  const auto low = static_cast<int>(std::lower_bound(begin, end, part.begin) - table_.depth.begin());
  const auto high = static_cast<int>(std::upper_bound(begin, end, part.end) - table_.depth.begin());
  for (int at = low; at < high;) {
    const int stop = std::min(high, at / 64 * 64 + 64);
    const std::uint64_t ones = ~std::uint64_t{0} >> (64 - (stop - at));
    bits_[word(ray, at)] |= ones << (at % 64);
    at = stop;
  }
  return low < high;
}

}  // namespace gnomon
