// The panel's part that shows the last frames as curves, and measured results beside them.
#include <imgui.h>

#include <algorithm>

#include "app.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

void plot(const char* name, const Curve& curve, const char* unit, const char* help) {
  float most = 0.0f;
  for (int i = 0; i < curve.count; ++i) most = std::max(most, curve.value[static_cast<std::size_t>(i)]);
  ImGui::Text("%s  %.3g %s  (most %.3g)", name, static_cast<double>(curve.last()), unit,
              static_cast<double>(most));
  tooltip(help);
  const int first = curve.count < Curve::kLength ? 0 : curve.next;
  ImGui::PushID(name);
  ImGui::PlotLines("##curve", curve.value.data(), curve.count, first, nullptr, 0.0f,
                   std::max(most, 1e-6f) * 1.1f,
                   {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() * 3.0f});
  ImGui::PopID();
}

void last_frames(Drawing& drawing, Display& display) {
  ImGui::TextWrapped("Side A over the last %d drawn frames: move, or let the sun turn.", Curve::kLength);
  plot("plan", drawing.curves.plan, "us", "time of make_plan");
  plot("draw maps", drawing.curves.maps, "ms", "drawing the depth maps");
  plot("prefilter", drawing.curves.prefilter, "ms", "what the filter stores, blurs and sums");
  plot("look-up", drawing.curves.lookup, "ms", "reading the maps for every pixel");
  plot("m p95", drawing.curves.m_p95, "pixels", "aliasing error that 95 % of what is in view stays below");
  plot("texels drawn", drawing.curves.texels, "M", "over all maps or pages; cached ones draw none");
  if (drawing.stage != nullptr && drawing.stage->side(0).pages)
    plot("pages drawn", drawing.curves.pages, "", "pages that were not kept from earlier frames");
  plot("shimmering", drawing.curves.flips, "%",
       "pixels whose shadow flips from the plan of the frame before to this one, at the same points of a "
       "light and a scene at rest");
  if (ImGui::Button("clear")) drawing.curves = {};
  ImGui::SameLine();
  ImGui::Checkbox("count shimmering", &display.shimmering);
  tooltip("each frame is drawn with the plan before as well; not with pages");
}

}  // namespace

void curves_part(App& app) {
  if (app.display.results) results_part(app);
  if (ImGui::CollapsingHeader("last frames", ImGuiTreeNodeFlags_DefaultOpen))
    last_frames(app.drawing, app.display);
  if (!app.display.results) results_part(app);
}

}  // namespace gnomon::tool::view
