// How many pixels will a plan get wrong? Its texels are applied to a shadow that is known.
#include "gnomon/study/expected_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "geometry/matrix.hpp"
#include "measure/lookup_bias.hpp"
#include "measure/map_light.hpp"
#include "measure/metric_kernel.hpp"
#include "measure/texel_box.hpp"
#include "measure/traced_lookup.hpp"

namespace gnomon {
namespace {

/// Two pixels show one surface where the second's depth is off the plane of the first by at most this share.
constexpr double kOffPlane = 0.02;
/// Cosine of the angle between a surface and the ray of sight below which its plane says nothing.
constexpr double kGrazing = 1e-3;
/// Steps of a pixel beyond which nothing is in any picture: a texel that the plane meets nowhere.
constexpr double kMostSteps = 1e9;
/// The pixel that stands for a cell is drawn from 16 bits.
constexpr int kMostEvery = 1 << 12;

/// The pictures, with what a camera makes of their pixels.
class Pixels {
 public:
  explicit Pixels(const ShadowPicture& shadow) noexcept
      : shadow_(shadow), camera_(shadow.camera), axes_(camera_axes(shadow.camera)) {
    if (!shadow.is_whole()) return;
    width_ = camera_.width;
    height_ = camera_.height;
  }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] const Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] const CameraAxes& axes() const noexcept { return axes_; }

  [[nodiscard]] double lit(int x, int y) const noexcept {
    return static_cast<double>(shadow_.mask[at(x, y)]);
  }
  /// The same in a map whose bias has this length along the light.
  [[nodiscard]] double lit(int x, int y, double bias_world) const noexcept {
    const double distance =
        knows_occluders() ? static_cast<double>(shadow_.occluder_distances[at(x, y)]) : -1.0;
    return distance >= 0.0 && distance < bias_world ? 1.0 : lit(x, y);
  }
  /// Of the surface, as it was given; zero where it was not.
  [[nodiscard]] glm::dvec3 normal(int x, int y) const noexcept {
    return shadow_.normals_world.empty() ? glm::dvec3(0.0) : glm::dvec3(shadow_.normals_world[at(x, y)]);
  }
  [[nodiscard]] bool knows_occluders() const noexcept { return !shadow_.occluder_distances.empty(); }
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

/// The shadow at a pixel that shows the plane, else at `otherwise`, under a bias.
double lit_on(const Pixels& pixels, const SurfacePlane& plane, int x, int y, int right, int down,
              double bias_world, double otherwise) noexcept {
  const bool shown = pixels.counts(x + right, y + down) &&
                     plane.holds(right, down, pixels.flat(pixels.depth(x + right, y + down)));
  return shown ? pixels.lit(x + right, y + down, bias_world) : otherwise;
}

/// The shadow in a place between four pixels under a bias, as far as they show the plane of pixel x, y.
/// Negative: none does.
double lit_between(const Pixels& pixels, const SurfacePlane& plane, int x, int y, const Pixels::Place& place,
                   double bias_world) noexcept {
  if (!(place.x > -1.0 && place.y > -1.0 && place.x < pixels.width() && place.y < pixels.height()))
    return -1.0;
  const double left = std::floor(place.x), top = std::floor(place.y);
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int column = static_cast<int>(left) + i % 2, row = static_cast<int>(top) + i / 2;
    const double lit = lit_on(pixels, plane, x, y, column - x, row - y, bias_world, -1.0);
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
  const auto lit = [&](int right, int down) { return lit_on(pixels, plane, x, y, right, down, 0.0, own); };
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

/// The texels round a point of a surface, where they meet its plane.
class TexelsOnPlane {
 public:
  TexelsOnPlane(const Pixels& pixels, const ShadowMap& map, const glm::dvec4& light_world,
                const SurfacePlane& plane, const glm::dvec3& point, int x, int y) noexcept
      : pixels_(pixels), light_(light_world), point_(point) {
    const Camera& camera = pixels.camera();
    const TexelGrid grid = map.texels();
    // Asked first: the Jacobian divides by it.
    if (!(w_at(map.clip_from_world, point) > 0.0)) return;
    const TexelJacobian texel = texel_jacobian(map.clip_from_world, grid, point);
    if (!(texel.w > 0.0)) return;
    texel_ = texel;
    const ViewPoint view = view_point(camera, pixels.axes(), point);
    // Two ways along the plane, each by a pixel to where it comes nearer: away from its horizon.
    const auto beside = [&](int dx, int dy, double growth) {
      const int sign = growth < 0.0 ? -1 : 1;
      const double flat = plane.flat + growth * sign;
      return pixels.position(x + sign * dx, y + sign * dy, camera.orthographic ? flat : 1.0 / flat) - point;
    };
    right_ = beside(1, 0, plane.right);
    down_ = beside(0, 1, plane.down);
    const glm::dvec3 normal = safe_normalize(glm::cross(right_, down_), -view.ray);
    if (!(std::abs(glm::dot(normal, view.ray)) > kGrazing)) return;
    normal_ = glm::dot(normal, view.ray) > 0.0 ? -normal : normal;
    x_ = {glm::dot(texel.x, right_), glm::dot(texel.x, down_)};
    y_ = {glm::dot(texel.y, right_), glm::dot(texel.y, down_)};
    place_ = grid.place({texel.ndc_x, texel.ndc_y}).texel;
    known_ = true;
  }
  /// Of the plane, unit, towards the viewer; zero where it is not known.
  [[nodiscard]] const glm::dvec3& normal() const noexcept { return normal_; }
  /// Of the point, in texels of its map.
  [[nodiscard]] const glm::dvec2& place() const noexcept { return place_; }
  /// Length of the bias along the light, world units; 0 where the plane is not known.
  [[nodiscard]] double bias_world(const BiasOptions& options) const noexcept {
    if (!known_) return 0.0;
    const glm::dvec3 to_light = glm::dvec3(light_) - light_.w * point_;
    return lookup_bias_world(options, texel_, normal_, -safe_normalize(to_light, normal_));
  }
  /// Where the picture shows what lies there in the map. False where that is nowhere.
  [[nodiscard]] bool shown(const glm::dvec2& texel, Pixels::Place& place) const noexcept {
    if (!known_) return false;
    const double off_x = texel.x - place_.x, off_y = texel.y - place_.y;
    const double determinant = x_.x * y_.y - x_.y * y_.x;
    const double far_right = off_x * y_.y - off_y * x_.y, far_down = off_y * x_.x - off_x * y_.x;
    const double most = kMostSteps * std::abs(determinant);
    if (!(std::abs(far_right) < most && std::abs(far_down) < most)) return false;
    const double steps_right = far_right / determinant, steps_down = far_down / determinant;
    place = pixels_.place(point_ + right_ * steps_right + down_ * steps_down);
    return place.depth > 0.0 && std::isfinite(place.x) && std::isfinite(place.y);
  }

 private:
  const Pixels& pixels_;
  glm::dvec4 light_;  ///< as ShadowMap::light_world
  glm::dvec3 point_, right_{0.0}, down_{0.0}, normal_{0.0};
  TexelJacobian texel_{};
  glm::dvec2 x_{0.0}, y_{0.0}, place_{0.0};  ///< texels for each step to the right and down
  bool known_ = false;
};

/// The shadow over a box of texels round the point. Negative: the picture shows too few of their middles.
double lit_over(const Pixels& pixels, const SurfacePlane& plane, const TexelsOnPlane& texels, int x, int y,
                double half_side, double bias_world) noexcept {
  // Less would be one side of an edge that lies at the border of what is shown.
  constexpr double kLeastShown = 0.9;
  return mean_over_box(texels.place(), half_side, kLeastShown, [&](const glm::dvec2& middle) {
    Pixels::Place place{};
    return texels.shown(middle, place) ? lit_between(pixels, plane, x, y, place, bias_world) : -1.0;
  });
}

/// Which pixel of a square cell of pixels stands for it: other ones in cells side by side, so that no edge
/// lies along them.
struct Standing {
  int right, down;
};
Standing standing_in(int column, int row, int side) noexcept {
  std::uint32_t h =
      static_cast<std::uint32_t>(column) * 0x9E3779B1u ^ static_cast<std::uint32_t>(row) * 0x85EBCA77u;
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  const auto cells = static_cast<std::uint32_t>(side);
  return {static_cast<int>(h % cells), static_cast<int>((h >> 16) % cells)};
}

/// The map, or the level of pages, whose texels a point is compared with. nullptr: none, and it is drawn as
/// lit.
struct Serving {
  const ShadowMap* map;
  const glm::dvec4* light_world;
};

/// `serving`: of a point at a view depth.
template <class Serve>
ExpectedError expected_over(const ShadowPicture& shadow, const BiasOptions& bias, double kernel_texels,
                            int every, const Serve& serving) noexcept {
  const Pixels pixels(shadow);
  const double half_side = kernel_texels > 0.0 ? min_of(kernel_texels, kMaxKernelTexels) : 0.0;
  const int side = std::clamp(every, 1, kMostEvery);
  FoundOccluders found(shadow.occluders);
  double counted = 0.0, known = 0.0, wrong = 0.0;
  for (int row = 0; row < pixels.height(); row += side) {
    for (int column = 0; column < pixels.width(); column += side) {
      const Standing standing = standing_in(column, row, side);
      const int x = column + standing.right, y = row + standing.down;
      if (!pixels.counts(x, y)) continue;
      counted += 1.0;
      const double depth = pixels.depth(x, y), lit = pixels.lit(x, y);
      const glm::dvec3 point = pixels.position(x, y, depth);
      const auto [map, light_world] = serving(point, depth);
      if (map == nullptr) {
        known += 1.0;
        wrong += 1.0 - lit;
        continue;
      }
      const SurfacePlane plane = plane_at(pixels, x, y);
      const TexelsOnPlane texels(pixels, *map, *light_world, plane, point, x, y);
      if (shadow.occluders.distance != nullptr) {
        const glm::dvec3 normal = safe_normalize(pixels.normal(x, y), texels.normal());
        const TracedLookup lookup(found, bias, *map, *light_world, point, normal);
        if (!lookup.known()) continue;
        known += 1.0;
        const double drawn = half_side > 0.0 ? lookup.mean(half_side) : lookup.hard();
        wrong += (drawn > 0.5) != (lit > 0.5) ? 1.0 : 0.0;
        continue;
      }
      const double bias_world = pixels.knows_occluders() ? texels.bias_world(bias) : 0.0;
      Pixels::Place place{};
      const bool shown = texels.shown(glm::floor(texels.place()) + 0.5, place);
      const double taken = shown ? lit_between(pixels, plane, x, y, place, bias_world) : -1.0;
      // Where two surfaces meet, one often hides the middles of the other's texels. What is close enough to
      // be lit at the pixel is closer still there.
      const double of_texel = taken >= 0.0 ? std::abs(taken - lit_alike(pixels, plane, x, y, place))
                                           : pixels.lit(x, y, bias_world) - lit;
      if (taken < 0.0 && !(of_texel > 0.0)) continue;
      known += 1.0;
      const double mean =
          half_side > 0.0 ? lit_over(pixels, plane, texels, x, y, half_side, bias_world) : -1.0;
      if (mean < 0.0) {
        wrong += of_texel;
        continue;
      }
      const double of_mean = (mean > 0.5) != (lit > 0.5) ? 1.0 : 0.0;
      wrong += 0.5 * (of_texel + of_mean);
    }
  }
  const double pixels_each = static_cast<double>(side) * side;
  return {known > 0.0 ? pixels_each * wrong * (counted / known) : 0.0, pixels_each * counted};
}

}  // namespace

ExpectedError expected_error(const ShadowPlan& plan, const ShadowPicture& shadow, double kernel_texels,
                             int every) noexcept {
  std::array<glm::dvec4, kMaxMaps> lights_world;
  for (std::size_t i = 0; i < plan.maps().size(); ++i) lights_world[i] = light_of(plan.maps()[i]);
  return expected_over(shadow, plan.bias, kernel_texels, every, [&](const glm::dvec3& point, double depth) {
    const int map = map_serving(plan, point, depth);
    const auto i = static_cast<std::size_t>(map);
    return map < 0 ? Serving{} : Serving{&plan.maps()[i], &lights_world[i]};
  });
}

ExpectedError expected_error(const PagePlan& plan, const ShadowPicture& shadow, double kernel_texels,
                             int every) noexcept {
  // A page has the texels of its level.
  return expected_over(shadow, plan.bias, kernel_texels, every, [&](const glm::dvec3& point, double) {
    const int page = page_serving(plan, point);
    if (page < 0) return Serving{};
    const ShadowMap& level = plan.levels[plan.pages[static_cast<std::size_t>(page)].level];
    return Serving{&level, &level.light_world};
  });
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
