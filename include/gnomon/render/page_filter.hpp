// Which filters work on pages, and why do the others not?
#pragma once

#include <string_view>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// The settings that frames of pages are drawn with; Renderer::prepare takes them. A level spans the
/// depths of all casters. So an exponent over its range is larger than over a cascade's for a fall-off of the
/// same length. `esm` with its default `c` and a fall-off takes the exponent that the fall-off needs.
[[nodiscard]] FilterSettings settings_for_pages(const FilterSettings& settings) noexcept;

/// Why frames of pages cannot be drawn with these settings: one line; empty where they can. A page has
/// depths, and the texels that a filter stores and blurs within its slot. It has no mip-maps, no sums and no
/// pyramid of depths, and nothing chosen from all depths of a map.
[[nodiscard]] std::string_view page_filter_refusal(const FilterSettings& settings) noexcept;

}  // namespace gnomon::render
