// Why can the viewer not draw a state?
#include "refusals.hpp"

#include <fmt/core.h>

#include <string_view>

#include "gnomon/extend/shape.hpp"
#include "gnomon/render/probe.hpp"
#include "identifier_word.hpp"

namespace gnomon::tool::view {

std::string refusal_of_pages(const Settings& settings) {
  if (settings.identifiers)
    return fmt::format("no pages with {}: they number what whole maps see", kIdentifiers);
  if (settings.linear_depth) return "no pages with linear_depth: pages store depths divided by w";
  return {};
}

std::string memory_refusal(const PlanOptions& plan, const Settings& settings, bool panes) {
  constexpr double kSurelyThere = 256.0 * 1024 * 1024;
  const int maps = plan.cascades, size = plan.resolution.max_size;
  constexpr double kDepthAndNumber = 8.0;
  const double texel = (settings.identifiers ? kDepthAndNumber : render::bytes_per_texel(settings.filter)) +
                       (panes ? render::kPaneTexelBytes : 0.0);
  if (1.0 * size * size * maps * texel <= kSurelyThere) return {};
  const render::FittingMaps fitting = render::largest_maps(size, maps, texel, 0.0);
  if (fitting.size >= size) return {};
  return fmt::format("map_size {}: {} such maps do not fit ({})", size, maps, fitting.why);
}

std::string refusal_of_all_lights(const State& state, const Settings& settings) {
  constexpr const char* kAll = "all lights of the file";
  if (state.view != View::lit)
    return fmt::format("view {} is of one light, not of {}",
                       view_names()[static_cast<std::size_t>(state.view)].name, kAll);
  if (state.comparison != Comparison::off && state.b_is_truth)
    return fmt::format("exact rays are of one light, not of {}", kAll);
  const struct {
    bool on;
    std::string_view name;
  } of_one_light[] = {
      {state.frozen.has_value(), "frozen camera"},      {settings.pages.on(), "pages"},
      {settings.identifiers.has_value(), kIdentifiers}, {settings.visible_depths, "visible_depths"},
      {settings.linear_depth, "linear_depth"},          {settings.history, "history"}};
  for (const auto& setting : of_one_light)
    if (setting.on) return fmt::format("no {} with {}", setting.name, kAll);
  if (!settings.plan.warp.shape->affine)
    return fmt::format("no {} with shape {}: its maps bend lines", kAll, settings.plan.warp.shape->name);
  return {};
}

}  // namespace gnomon::tool::view
