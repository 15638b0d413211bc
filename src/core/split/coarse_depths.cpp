// Which view depths can show a surface, by a coarse depth buffer drawn on the CPU?
// Based on: Hasselgren, Andersson, Akenine-Möller, "Masked Software Occlusion Culling", 2016: a mask of
// covered pixels and two depths for each tile. Here triangles are tested tile by tile in a second pass.
#include "gnomon/view.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

constexpr int kTile = kCoarseTilePixels;
constexpr std::uint64_t kAllPixels = ~std::uint64_t{0};
static_assert(kTile * kTile == 64, "a mask has a bit for each pixel");
/// A renderer in single precision places surfaces by less than this share of their depth elsewhere.
constexpr double kDepthRounding = 1e-5;
/// And corners by less than this many pixels.
constexpr double kPixelRounding = 1.0 / 64.0;

/// On the image, in pixels. Nearness grows towards the eye and is linear over the image of a plane: the
/// reciprocal of depth, or under an orthographic camera its negative.
struct ImagePoint {
  double x = 0.0, y = 0.0, nearness = 0.0;
};

/// A triangle in front of the near plane.
struct Polygon {
  std::array<ImagePoint, 4> corner;
  int count = 0;

  [[nodiscard]] const ImagePoint& after(int i) const noexcept {
    return corner[static_cast<std::size_t>(i + 1 < count ? i + 1 : 0)];
  }
  [[nodiscard]] double area_twice() const noexcept {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
      const ImagePoint &a = corner[static_cast<std::size_t>(i)], &b = after(i);
      sum += (a.x - corner[0].x) * (b.y - corner[0].y) - (b.x - corner[0].x) * (a.y - corner[0].y);
    }
    return sum;
  }
};

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double value) noexcept {
    low = min_of(low, value);
    high = max_of(high, value);
  }
  [[nodiscard]] bool empty() const noexcept { return !(low <= high); }
};

/// Where an edge meets a row. From the lower corner to the upper one, whichever comes first: both triangles
/// at an edge get the same number.
double edge_at(const ImagePoint& a, const ImagePoint& b, double y) noexcept {
  const bool swap = b.y < a.y || (b.y == a.y && b.x < a.x);
  const ImagePoint &low = swap ? b : a, &high = swap ? a : b;
  return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
}

/// The polygon's columns on one row.
Interval columns_at(const Polygon& polygon, double y) noexcept {
  Interval columns;
  for (int i = 0; i < polygon.count; ++i) {
    const ImagePoint &a = polygon.corner[static_cast<std::size_t>(i)], &b = polygon.after(i);
    if (a.y == b.y || (a.y < y) == (b.y < y)) continue;
    columns.add(edge_at(a, b, y));
  }
  return columns;
}

/// The polygon's columns over all rows from `low` to `high`.
Interval columns_between(const Polygon& polygon, double low, double high) noexcept {
  Interval columns;
  for (int i = 0; i < polygon.count; ++i) {
    const ImagePoint &a = polygon.corner[static_cast<std::size_t>(i)], &b = polygon.after(i);
    if (max_of(a.y, b.y) < low || min_of(a.y, b.y) > high) continue;
    for (const ImagePoint* end : {&a, &b}) {
      const double y = clamp_to(end->y, low, high);
      columns.add(y == end->y ? end->x : edge_at(a, b, y));
    }
  }
  return columns;
}

/// Nearness over a polygon's plane, as far as its corners bear it out.
class NearnessPlane {
 public:
  explicit NearnessPlane(const Polygon& polygon) noexcept {
    for (int i = 0; i < polygon.count; ++i) {
      const ImagePoint& p = polygon.corner[static_cast<std::size_t>(i)];
      x_.add(p.x);
      y_.add(p.y);
      nearness_.add(p.nearness);
    }
    double best = 0.0;
    for (int i = 2; i < polygon.count; ++i) {
      const ImagePoint &a = polygon.corner[0], &b = polygon.corner[static_cast<std::size_t>(i - 1)],
                       &c = polygon.corner[static_cast<std::size_t>(i)];
      const double det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
      // Thinner ones have no slope worth the name: their corners bound them.
      constexpr double kLeastArea = 1e-3;
      if (!(std::abs(det) > max_of(best, kLeastArea))) continue;
      best = std::abs(det);
      at_ = a;
      slope_x_ = ((b.nearness - a.nearness) * (c.y - a.y) - (c.nearness - a.nearness) * (b.y - a.y)) / det;
      slope_y_ = ((b.x - a.x) * (c.nearness - a.nearness) - (c.x - a.x) * (b.nearness - a.nearness)) / det;
      has_slope_ = true;
    }
  }
  /// Within a tile, `column` and `row` its place in tiles.
  [[nodiscard]] Interval within(int column, int row) const noexcept {
    if (!has_slope_) return nearness_;
    const auto ends = [](const Interval& all, int tile) {
      return Interval{max_of(all.low, tile * double{kTile}), min_of(all.high, (tile + 1) * double{kTile})};
    };
    const Interval x = ends(x_, column), y = ends(y_, row);
    const auto nearness = [&](double at_x, double at_y) {
      return clamp_to(at_.nearness + slope_x_ * (at_x - at_.x) + slope_y_ * (at_y - at_.y), nearness_.low,
                      nearness_.high);
    };
    return {nearness(slope_x_ > 0.0 ? x.low : x.high, slope_y_ > 0.0 ? y.low : y.high),
            nearness(slope_x_ > 0.0 ? x.high : x.low, slope_y_ > 0.0 ? y.high : y.low)};
  }
  [[nodiscard]] const Interval& x() const noexcept { return x_; }
  [[nodiscard]] const Interval& y() const noexcept { return y_; }

 private:
  Interval x_, y_, nearness_;
  ImagePoint at_;
  double slope_x_ = 0.0, slope_y_ = 0.0;
  bool has_slope_ = false;
};

/// Whole numbers from one place up to another, within [0, count).
struct Range {
  int begin, end;
};
Range range_of(double low, double high, int count) noexcept {
  const double most = count;
  return {static_cast<int>(clamp_to(std::floor(low), 0.0, most)),
          static_cast<int>(clamp_to(std::floor(high) + 1.0, 0.0, most))};
}

class CoarsePass {
 public:
  CoarsePass(const Camera& camera, std::span<CoarseTile> tiles) noexcept
      : camera_(camera),
        axes_(camera_axes(camera)),
        columns_((camera.width + kTile - 1) / kTile),
        rows_((camera.height + kTile - 1) / kTile),
        tiles_(tiles.first(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_))) {
    for (CoarseTile& tile : tiles_) tile = {};
  }
  void hide_behind(const CoarseMesh& mesh) noexcept {
    if (mesh.occludes)
      for_each_polygon(mesh, [&](const Polygon& polygon, bool front) {
        if (front || mesh.double_sided) cover(polygon);
      });
  }
  /// From here on a tile hides what all tiles round it hide.
  void widen() noexcept;
  void show(const CoarseMesh& mesh) noexcept {
    for_each_polygon(mesh, [&](const Polygon& polygon, bool front) {
      if (front || mesh.double_sided || is_thin(polygon)) show(polygon);
    });
  }
  void show(const Box& box) noexcept;
  [[nodiscard]] const VisibleDepths& depths() const noexcept { return depths_; }

 private:
  /// x to the right, y up, z the view depth.
  [[nodiscard]] glm::dvec3 view_of(const glm::dvec3& world) const noexcept {
    const glm::dvec3 relative = world - camera_.position;
    return {glm::dot(axes_.right, relative), glm::dot(axes_.up, relative), glm::dot(axes_.forward, relative)};
  }
  [[nodiscard]] ImagePoint image_of(const glm::dvec3& view) const noexcept {
    const double scale = camera_.orthographic ? 1.0 : 1.0 / view.z;
    return {(view.x * scale - camera_.left) / (camera_.right - camera_.left) * camera_.width,
            (view.y * scale - camera_.bottom) / (camera_.top - camera_.bottom) * camera_.height,
            camera_.orthographic ? -view.z : scale};
  }
  [[nodiscard]] double depth_of(double nearness) const noexcept {
    return camera_.orthographic ? -nearness : 1.0 / nearness;
  }
  /// Empty where all of it is nearer than the near plane.
  [[nodiscard]] Polygon in_front(std::span<const glm::dvec3> view) const noexcept;
  /// Those of a mesh that reach into the image; `front`: wound as the front of a surface.
  template <class Visit>
  void for_each_polygon(const CoarseMesh& mesh, Visit&& visit) const noexcept;
  [[nodiscard]] bool in_image(const Polygon& polygon) const noexcept;
  /// Too thin for its winding to be the same in single precision.
  [[nodiscard]] static bool is_thin(const Polygon& polygon) noexcept;
  void cover(const Polygon& polygon) noexcept;
  /// Pixels of a tile that the image does not have.
  [[nodiscard]] std::uint64_t beyond_image(int column, int row) const noexcept;
  void cover(CoarseTile& tile, std::uint64_t pixels, float depth) noexcept;
  void show(const Polygon& polygon) noexcept;
  void show(const CoarseTile& tile, double nearest, double farthest) noexcept;
  [[nodiscard]] CoarseTile& tile(int column, int row) noexcept {
    return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }

  const Camera& camera_;
  CameraAxes axes_;
  int columns_, rows_;
  std::span<CoarseTile> tiles_;
  VisibleDepths depths_;
};

Polygon CoarsePass::in_front(std::span<const glm::dvec3> view) const noexcept {
  Polygon polygon;
  const double near_depth = camera_.near_depth;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const glm::dvec3 &a = view[i], &b = view[i + 1 < view.size() ? i + 1 : 0];
    const bool a_in = a.z >= near_depth, b_in = b.z >= near_depth;
    if (a_in) polygon.corner[static_cast<std::size_t>(polygon.count++)] = image_of(a);
    if (a_in == b_in) continue;
    // From within outwards, so that both triangles at an edge get the same corner.
    const glm::dvec3 &in = a_in ? a : b, &out = a_in ? b : a;
    glm::dvec3 cut = in + (out - in) * ((in.z - near_depth) / (in.z - out.z));
    cut.z = near_depth;
    polygon.corner[static_cast<std::size_t>(polygon.count++)] = image_of(cut);
  }
  return polygon;
}

bool CoarsePass::in_image(const Polygon& polygon) const noexcept {
  Interval x, y, nearness;
  for (int i = 0; i < polygon.count; ++i) {
    const ImagePoint& p = polygon.corner[static_cast<std::size_t>(i)];
    // What overflowed bounds nothing.
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.nearness)) return false;
    x.add(p.x);
    y.add(p.y);
    nearness.add(p.nearness);
  }
  return polygon.count >= 3 && x.high >= -kPixelRounding && x.low <= camera_.width + kPixelRounding &&
         y.high >= -kPixelRounding && y.low <= camera_.height + kPixelRounding &&
         depth_of(nearness.high) * (1.0 - kDepthRounding) <= camera_.far_depth;
}

bool CoarsePass::is_thin(const Polygon& polygon) noexcept {
  double length = 0.0;
  for (int i = 0; i < polygon.count; ++i) {
    const ImagePoint &a = polygon.corner[static_cast<std::size_t>(i)], &b = polygon.after(i);
    length += std::abs(a.x - b.x) + std::abs(a.y - b.y);
  }
  return std::abs(polygon.area_twice()) <= 2.0 * kPixelRounding * length;
}

template <class Visit>
void CoarsePass::for_each_polygon(const CoarseMesh& mesh, Visit&& visit) const noexcept {
  const glm::dmat3 view_from_world = glm::transpose(glm::dmat3(axes_.right, axes_.up, axes_.forward));
  const glm::dmat3 turn = view_from_world * glm::dmat3(mesh.world_from_object);
  const glm::dvec3 shift = view_of(glm::dvec3(mesh.world_from_object[3]));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<glm::dvec3, 3> view;
    for (std::size_t k = 0; k < 3; ++k)
      view[k] = turn * glm::dvec3(mesh.positions[mesh.indices[i + k]]) + shift;
    const Polygon polygon = in_front(view);
    if (in_image(polygon)) visit(polygon, (polygon.area_twice() > 0.0) != mesh.mirrored);
  }
}

void CoarsePass::cover(CoarseTile& tile, std::uint64_t pixels, float depth) noexcept {
  if (!(depth < tile.farthest)) return;
  if (pixels == kAllPixels) {
    tile.farthest = depth;
    if (!(tile.layer < depth)) tile.covered = 0;
    return;
  }
  // A surface much nearer than the layer at hand begins a layer of its own.
  if (tile.covered != 0 && tile.layer - depth > tile.farthest - tile.layer) tile.covered = 0;
  tile.layer = tile.covered == 0 ? depth : static_cast<float>(max_of(double{tile.layer}, double{depth}));
  tile.covered |= pixels;
  if (tile.covered != kAllPixels) return;
  tile.farthest = tile.layer;
  tile.covered = 0;
}

void CoarsePass::cover(const Polygon& polygon) noexcept {
  const NearnessPlane plane(polygon);
  const Range rows = range_of(plane.y().low / kTile, plane.y().high / kTile, rows_);
  for (int row = rows.begin; row < rows.end; ++row) {
    // Pixels whose centres lie within, row by row.
    std::array<Range, kTile> pixels;
    Range touched{columns_ * kTile, 0};
    for (int k = 0; k < kTile; ++k) {
      const Interval columns = columns_at(polygon, row * kTile + k + 0.5);
      Range& own = pixels[static_cast<std::size_t>(k)] = {0, 0};
      if (columns.empty()) continue;
      const double most = double{kTile} * columns_;
      own = {static_cast<int>(clamp_to(std::ceil(columns.low - 0.5), 0.0, most)),
             static_cast<int>(clamp_to(std::floor(columns.high - 0.5) + 1.0, 0.0, most))};
      if (own.begin >= own.end) continue;
      touched = {own.begin < touched.begin ? own.begin : touched.begin,
                 own.end > touched.end ? own.end : touched.end};
    }
    for (int column = touched.begin / kTile; column * kTile < touched.end; ++column) {
      std::uint64_t mask = 0;
      for (int k = 0; k < kTile; ++k) {
        const Range& own = pixels[static_cast<std::size_t>(k)];
        const int begin = own.begin - column * kTile, end = own.end - column * kTile;
        if (begin >= kTile || end <= 0 || begin >= end) continue;
        const unsigned upper = end >= kTile ? 0xffu : (1u << end) - 1u;
        const unsigned lower = begin <= 0 ? 0u : (1u << begin) - 1u;
        mask |= std::uint64_t{upper & ~lower} << (k * kTile);
      }
      if (mask == 0) continue;
      mask |= beyond_image(column, row);
      const double depth = depth_of(plane.within(column, row).low);
      cover(tile(column, row), mask, static_cast<float>(depth * (1.0 + kDepthRounding)));
    }
  }
}

std::uint64_t CoarsePass::beyond_image(int column, int row) const noexcept {
  constexpr std::uint64_t kEachRow = 0x0101010101010101;
  const int columns = camera_.width - column * kTile, rows = camera_.height - row * kTile;
  std::uint64_t pixels = 0;
  if (columns < kTile) pixels |= kEachRow * ((0xffu << columns) & 0xffu);
  if (rows < kTile) pixels |= kAllPixels << (rows * kTile);
  return pixels;
}

void CoarsePass::widen() noexcept {
  // `layer` becomes the farthest of all nine: no pixel near an edge is taken for hidden by rounding, nor one
  // that a renderer samples elsewhere within it.
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      float farthest = 0.0f;
      for (int y = row > 0 ? row - 1 : 0; y <= row + 1 && y < rows_; ++y) {
        for (int x = column > 0 ? column - 1 : 0; x <= column + 1 && x < columns_; ++x)
          farthest = farthest < tile(x, y).farthest ? tile(x, y).farthest : farthest;
      }
      tile(column, row).layer = farthest;
    }
  }
}

void CoarsePass::show(const CoarseTile& tile, double nearest, double farthest) noexcept {
  nearest = max_of(nearest * (1.0 - kDepthRounding), camera_.near_depth);
  farthest = min_of(min_of(farthest * (1.0 + kDepthRounding), double{tile.layer}), camera_.far_depth);
  if (!(nearest <= farthest)) return;
  depths_.min = min_of(depths_.min, nearest);
  depths_.max = max_of(depths_.max, farthest);
  const int last = depth_bin(farthest);
  for (int bin = depth_bin(nearest); bin <= last; ++bin) ++depths_.count[static_cast<std::size_t>(bin)];
}

void CoarsePass::show(const Polygon& polygon) noexcept {
  const NearnessPlane plane(polygon);
  const Range rows =
      range_of((plane.y().low - kPixelRounding) / kTile, (plane.y().high + kPixelRounding) / kTile, rows_);
  for (int row = rows.begin; row < rows.end; ++row) {
    const Interval part = columns_between(polygon, row * double{kTile} - kPixelRounding,
                                          (row + 1) * double{kTile} + kPixelRounding);
    if (part.empty()) continue;
    const Range columns =
        range_of((part.low - kPixelRounding) / kTile, (part.high + kPixelRounding) / kTile, columns_);
    for (int column = columns.begin; column < columns.end; ++column) {
      const Interval nearness = plane.within(column, row);
      show(tile(column, row), depth_of(nearness.high), depth_of(nearness.low));
    }
  }
}

void CoarsePass::show(const Box& box) noexcept {
  if (box.empty()) return;
  std::array<glm::dvec3, 8> view;
  Interval depth, x, y;
  for (std::size_t i = 0; i < view.size(); ++i) {
    view[i] = view_of({(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                       (i & 4) != 0 ? box.max.z : box.min.z});
    depth.add(view[i].z);
  }
  if (!(depth.high >= camera_.near_depth && depth.low <= camera_.far_depth)) return;
  // Its image is that of its edges in front of the near plane.
  for (std::size_t i = 0; i < view.size(); ++i) {
    for (const std::size_t side : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
      const std::array<glm::dvec3, 2> edge{view[i], view[i ^ side]};
      const Polygon seen = in_front(edge);
      for (int k = 0; k < seen.count; ++k) {
        x.add(seen.corner[static_cast<std::size_t>(k)].x);
        y.add(seen.corner[static_cast<std::size_t>(k)].y);
      }
    }
  }
  const Range columns =
      range_of((x.low - kPixelRounding) / kTile, (x.high + kPixelRounding) / kTile, columns_);
  const Range rows = range_of((y.low - kPixelRounding) / kTile, (y.high + kPixelRounding) / kTile, rows_);
  for (int row = rows.begin; row < rows.end; ++row) {
    for (int column = columns.begin; column < columns.end; ++column)
      show(tile(column, row), max_of(depth.low, camera_.near_depth), depth.high);
  }
}

}  // namespace

std::size_t coarse_tile_count(const Camera& camera) noexcept {
  if (camera.width <= 0 || camera.height <= 0) return 0;
  const auto tiles = [](int pixels) { return (static_cast<std::size_t>(pixels) + kTile - 1) / kTile; };
  return tiles(camera.width) * tiles(camera.height);
}

VisibleDepths coarse_depths(const Camera& camera, std::span<const CoarseMesh> meshes,
                            std::span<const Box> boxes, std::span<CoarseTile> tiles) noexcept {
  const std::size_t count = coarse_tile_count(camera);
  const bool sees = camera.left < camera.right && camera.bottom < camera.top && camera.near_depth > 0.0 &&
                    camera.near_depth < camera.far_depth;
  if (count == 0 || tiles.size() < count || !sees || !is_finite(camera.position)) return {};
  CoarsePass pass(camera, tiles);
  for (const CoarseMesh& mesh : meshes) pass.hide_behind(mesh);
  pass.widen();
  for (const CoarseMesh& mesh : meshes) pass.show(mesh);
  for (const Box& box : boxes) pass.show(box);
  return pass.depths();
}

}  // namespace gnomon
