// Moment shadow maps: four moments of the kernel's depths give the sharpest bound that they allow.
// Based on: Peters, Klein, "Moment Shadow Mapping", 2015; basis of the quantised moments: Peters,
// "Non-linearly Quantized Moment Shadow Maps", 2017, whose linear part it is.
#include <glm/common.hpp>

#include "filter_parts.hpp"
#include "moments.hpp"
#include "variance.hpp"

namespace gnomon::render {
namespace {

constexpr FilterOption kOptions[] = {
    {"bounded", 0.0, 0.0, 1.0,
     "0 Hamburger bound, over all depths; 1 Hausdorff bound, over the map's depth range: darker"},
    {"bleed", 0.1, 0.0, 0.95,
     "visibility up to this counts as bleeding and becomes 0: larger bleeds less, hardens edges"},
    {"bias", 0.0, 0.0, 0.1,
     "share of the widest distribution blended in; never below what the format's rounding needs"},
};
constexpr TexelFormat kFormats[] = {TexelFormat::fp32, TexelFormat::unorm16};

int channels(const FilterSettings&) noexcept {
  return 4;
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  const double u = 2.0 * depth - 1.0, u2 = u * u;
  const Moments b{u, u2, u2 * u, u2 * u2};
  if (!is_unsigned_unit(settings.format)) return {b[0], b[1], b[2], b[3]};
  return {0.5 + 1.5 * b[0] - 2.0 * b[2], 4.0 * (b[1] - b[3]),
          0.5 + 0.86602540378443865 * b[0] - 0.38490017945975052 * b[2], 0.5 * (b[1] + b[3])};
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  Moments b{texel[0], texel[1], texel[2], texel[3]};
  if (is_unsigned_unit(settings.format)) {
    const double x = texel[0] - 0.5, z = texel[2] - 0.5;
    b = {-x / 3.0 + 1.7320508075688772 * z, 0.125 * texel[1] + texel[3], -0.75 * x + 1.299038105676658 * z,
         texel[3] - 0.125 * texel[1]};
  }
  // Below these shares the rounded moments of a flat kernel may be no moments at all (20 000 random kernels).
  const double kRoundings = is_unsigned_unit(settings.format) ? 8.0 : 64.0;
  constexpr Moments kSpreadOut{0.0, 0.375, 0.0, 0.375};  // the widest distribution whose moments are these
  const double bias = std::max(settings.option[2], kRoundings * rounding_of(settings.format));
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += bias * (kSpreadOut[i] - b[i]);
  // On a slanted plane half of the kernel lies in front of the point: the bound would be right, and dark.
  constexpr double kSlant = 0.5;
  const double slant = kSlant * glm::dot(glm::abs(lookup.depth_gradient), lookup.box);
  const double u = 2.0 * std::min(lookup.depth - slant, 1.0) - 1.0;
  const double dark = settings.option[0] > 0.5 ? share_in_front_bounded(b, u) : share_in_front(b, u).share;
  return without_bleeding(saturate(1.0 - dark), settings.option[1]);
}

void settle(FilterSettings& settings) noexcept {
  settings.option[0] = std::round(settings.option[0]);
}

}  // namespace

const Filter filters::msm{
    .info =
        {
            .name = "msm",
            .summary = "wide blurs with little light bleeding: the sharpest bound from four moments of depth",
            .source = "Peters, Klein 2015, Moment shadow mapping",
            .reads = MapRead::filtered,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .channels = channels,
            .settle = settle,
        },
    .reference =
        {
            .tolerance = 0.01,  // what the bias lets through under a contact of a tenth of the depth range
            .contact = 0.1,
            .store = store,
            .visibility = visibility,
        },
};

}  // namespace gnomon::render
