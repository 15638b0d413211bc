// How many pixels will a plan get wrong? Its texels are applied to a shadow that is known.
#include "gnomon/study/expected_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/matrix.hpp"
#include "measure/metric_kernel.hpp"

namespace gnomon {
namespace {

/// Two pixels show one surface where the second's depth is off the plane of the first by at most this share.
constexpr double kOffPlane = 0.02;
/// Cosine of the angle between a surface and the ray of sight below which its plane says nothing.
constexpr double kGrazing = 1e-3;
/// Steps of a pixel beyond which nothing is in any picture: a texel that the plane meets nowhere.
constexpr double kMostSteps = 1e9;

/// The pictures, with what a camera makes of their pixels.
class Pixels {
 public:
  explicit Pixels(const ShadowPicture& shadow) noexcept
      : shadow_(shadow), camera_(shadow.camera), axes_(camera_axes(shadow.camera)) {
    if (camera_.width < 1 || camera_.height < 1) return;
    const auto width = static_cast<std::size_t>(camera_.width),
               height = static_cast<std::size_t>(camera_.height);
    const std::size_t count = shadow.mask.size();
    if (count % width == 0 && count / width == height && shadow.view_depths.size() == count) {
      width_ = camera_.width;
      height_ = camera_.height;
    }
  }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] const Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] const CameraAxes& axes() const noexcept { return axes_; }

  [[nodiscard]] double lit(int x, int y) const noexcept {
    return static_cast<double>(shadow_.mask[at(x, y)]);
  }
  [[nodiscard]] double depth(int x, int y) const noexcept {
    return static_cast<double>(shadow_.view_depths[at(x, y)]);
  }
  /// Inside of the picture, a surface there, and lit or dark.
  [[nodiscard]] bool counts(int x, int y) const noexcept {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    const double lit_there = lit(x, y), depth_there = depth(x, y);
    return lit_there >= 0.0 && lit_there <= 1.0 && depth_there > 0.0 && std::isfinite(depth_there);
  }
  /// Of a depth: grows evenly over the image of a plane.
  [[nodiscard]] double flat(double depth) const noexcept {
    return camera_.orthographic ? depth : 1.0 / depth;
  }

  [[nodiscard]] glm::dvec3 position(int x, int y, double depth) const noexcept {
    const double right = camera_.left + (camera_.right - camera_.left) * (x + 0.5) / width_;
    const double up = camera_.top + (camera_.bottom - camera_.top) * (y + 0.5) / height_;
    const double scale = camera_.orthographic ? 1.0 : depth;
    return camera_.position + axes_.forward * depth + axes_.right * (right * scale) + axes_.up * (up * scale);
  }
  /// Where the image shows a point: pixel centres are whole numbers.
  struct Place {
    double x, y, depth;
  };
  [[nodiscard]] Place place(const glm::dvec3& point) const noexcept {
    const glm::dvec3 offset = point - camera_.position;
    const double depth = glm::dot(offset, axes_.forward);
    const double scale = camera_.orthographic ? 1.0 : depth > 0.0 ? 1.0 / depth : 0.0;
    return {
        (glm::dot(offset, axes_.right) * scale - camera_.left) / (camera_.right - camera_.left) * width_ -
            0.5,
        (glm::dot(offset, axes_.up) * scale - camera_.top) / (camera_.bottom - camera_.top) * height_ - 0.5,
        depth};
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  const ShadowPicture& shadow_;
  const Camera& camera_;
  CameraAxes axes_;
  int width_ = 0, height_ = 0;
};

/// The plane of the surface at a pixel, from the depths of the two of its neighbours that bend it least.
struct SurfacePlane {
  double flat, right, down;  ///< Pixels::flat, and its growth per pixel
  [[nodiscard]] bool holds(double x, double y, double flat_there) const noexcept {
    return std::abs(flat + right * x + down * y - flat_there) <= kOffPlane * std::abs(flat_there);
  }
};

SurfacePlane plane_at(const Pixels& pixels, int x, int y) noexcept {
  SurfacePlane plane{pixels.flat(pixels.depth(x, y)), 0.0, 0.0};
  const auto growth = [&](int dx, int dy) {
    double least = std::numeric_limits<double>::infinity();
    for (const int sign : {1, -1}) {
      const int column = x + sign * dx, row = y + sign * dy;
      if (!pixels.counts(column, row)) continue;
      const double step = sign * (pixels.flat(pixels.depth(column, row)) - plane.flat);
      if (std::abs(step) < std::abs(least)) least = step;
    }
    return std::isfinite(least) ? least : 0.0;
  };
  plane.right = growth(1, 0);
  plane.down = growth(0, 1);
  return plane;
}

/// The shadow at a pixel that shows the plane, else at `otherwise`.
double lit_on(const Pixels& pixels, const SurfacePlane& plane, int x, int y, int right, int down,
              double otherwise) noexcept {
  const bool shown = pixels.counts(x + right, y + down) &&
                     plane.holds(right, down, pixels.flat(pixels.depth(x + right, y + down)));
  return shown ? pixels.lit(x + right, y + down) : otherwise;
}

/// The shadow in a place between four pixels, as far as they show the plane of pixel x, y. Negative: none
/// does.
double lit_between(const Pixels& pixels, const SurfacePlane& plane, int x, int y,
                   const Pixels::Place& place) noexcept {
  if (!(place.x > -1.0 && place.y > -1.0 && place.x < pixels.width() && place.y < pixels.height()))
    return -1.0;
  const double left = std::floor(place.x), top = std::floor(place.y);
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int column = static_cast<int>(left) + i % 2, row = static_cast<int>(top) + i / 2;
    const double lit = lit_on(pixels, plane, x, y, column - x, row - y, -1.0);
    const double weight = (1.0 - std::abs(place.x - column)) * (1.0 - std::abs(place.y - row));
    if (lit < 0.0) continue;
    sum += weight * lit;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : -1.0;
}

/// The shadow of a pixel, as blurred as lit_between() blurs that of the place: along each axis by a kernel of
/// the same variance, share * (1 - share). Else what lies along a slanting edge would seem to differ from the
/// edge. A line of one pixel stays as it is.
double lit_alike(const Pixels& pixels, const SurfacePlane& plane, int x, int y,
                 const Pixels::Place& place) noexcept {
  const double own = pixels.lit(x, y);
  const auto lit = [&](int right, int down) { return lit_on(pixels, plane, x, y, right, down, own); };
  const auto aside = [&](double at, int right, int down) {
    std::array<double, 5> line{};
    for (int i = 0; i < 5; ++i) line[static_cast<std::size_t>(i)] = lit((i - 2) * right, (i - 2) * down);
    for (std::size_t i = 1; i < 4; ++i) {
      if (std::abs(line[i] - line[i - 1]) > 0.5 && std::abs(line[i] - line[i + 1]) > 0.5) return 0.0;
    }
    const double share = at - std::floor(at);
    return 0.5 * share * (1.0 - share);
  };
  const double aside_x = aside(place.x, 1, 0), aside_y = aside(place.y, 0, 1);
  double sum = 0.0;
  for (int down = -1; down <= 1; ++down) {
    for (int right = -1; right <= 1; ++right)
      sum += (right == 0 ? 1.0 - 2.0 * aside_x : aside_x) * (down == 0 ? 1.0 - 2.0 * aside_y : aside_y) *
             lit(right, down);
  }
  return sum;
}

/// Where the middle of the point's texel meets the plane. False where that is nowhere.
bool texel_middle(const Pixels& pixels, const ShadowMap& map, const SurfacePlane& plane,
                  const glm::dvec3& point, int x, int y, Pixels::Place& place) noexcept {
  const Camera& camera = pixels.camera();
  const TexelGrid grid = map.texels();
  const TexelJacobian texel = texel_jacobian(map.clip_from_world, grid, point);
  if (!(texel.w > 0.0)) return false;
  const ViewPoint view = view_point(camera, pixels.axes(), point);
  // Two ways along the plane, each by a pixel to where it comes nearer: away from its horizon.
  const auto beside = [&](int dx, int dy, double growth) {
    const int sign = growth < 0.0 ? -1 : 1;
    const double flat = plane.flat + growth * sign;
    return pixels.position(x + sign * dx, y + sign * dy, camera.orthographic ? flat : 1.0 / flat) - point;
  };
  const glm::dvec3 right = beside(1, 0, plane.right), down = beside(0, 1, plane.down);
  const glm::dvec3 normal = safe_normalize(glm::cross(right, down), -view.ray);
  const double facing = glm::dot(normal, view.ray);
  if (!(std::abs(facing) > kGrazing)) return false;
  const double xx = glm::dot(texel.x, right), xy = glm::dot(texel.x, down), yx = glm::dot(texel.y, right),
               yy = glm::dot(texel.y, down);
  const glm::dvec2 in_map = grid.place({texel.ndc_x, texel.ndc_y}).texel;
  const double off_x = std::floor(in_map.x) + 0.5 - in_map.x, off_y = std::floor(in_map.y) + 0.5 - in_map.y;
  const double determinant = xx * yy - xy * yx;
  const double far_right = off_x * yy - off_y * xy, far_down = off_y * xx - off_x * yx;
  const double most = kMostSteps * std::abs(determinant);
  if (!(std::abs(far_right) < most && std::abs(far_down) < most)) return false;
  const double steps_right = far_right / determinant, steps_down = far_down / determinant;
  place = pixels.place(point + right * steps_right + down * steps_down);
  return place.depth > 0.0 && std::isfinite(place.x) && std::isfinite(place.y);
}

}  // namespace

ExpectedError expected_error(const ShadowPlan& plan, const ShadowPicture& shadow) noexcept {
  const Pixels pixels(shadow);
  double counted = 0.0, known = 0.0, wrong = 0.0;
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      if (!pixels.counts(x, y)) continue;
      counted += 1.0;
      const double depth = pixels.depth(x, y), lit = pixels.lit(x, y);
      const glm::dvec3 point = pixels.position(x, y, depth);
      const int serving = map_serving(plan, point, depth);
      double own = lit, taken = 1.0;  // what no map holds is drawn as lit
      if (serving >= 0) {
        const SurfacePlane plane = plane_at(pixels, x, y);
        Pixels::Place place{};
        if (!texel_middle(pixels, plan.maps()[static_cast<std::size_t>(serving)], plane, point, x, y, place))
          continue;
        taken = lit_between(pixels, plane, x, y, place);
        if (taken < 0.0) continue;
        own = lit_alike(pixels, plane, x, y, place);
      }
      known += 1.0;
      wrong += std::abs(taken - own);
    }
  }
  return {known > 0.0 ? wrong * (counted / known) : 0.0, counted};
}

std::size_t shadow_edge_points(const ShadowPicture& shadow, std::span<glm::dvec3> out) noexcept {
  const Pixels pixels(shadow);
  const auto is_edge = [&](int x, int y) {
    if (!pixels.counts(x, y)) return false;
    const SurfacePlane plane = plane_at(pixels, x, y);
    for (const auto& [dx, dy] : std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
      if (pixels.counts(x + dx, y + dy) && (pixels.lit(x + dx, y + dy) > 0.5) != (pixels.lit(x, y) > 0.5) &&
          plane.holds(dx, dy, pixels.flat(pixels.depth(x + dx, y + dy))))
        return true;
    }
    return false;
  };
  std::size_t all = 0;
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) all += is_edge(x, y) ? 1 : 0;
  const std::size_t taken = std::min(all, out.size());
  std::size_t edge = 0, written = 0;
  for (int y = 0; y < pixels.height() && written < taken; ++y) {
    for (int x = 0; x < pixels.width() && written < taken; ++x) {
      // The k-th of all is taken where k * taken / all begins a new whole number.
      if (!is_edge(x, y) || edge++ * taken / all < written) continue;
      out[written++] = pixels.position(x, y, pixels.depth(x, y));
    }
  }
  return written;
}

}  // namespace gnomon
