// Why can the viewer not draw a state? An empty answer: it can.
#pragma once

#include <string>

#include "state.hpp"

namespace gnomon::tool::view {

/// Of pages: what a page does not hold.
[[nodiscard]] std::string refusal_of_pages(const Settings& settings);
/// Of maps that memory does not take, before a driver is asked for them.
[[nodiscard]] std::string memory_refusal(const PlanOptions& plan, const Settings& settings, bool panes);
/// Of all lights of a file at once.
[[nodiscard]] std::string refusal_of_all_lights(const State& state, const Settings& settings);

}  // namespace gnomon::tool::view
