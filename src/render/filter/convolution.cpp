// Convolution shadow maps: the comparison as a Fourier series whose terms part into one of the map and one of
// the receiver, so that the map's may be blurred.
// Based on: Annen, Mertens, Bekaert, Seidel, Kautz, "Convolution Shadow Maps", 2007. Offset and scaling
// against the light that leaks where things touch, and the attenuation of the ringing, are the paper's.
#include "filter/convolution.hpp"
#include "gnomon/study/bias.hpp"

#include <numbers>

namespace gnomon::render {
namespace {

constexpr int kMaxTerms = 16;
constexpr FilterOption kOptions[] = {
    {"order", 16, 1, kMaxTerms, "terms of the series, two channels each: more terms make sharper contacts",
     true},
    {"attenuation", 2.5, 0.0, 4.0,
     "damping: term k is weighted by exp(-attenuation (k/order)^2); larger rings less, softens contacts"},
    {"offset", 0.0, 0.0, 1.0,
     "receiver offset towards the light, in half steps of the series: 1/(2 order) of the depth range"},
    {"scale", 2.0, 1.0, 4.0,
     "factor of the result before it is clamped to 1: without an offset, 2 keeps lit surfaces lit"},
    option::falloff_world,
    option::falloff_kernel(0.0),
};
/// `widening`: by how much more than the series' half step shadows take to fade in, as a share of it.
constexpr std::string_view kOwnOptions[] = {"widening"};
constexpr OptionPlaces kPlace(kOptions, kOwnOptions);
constexpr TexelFormat kFormats[] = {TexelFormat::unorm8, TexelFormat::fp16, TexelFormat::unorm16,
                                    TexelFormat::fp32};

int order_of(const FilterSettings& settings) noexcept {
  return static_cast<int>(settings.option[kPlace("order")]);
}
int channels(const FilterSettings& settings) noexcept {
  return 2 * order_of(settings);
}

double whole_range_of(const FilterSettings& settings) noexcept;

void fit_map(FilterSettings& settings, const MapDepths& depths) noexcept {
  const double wanted = falloff_of<kPlace>(settings).length(depths);
  const double has = depths.range_world * fourier_half_step(order_of(settings)) / whole_range_of(settings);
  settings.option[kPlace("widening")] = wanted > has && has > 0.0 ? wanted / has - 1.0 : 0.0;
}

/// Part of the period that depths 0..1 take: a difference of 1, moved by the offset, must not reach the
/// series' next step. Of orders 1 and 2 that would take all contrast; they keep three quarters, and go wrong
/// at the largest differences.
double whole_range_of(const FilterSettings& settings) noexcept {
  constexpr double kMaxGivenUp = 0.25;
  constexpr double kStepReach = 3.5;  // half steps: the attenuated step is that wide to either side
  const double wanted =
      (settings.option[kPlace("offset")] + kStepReach) * fourier_half_step(order_of(settings));
  return 1.0 - std::min(wanted, kMaxGivenUp);
}
/// A longer fall-off takes a smaller part: the series' step is then wider in depth.
double range_of(const FilterSettings& settings) noexcept {
  return whole_range_of(settings) / (1.0 + settings.option[kPlace("widening")]);
}

StoredTexel store(double depth, const glm::dvec2&, const FilterSettings& settings) noexcept {
  StoredTexel texel = fourier_basis(range_of(settings) * depth, order_of(settings));
  if (!is_unsigned_unit(settings.format)) return texel;
  for (int i = 0; i < channels(settings); ++i) {
    const auto channel = static_cast<std::size_t>(i);
    texel[channel] = 0.5 * texel[channel] + 0.5;
  }
  return texel;
}

double visibility(const StoredTexel& texel, const FilterLookup& lookup, const FilterSettings& settings) {
  StoredTexel basis = texel;
  if (is_unsigned_unit(settings.format)) {
    for (double& channel : basis) channel = 2.0 * channel - 1.0;
  }
  const int order = order_of(settings);
  // On a slanted plane half of the kernel lies in front of the point, and its share would be right, and dark.
  constexpr double kSlant = 0.5;
  const double slant = kSlant * glm::dot(glm::abs(lookup.depth_gradient), lookup.box);
  const double depth = range_of(settings) * std::min(lookup.depth - slant, 1.0);
  const double offset = settings.option[kPlace("offset")] * fourier_half_step(order);
  return saturate(settings.option[kPlace("scale")] *
                  fourier_lit(basis, depth - offset, {order, settings.option[kPlace("attenuation")]}));
}

}  // namespace

StoredTexel fourier_basis(double depth, int order) noexcept {
  StoredTexel basis{};
  for (int k = 1; k <= order; ++k) {
    const double angle = std::numbers::pi * (2 * k - 1) * depth;
    basis[static_cast<std::size_t>(2 * k - 2)] = std::cos(angle);
    basis[static_cast<std::size_t>(2 * k - 1)] = std::sin(angle);
  }
  return basis;
}

double fourier_lit(const StoredTexel& basis, double depth, const FourierStep& step) noexcept {
  const StoredTexel receiver = fourier_basis(depth, step.order);
  double sum = 0.5;
  for (int k = 1; k <= step.order; ++k) {
    const auto cosine = static_cast<std::size_t>(2 * k - 2), sine = cosine + 1;
    const double share = static_cast<double>(k) / step.order;
    const double weight =
        2.0 * std::exp(-step.attenuation * share * share) / (std::numbers::pi * (2 * k - 1));
    sum += weight * (receiver[cosine] * basis[sine] - receiver[sine] * basis[cosine]);
  }
  return sum;
}

const Filter filters::convolution{
    .info =
        {
            .name = "convolution",
            .summary = "blurs without light bleeding: a Fourier series of the comparison; needs much memory",
            .source = "Annen, Mertens, Bekaert, Seidel, Kautz 2007, Convolution shadow maps",
            .reads = MapRead::filtered,
            .bias_class = FilterClass::prefiltered,
            .options = kOptions,
            .own_options = kOwnOptions,
            .formats = kFormats,
            .may_mipmap = true,
            .terms_option = kPlace("order"),
            .channels = channels,
        },
    .reference =
        {
            // The attenuated series of order 16 stays within 0.01 of its step beyond it; 8 bits may round by
            // 0.0084, after each half of the blur; all of it is scaled by 2.
            .tolerance = 0.06,
            .contact = 0.1,
            .store = store,
            .visibility = visibility,
        },
    .hooks =
        {
            .fit_map = fit_map,
        },
};

}  // namespace gnomon::render
