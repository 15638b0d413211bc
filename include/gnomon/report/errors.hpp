// How wrong is a shadow mask, and in which way?
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::report {

/// A mask against the truth, pixel by pixel. Rates are shares in [0,1]; 0 where there is nothing to count.
struct MaskErrors {
  std::uint64_t pixels = 0;   ///< compared with the hard truth
  double false_lit = 0.0;     ///< of them: truly in shadow, more than half lit in the mask
  double false_shadow = 0.0;  ///< of them: truly lit, at most half lit in the mask
  double mean_error = 0.0;    ///< |mask - soft truth|, mean over the pixels that has a value for
  /// Mean of the mask over the `deep_pixels` that no part of the kernel sees lit: light that leaks through.
  double leaking = 0.0;
  std::uint64_t deep_pixels = 0;  ///< counted in `leaking`
  /// Mean of 1 - mask over the `open_pixels` that every part of the kernel sees lit: acne and false shadow.
  double darkening = 0.0;
  std::uint64_t open_pixels = 0;  ///< counted in `darkening`
  /// Share of the `pixels` that are open, and darker by over a tenth: acne, below one half as well.
  double too_dark = 0.0;
  /// Share of the `pixels` that are deep, and brighter by over a tenth: leaks, below one half as well.
  double too_light = 0.0;
};

/// All spans are equally long. `mask`: 1 lit .. 0 in shadow. `hard`: 1, 0, or negative where undecided.
/// `soft`: 1 .. 0, or negative where undecided.
[[nodiscard]] MaskErrors mask_errors(std::span<const float> mask, std::span<const float> hard,
                                     std::span<const float> soft) noexcept;

/// The truth where all pixels within `reach` to each side have the same, else -1: as `soft` for masks whose
/// kernel is not known. `truth` has `width` values in a row.
[[nodiscard]] std::vector<float> uniform_truth(std::span<const float> truth, int width, int reach);

/// Pixels whose shadow changes although the truth at the same world point does not. A share of those that
/// are decided in both frames. `before` and `after` are masks at the same points; a change is one by more
/// than half. Zero for a stable technique.
[[nodiscard]] double excess_flips(std::span<const float> before, std::span<const float> after,
                                  std::span<const float> truth_before,
                                  std::span<const float> truth_after) noexcept;

/// A mask against the light over whole pixels (trace::pixel_reference). Shares in [0,1]; 0 where there is
/// nothing to count.
struct PixelErrors {
  std::uint64_t pixels = 0;      ///< that have a reference
  std::uint64_t several = 0;     ///< of them: pixels that show several surfaces
  double error = 0.0;            ///< |mask - reference|, mean over all of them
  double one_surface = 0.0;      ///< the same over pixels that show one surface
  double twinkle = 0.0;          ///< twinkling() of the pixels of the picture
  double twinkle_tracked = 0.0;  ///< twinkling() of points that the eye follows from frame to frame
  /// Equal in all members.
  bool operator==(const PixelErrors&) const = default;
};
/// Sets all but the two of twinkling. All spans are equally long. `light`: 1 .. 0, negative
/// where there is no reference. `several`: 1 where a pixel shows several surfaces.
[[nodiscard]] PixelErrors pixel_errors(std::span<const float> mask, std::span<const float> light,
                                       std::span<const std::uint8_t> several) noexcept;

/// Share of pixels that change from one frame to the next by over a quarter more than the light over the
/// pixel does. `light_before` and `light_after` are that light, negative where there is none: such pixels do
/// not count. Zero for a mask that is the light itself. A quarter is beyond the sampling error of sixteen
/// rays.
[[nodiscard]] double twinkling(std::span<const float> before, std::span<const float> after,
                               std::span<const float> light_before,
                               std::span<const float> light_after) noexcept;

/// The aliasing error over the pixels of a frame.
struct PixelAliasing {
  double p50 = 0.0, p95 = 0.0, max = 0.0;  ///< of m, screen pixels per texel
  double share_undersampled = 0.0;         ///< m > 1
  std::uint64_t pixels = 0;                ///< that counted
};
/// Statistics of m where it is above zero; infinities count. `m` holds one value per pixel, 0 or negative
/// where there is none.
[[nodiscard]] PixelAliasing pixel_aliasing(std::span<const float> m);

}  // namespace gnomon::report
