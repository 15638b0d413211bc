// Exponential shadow maps: the step of the shadow test becomes exp(c (z - d)), which parts into a factor of
// the receiver and one of the map, and that one may be blurred. Based on: Annen, Mertens, Seidel, Flerackers,
// Kautz, "Exponential Shadow Maps", 2008; blurred in the logarithm: Salvi, "Rendering Filtered Shadows with
// Exponential Shadow Maps", ShaderX6, 2008.
//
// Beyond the paper: over a slanted receiver the kernel's depths rise and fall, and their exponentials' mean
// lies above that of the middle by sinh(s) / s, with s = c times half the rise: known, and divided out. What
// the plan's bias lifts the receiver by is no failure, either. Else nearly all of a lit slope would count as
// failed, and a mip-map's wide kernel be read as four texels.
//
// Texels hold exp(c z) where 32-bit floats do: hardware then averages them. For larger c they hold
// ln(mean of exp(c z)) / c, which never overflows.
//
// Shadows fade over ln(20) / c of the depth range in front of the receiver: contacts leak below that. The
// mean is right only where no texel of the kernel lies behind the receiver; where one does, by either of the
// paper's classifications, the four texels round the point are compared instead.
#include <glm/common.hpp>

#include "filter/filter_parts.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"c", 160.0, 1.0, 10000.0,
     "largest exponent over the depth range: larger leaks less; above 160 slower; at most 80 in 16 bits"},
    {"fallback", 1.0, 0.0, 2.0,
     "2x2 comparisons where the mean fails: 0 never, 1 by threshold, 2 by largest depth", true},
    {"epsilon", 0.02, 0.0, 1.0,
     "visibility above 1 that still counts as valid; beyond it the fallback is used"},
    option::falloff_world,
    option::falloff_kernel(4.0),
    {"failures", 0.0, 0.0, 1.0, "1 shows where the mean fails by `fallback`, dark, in place of shadows",
     true},
};
constexpr OptionPlaces kPlace(kOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::fp16, TexelFormat::unorm16};

/// 16 bits hold the soft maximum to 2^-12 of the range: at c = 80 that is 2 % of the answer.
constexpr double kMaxC16 = 80.0;
/// exp(c (z - 1/2)) and a kernel's sum of it stay within 32-bit floats up to here, with a factor of 100 left.
constexpr double kMaxPlainC = 160.0;

void settle(FilterSettings& settings) noexcept {
  if (settings.format != TexelFormat::fp32)
    settings.option[kPlace("c")] = std::min(settings.option[kPlace("c")], kMaxC16);
}

void fit_map(FilterSettings& settings, const MapDepths& depths) noexcept {
  settings.option[kPlace("c")] =
      exponent_for(settings.option[kPlace("c")], falloff_of<kPlace>(settings), depths);
}

/// A level's range is that of all casters: the largest plain exponent would fade shadows in over a fiftieth
/// of a city's height.
void for_pages(FilterSettings& settings) noexcept {
  const Falloff falloff = falloff_of<kPlace>(settings);
  const bool falls_off = falloff.world > 0.0 || falloff.kernels > 0.0;
  if (falls_off && settings.format == TexelFormat::fp32 &&
      settings.option[kPlace("c")] == kOptions[kPlace("c")].fallback)
    settings.option[kPlace("c")] = kOptions[kPlace("c")].max;
}

/// Texels hold the exponential itself, else its logarithm over c.
bool is_plain(const FilterSettings& settings) noexcept {
  return settings.format == TexelFormat::fp32 && settings.option[kPlace("c")] <= kMaxPlainC;
}

int channels(const FilterSettings&) noexcept {
  return 1;
}

bool needs_depth_max(const FilterSettings& settings) noexcept {
  return settings.option[kPlace("fallback")] == 2.0;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  return {is_plain(settings) ? std::exp(settings.option[kPlace("c")] * (depth - 0.5)) : depth};
}

StoredTexel nothing(const FilterSettings& settings) noexcept {
  return {is_plain(settings) ? 0.0 : -1e30};
}

void join(StoredTexel& sum, const StoredTexel& texel, double weight,
          const FilterSettings& settings) noexcept {
  if (is_plain(settings)) {
    sum[0] += weight * texel[0];
    return;
  }
  const double c = settings.option[kPlace("c")], largest = std::max(sum[0], texel[0]);
  sum[0] =
      largest + std::log(std::exp(c * (sum[0] - largest)) + weight * std::exp(c * (texel[0] - largest))) / c;
}

/// ln(sinh(s) / s) for s >= 0.
double log_mean_over(double s) noexcept {
  constexpr double kSeries = 0.5;  // below it the two terms are good to 6e-6
  return s < kSeries ? s * s * (1.0 / 6.0 - s * s / 180.0)
                     : s + std::log((1.0 - std::exp(-2.0 * s)) / (2.0 * s));
}

/// Depth along the light of a texel's longest side.
double depth_of_texel_side(const FilterLookup& lookup) noexcept {
  const glm::dmat2& m = lookup.texels_per_world;
  const double side = std::max(std::hypot(m[0].x, m[1].x), std::hypot(m[0].y, m[1].y)) /
                      std::abs(m[0].x * m[1].y - m[1].x * m[0].y);
  return side * std::abs((lookup.ray.z - std::min(lookup.depth, 1.0) * lookup.ray.w) / lookup.ray.y);
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  const double c = settings.option[kPlace("c")], fallback = settings.option[kPlace("fallback")],
               epsilon = settings.option[kPlace("epsilon")];
  const double depth = std::min(lookup.depth, 1.0) - rounding_of(settings.format);
  const double stored = is_plain(settings) ? 0.5 + std::log(texel[0]) / c : texel[0];
  const glm::dvec2 rise = glm::abs(lookup.depth_gradient);
  const double plane = log_mean_over(c * rise.x * lookup.box.x) + log_mean_over(c * rise.y * lookup.box.y);
  const double log_lit = c * (stored - depth) - plane;
  // Slope bias and normal offset lift receivers off their plane by up to half a texel of its rise each,
  // constant bias by a share of a texel.
  constexpr double kConstantBias = 0.1;  // texels: twice BiasOptions' own
  const double allowed =
      std::log(1.0 + epsilon) + c * (rise.x + rise.y + kConstantBias * depth_of_texel_side(lookup));
  // The pyramid's texels reach less than five half sides of the kernel from the point.
  constexpr double kPyramidReach = 5.0;
  bool fails = fallback == 1.0 && log_lit > allowed;
  if (fallback == 2.0)
    fails = depth + allowed / c + kPyramidReach * glm::dot(rise, lookup.box) < lookup.depth_max;
  if (settings.option[kPlace("failures")] > 0.5) return fails ? 0.0 : 1.0;
  return saturate(fails ? compare_2x2(lookup, lookup.position) : std::exp(log_lit));
}

}  // namespace

const Filter filters::esm{
    .info =
        {
            .name = "esm",
            .summary = "wide blurs in one channel: an exponential of depth; light leaks at contacts",
            .source = "Annen et al. 2008, Exponential shadow maps",
            .reads = MapRead::joined,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .channels = channels,
            .settle = settle,
        },
    .reference =
        {
            .tolerance = 0.01,  // exp(-80 * 0.1) is below it by far
            .contact = 0.1,
            .store = store,
            .join = join,
            .nothing = nothing,
            .visibility = visibility,
        },
    .hooks =
        {
            .averages = is_plain,
            .fit_map = fit_map,
            .for_pages = for_pages,
            .needs_depth_max = needs_depth_max,
        },
};

}  // namespace gnomon::render
