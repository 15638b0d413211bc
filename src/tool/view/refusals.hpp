// Why can the viewer not draw a state? An empty answer: it can.
#pragma once

#include <string>

#include "state.hpp"

namespace gnomon::tool::view {

/// Refuses settings that need more than a page holds.
[[nodiscard]] std::string refusal_of_pages(const Settings& settings);
/// Refuses maps that exceed the free memory. A driver might end the program instead.
[[nodiscard]] std::string memory_refusal(const PlanOptions& plan, const Settings& settings, bool panes);
/// Refuses settings that all lights of a file cannot share.
[[nodiscard]] std::string refusal_of_all_lights(const State& state, const Settings& settings);

}  // namespace gnomon::tool::view
