// Which bias is safe with which class of filter, and why.
// Based on: Scherzer, Wimmer, Purgathofer, survey 2011, section 5; Isidoro 2006; Dou et al. 2014; Lauritzen
// 2007 (biasing of moments). Rows on filters that compare are held true by tests/laws/bias_law_test.cpp.
#include <array>
#include <cstddef>

#include "gnomon/bias.hpp"

namespace gnomon {
namespace {

using enum BiasKind;
using enum FilterClass;

constexpr std::size_t kFilters = 4, kBiases = 5;
constexpr std::array<BiasAdvice, kBiases* kFilters> kAdvice = {{
    {constant, single_compare, false, "what a texel's centre needs grows with the slope, without end"},
    {constant, wide_kernel, false, "the same, times the kernel's reach"},
    {constant, blocker_search, false, "the surface itself is found as its own blocker"},
    {constant, prefiltered, true, "averaged moments of a plane are the plane's; rounding is what remains"},

    {slope, single_compare, true, "half a texel of slope reaches the centre from anywhere in the texel"},
    {slope, wide_kernel, true, "with the kernel's radius in it; contact shadows move off by as much"},
    {slope, blocker_search, true, "with the search's radius in it; blockers nearer than that are missed"},
    {slope, prefiltered, true, "moves all moments alike; more than the filter needs"},

    {normal_offset, single_compare, true, "lifts the fragment off its plane by half a texel of slope"},
    {normal_offset, wide_kernel, true, "with the kernel's radius in it; shadows shift along the surface"},
    {normal_offset, blocker_search, true,
     "with the search's radius in it; distances to blockers shrink by it"},
    {normal_offset, prefiltered, true, "a look-up from above the surface; more than the filter needs"},

    {receiver_plane, single_compare, true,
     "the plane's own depth at the texel's centre: adaptive, no epsilon"},
    {receiver_plane, wide_kernel, true, "each tap gets the plane's own depth at its texel's centre"},
    {receiver_plane, blocker_search, true, "each tap gets the plane's own depth; blockers are never missed"},
    {receiver_plane, prefiltered, false,
     "texels are averaged before the comparison: no tap to give a depth to"},

    {adaptive, single_compare, true, "the plane's own depth at the one centre that is compared"},
    {adaptive, wide_kernel, false, "one depth for one centre; for each tap it is the receiver plane"},
    {adaptive, blocker_search, false, "one depth for one centre; for each tap it is the receiver plane"},
    {adaptive, prefiltered, false, "a filtered texel has no centre ray to meet the plane"},
}};

}  // namespace

std::span<const BiasAdvice> bias_advice() noexcept {
  return kAdvice;
}

const BiasAdvice& bias_with_filter(BiasKind bias, FilterClass filter) noexcept {
  return kAdvice[static_cast<std::size_t>(bias) * kFilters + static_cast<std::size_t>(filter)];
}

}  // namespace gnomon
