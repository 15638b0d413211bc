// Do single precision and the depth buffer hold what is needed, and does the bias fit the texels?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/travel.hpp"
#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

/// Calls `use` with each point that the map serves.
template <typename Use>
void for_each_served(const LightLooks& looks, std::size_t map, Use&& use) {
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0 || looks.chosen[p] != static_cast<int>(map)) continue;
    if (looks.of[map][p].inside()) use(p, looks.of[map][p]);
  }
}

/// Where the shader finds the point, in single precision: the matrix and the point are rounded, and so is
/// each step.
glm::dvec2 rounded_texel(const CapturedMap& map, const glm::dvec3& point) {
  const glm::mat4 m(map.clip_from_world);
  const glm::vec4 clip = m * glm::vec4(glm::vec3(point), 1.0f);
  const glm::dvec2 ndc = glm::dvec2(clip) / static_cast<double>(clip.w);
  return (ndc * 0.5 + 0.5) * glm::dvec2(map.width, map.height);
}

/// Growth of depth from one step of the depth buffer to the next, 0..1.
double depth_step(int bits) {
  // Single precision has 24 bits below 1.
  return std::exp2(-static_cast<double>(bits == 0 ? 24 : bits));
}

void check_matrix_precision(const LightLooks& looks, std::size_t map, FindingList& out) {
  std::vector<double> off;
  double most = 0.0;
  std::size_t worst = 0;
  for_each_served(looks, map, [&](std::size_t p, const Look& look) {
    const glm::dvec2 moved = glm::abs(rounded_texel(looks.map_at(map), looks.seen->points[p]) - look.texel);
    off.push_back(std::max(moved.x, moved.y));
    if (off.back() > most) {
      most = off.back();
      worst = p;
    }
  });
  constexpr double kMoves = 0.25;  // texels: an edge then wanders by a quarter of its stairs
  const double typical = quantile(off, 0.95);
  if (!(typical > kMoves)) return;
  Finding finding = finding_of(FindingKind::matrix_precision, looks, map, typical, "texels");
  finding.pixel = looks.seen->pixels[worst];
  finding.what = "In single precision, look-ups in " + map_name(looks, map) + " land " + digits(typical) +
                 " texels off (95th percentile).";
  finding.change =
      "Hand the shader a matrix for points relative to the camera (rebased, in C gnomon_rebased).";
  out.add(finding);
}

/// Points of one map that have one fault of the bias, and the worst of them.
struct FaultyBias {
  std::vector<double> sizes;
  double worst = 0.0;
  std::size_t worst_point = 0;
  void add(std::size_t point, double size, double badness) {
    sizes.push_back(size);
    if (!(badness > worst)) return;
    worst = badness;
    worst_point = point;
  }
};

struct BiasFaults {
  std::size_t counted = 0;                      // points on slopes that matter
  FaultyBias small, large;                      // shares of what is needed; gaps, world units
  std::vector<double> missing, missing_normal;  // along the light and along the normal, texels
  std::vector<double> times;                    // of what is needed, where it is too large
  double side = 0.0;                            // of a texel: the median, world units
  [[nodiscard]] double share(const FaultyBias& faulty) const {
    return static_cast<double>(faulty.sizes.size()) / static_cast<double>(std::max<std::size_t>(counted, 1));
  }
  /// Fewer are an edge of a surface or two.
  [[nodiscard]] bool matters(const FaultyBias& faulty) const {
    return faulty.sizes.size() >= 5 && share(faulty) > 0.05;
  }
};

BiasFaults bias_faults(const LightLooks& looks, std::size_t map_index) {
  const CapturedMap& map = looks.map_at(map_index);
  const Light& light = looks.source();
  const Camera& camera = looks.frame->camera;
  // Beyond it, shading leaves next to no light that a shadow could take.
  constexpr double kSteepest = 0.2425;  // cosine: tan 4
  BiasFaults faults;
  std::vector<double> sides;
  for_each_served(looks, map_index, [&](std::size_t p, const Look& look) {
    const glm::dvec3 normal = looks.seen->normals[p];
    const double cosine = -glm::dot(normal, travel_at(light, looks.seen->points[p]));
    if (!(cosine > kSteepest)) return;
    ++faults.counted;
    const double have = bias_at(map, look, cosine, normal), need = needed_bias(map, look, cosine, normal);
    const double side = texel_side(look);
    // A surface across the light needs next to nothing.
    constexpr double kEnough = 0.8, kLeast = 0.1;
    if (have < kEnough * need && need > kLeast * side) {
      faults.small.add(p, have / need, 1.0 - have / need);
      faults.missing.push_back((need - have) / side);
      faults.missing_normal.push_back((need - have) / side * cosine);
      sides.push_back(side);
    }
    // At the foot of a wall that stands on the surface.
    const double gap = have * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double pixel =
        (camera.top - camera.bottom) / camera.height * (camera.orthographic ? 1.0 : looks.seen->depths[p]);
    // A wide kernel blurs what a gap of its own size would show.
    const double blur = std::max(1.0, 0.5 + map.filter_texels) * side;
    constexpr double kTimesNeeded = 4.0, kPixels = 3.0;
    if (have > kTimesNeeded * std::max(need, blur) && gap > kPixels * pixel) {
      faults.large.add(p, gap, gap);
      faults.times.push_back(have / std::max(need, blur));
    }
  });
  faults.side = quantile(sides);
  return faults;
}

}  // namespace

double texel_side(const Look& look) {
  return std::sqrt(glm::length(glm::cross(look.texel_x, look.texel_y)));
}

double bias_at(const CapturedMap& map, const Look& look, double cosine, const glm::dvec3& normal) {
  const CapturedBias b = map.bias.value_or(CapturedBias{});
  const double side = texel_side(look), sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double per_depth = look.depth_per_world > 0.0 ? 1.0 / look.depth_per_world : 0.0;
  const double growth =
      std::max(std::abs(glm::dot(look.texel_x, normal)), std::abs(glm::dot(look.texel_y, normal))) / cosine;
  return b.world + b.depth * per_depth + b.texels * side + b.slope_texels * side * sine / cosine +
         b.slope_factor * growth + (b.normal_world + b.normal_texels * side) / cosine;
}

double needed_bias(const CapturedMap& map, const Look& look, double cosine, const glm::dvec3& normal) {
  if (map.bias && map.bias->follows_plane) return 0.0;
  const double reach = 0.5 + map.filter_texels;
  return reach * (std::abs(glm::dot(look.texel_x, normal)) + std::abs(glm::dot(look.texel_y, normal))) /
         cosine;
}

void check_precision(const Capture&, const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    if (broken[i]) continue;
    check_matrix_precision(looks, i, out);
    const CapturedMap& map = looks.map_at(i);
    std::vector<double> steps, shares;
    for_each_served(looks, i, [&](std::size_t p, const Look& look) {
      if (!(look.depth_per_world > 0.0)) return;
      const double step = depth_step(map.depth_bits) / look.depth_per_world;
      // Without a normal, as if the surface faced the light: what a slope adds does not count.
      const std::vector<glm::dvec3>& normals = looks.seen->normals;
      const glm::dvec3 normal = normals.empty() ? glm::dvec3(0.0) : normals[p];
      const double cosine =
          normals.empty() ? 1.0 : -glm::dot(normal, travel_at(looks.source(), looks.seen->points[p]));
      const double bias = bias_at(map, look, cosine, normal);
      constexpr double kHarmless = 0.05;  // of a texel's side
      steps.push_back(step);
      shares.push_back(step / std::max(bias, kHarmless * texel_side(look)));
    });
    const double share = quantile(shares);
    if (!(share > 1.0) || map.stores_back) continue;
    Finding finding = finding_of(FindingKind::depth_precision, looks, i, quantile(steps), "world units");
    finding.what = "Steps of depth in " + map_name(looks, i) + " are " + digits(quantile(steps)) +
                   " world units, " + digits(share) + " times what its bias allows.";
    finding.change = "Bring near and far plane together, take more bits, or raise the bias above a step.";
    out.add(finding);
  }
}

void check_bias(const Capture&, const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  if (looks.seen->normals.empty()) return;
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    // Of back faces, thickness is the bias.
    if (broken[i] || looks.map_at(i).stores_back) continue;
    const BiasFaults faults = bias_faults(looks, i);
    if (faults.matters(faults.small)) {
      const double share = faults.share(faults.small);
      Finding finding = finding_of(FindingKind::bias_small, looks, i, share, "share",
                                   looks.seen->pixels[faults.small.worst_point]);
      finding.what = "Acne is likely on " + percent(share) + " of what " + map_name(looks, i) + " serves: " +
                     (looks.map_at(i).bias ? "the bias there is " + digits(quantile(faults.small.sizes)) +
                                                 " of what a texel and the filter need."
                                           : "the capture gives it no bias.");
      const double normal = quantile(faults.missing_normal, 0.95);
      finding.change = std::string(looks.map_at(i).bias ? "Add" : "Say maps[].bias if there is one, or add") +
                       " a normal offset of " + digits(normal * faults.side) + " world units (" +
                       digits(normal) + " texels), or " + digits(quantile(faults.missing, 0.95)) +
                       " texels along the light there (slope bias), or follow the receiver's plane.";
      out.add(finding);
    }
    if (faults.matters(faults.large)) {
      const double gap = quantile(faults.large.sizes);
      Finding finding = finding_of(FindingKind::bias_large, looks, i, gap, "world units",
                                   looks.seen->pixels[faults.large.worst_point]);
      finding.what = "Shadows in " + map_name(looks, i) + " begin " + digits(gap) +
                     " world units off the foot of their casters, on " + percent(faults.share(faults.large)) +
                     " of what it serves.";
      finding.change = "Lower the bias: it is " + digits(quantile(faults.times)) +
                       " times what texels and filter need there, and four times would do.";
      out.add(finding);
    }
  }
}

}  // namespace gnomon::judge
