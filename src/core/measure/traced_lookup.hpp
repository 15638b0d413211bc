// What does a look-up in a map find at a surface point, where a search stands for the map's depths?
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/options.hpp"
#include "gnomon/shadow_map.hpp"
#include "gnomon/study/expected_error.hpp"
#include "measure/lookup_bias.hpp"
#include "measure/texel_box.hpp"

namespace gnomon {

/// What a search found on the light's rays through the middles of texels. Pixels side by side read the same
/// ones.
class FoundOccluders {
 public:
  explicit FoundOccluders(const OccluderSearch& search) noexcept : search_(search) {}
  /// OccluderSearch::distance of a point on the ray through the middle of the texel. `along`: how far along
  /// the light the point is, from any place that is the same for the whole map.
  [[nodiscard]] double distance(const ShadowMap& map, const glm::dvec2& texel, const glm::dvec3& point,
                                double along) noexcept {
    Found& found = found_[place_of(texel)];
    if (found.map != &map || found.texel != texel)
      found = {&map, texel, along - search_.distance(search_.scene, point)};
    return along - found.along;
  }

 private:
  struct Found {
    const ShadowMap* map = nullptr;
    glm::dvec2 texel{0.0};
    double along = 0.0;  ///< of the occluder; infinite: none
  };
  static constexpr std::size_t kSide = 16;
  /// A square of texels has one place for each.
  [[nodiscard]] static std::size_t place_of(const glm::dvec2& texel) noexcept {
    const auto in_side = [](double x) {
      return static_cast<std::size_t>(static_cast<std::int64_t>(x)) % kSide;
    };
    return in_side(texel.x) + kSide * in_side(texel.y);
  }

  const OccluderSearch& search_;
  std::array<Found, kSide * kSide> found_{};
};

/// The comparisons of shaders/library/receiver.glsl: the depth of each texel with the plane of the surface
/// over the texel's middle, less the bias.
class TracedLookup {
 public:
  /// `light_world`: of the map. `normal`: unit, towards the side that is seen.
  TracedLookup(FoundOccluders& found, const BiasOptions& bias, const ShadowMap& map,
               const glm::dvec4& light_world, const glm::dvec3& point, const glm::dvec3& normal) noexcept
      : found_(found), map_(map), light_world_(light_world) {
    // Asked first: the Jacobian divides by it.
    const glm::dmat4& m = map.clip_from_world;
    if (!(w_at(m, point) > 0.0)) return;
    const TexelGrid grid = map.texels();
    const TexelJacobian on_surface = texel_jacobian(m, grid, point);
    light_ = -safe_normalize(glm::dvec3(light_world) - light_world.w * point, normal);
    const double cosine = -glm::dot(normal, light_), sine = std::sqrt(max_of(1.0 - cosine * cosine, 0.0));
    const double longer = texel_sides(on_surface, light_).longer;
    if (!(longer > 0.0) || !(cosine > 0.0)) return;
    BiasOptions along_light = bias;
    along_light.normal_offset_texels = 0.0;
    bias_world_ = lookup_bias_world(along_light, on_surface, normal, light_);
    slope_ = normal * (min_of(1.0, kSteepestPlane * cosine / max_of(sine, cosine)) / cosine);
    position_ = point + normal * (bias.normal_offset_texels * longer * sine);
    if (!(w_at(m, position_) > 0.0)) return;
    const TexelJacobian texel = texel_jacobian(m, grid, position_);
    side_ = texel_sides(texel, light_);
    w_per_world_ = glm::dvec3(m[0][3], m[1][3], m[2][3]) / texel.w;
    read_ = grid.place({texel.ndc_x, texel.ndc_y}).texel;
    known_ = side_.longer > 0.0 && std::abs(read_.x) < kFarthestTexel && std::abs(read_.y) < kFarthestTexel;
  }
  /// False where the map is singular, or the surface faces away from the light.
  [[nodiscard]] bool known() const noexcept { return known_; }
  /// 1 lit or 0 dark, of the texel that is read.
  [[nodiscard]] double hard() const noexcept { return lit(glm::floor(read_) + 0.5); }
  /// Mean over a box of texels round the look-up; of corners and middle alone where they agree.
  [[nodiscard]] double mean(double half_side) const noexcept {
    const glm::dvec2 first = glm::floor(read_ - half_side), last = glm::ceil(read_ + half_side) - 1.0;
    const double own = hard();
    const std::array<glm::dvec2, 4> corners{first, glm::dvec2(last.x, first.y), glm::dvec2(first.x, last.y),
                                            last};
    bool even = true;
    for (const glm::dvec2& corner : corners) even = even && lit(corner + 0.5) == own;
    if (even) return own;
    const double mean =
        mean_over_box(read_, half_side, 0.0, [&](const glm::dvec2& middle) { return lit(middle); });
    return mean < 0.0 ? own : mean;
  }

 private:
  [[nodiscard]] double lit(const glm::dvec2& texel) const noexcept {
    const glm::dvec2 way = texel - read_;
    const glm::dvec3 straight = side_.x * way.x + side_.y * way.y;
    // Under a warp texels grow along the way; none lies beyond the horizon.
    const double growth = 1.0 - glm::dot(w_per_world_, straight);
    if (!(growth > 0.0)) return 1.0;
    const glm::dvec3 across = straight / growth;
    // Back onto the plane, along the light.
    const glm::dvec3 middle = position_ + across + light_ * glm::dot(slope_, across);
    const glm::dvec3 from(light_world_);
    const double along =
        light_world_.w > 0.0 ? glm::length(middle - from / light_world_.w) : glm::dot(middle, light_);
    return found_.distance(map_, texel, middle, along) > bias_world_ ? 0.0 : 1.0;
  }

  /// Beyond it there are no whole texels.
  static constexpr double kFarthestTexel = 1e9;

  FoundOccluders& found_;
  const ShadowMap& map_;
  const glm::dvec4& light_world_;
  glm::dvec3 position_{0.0}, light_{0.0};  ///< of the look-up; the way the light travels
  glm::dvec3 slope_{0.0};                  ///< how far the plane falls along the light, for each way across
  TexelSides side_;
  glm::dvec3 w_per_world_{0.0};  ///< share of w by which it grows along world units
  glm::dvec2 read_{0.0};         ///< where the look-up is, in texels of the map
  double bias_world_ = 0.0;
  bool known_ = false;
};

}  // namespace gnomon
