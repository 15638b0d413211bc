// Widgets for the options of a plan and of a filter, made from the tables that command lines read.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

#include "gnomon/casefile/plan_fields.hpp"
#include "gnomon/light.hpp"
#include "gnomon/render/filter.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

/// A part of the window's own layout: nothing moves or resizes it.
inline constexpr ImGuiWindowFlags kFixedWindow = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                                                 ImGuiWindowFlags_NoSavedSettings;

/// One option of a plan: its widget, its help as a tooltip, and its reset where it is not the default.
void edit_plan_field(const PlanField& field, PlanOptions& options);
/// The filter, and everything that this filter can be set to.
void edit_filter(render::FilterSettings& settings);
/// Pages in place of maps: their policy, and with one its options.
void edit_pages(PageSetting& pages);
/// The sun on a dome seen from above: its middle is the zenith, its edge the horizon, north (-Z) above.
void edit_sun_dome(LightPlacement& sun, float side);
/// A position or direction.
void edit_vector(const char* label, glm::dvec3& v, double speed, const char* help);
/// One of several names; true where it was changed.
bool choose(const char* label, int& index, const std::vector<std::string>& names,
            const std::vector<std::string>& help = {});
/// Text that appears over the last widget.
void tooltip(std::string_view text);

}  // namespace gnomon::tool::view
