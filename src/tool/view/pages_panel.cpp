// The panel's part for pages: the policy, and what each pool is allowed.
#include <algorithm>
#include <string>

#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

void edit_size(PageSetting& pages) {
  for (const int size : {64, 128, 256}) {
    if (size != 64) ImGui::SameLine();
    ImGui::RadioButton(std::to_string(size).c_str(), &pages.page_texels, size);
    tooltip("texels along each side of a page: smaller ones follow visible surfaces, and each is a draw");
  }
  ImGui::SameLine();
  ImGui::TextUnformatted("page size");
}

}  // namespace

void edit_pages(PageSetting& pages) {
  std::vector<std::string> help{"whole shadow maps"};
  for (const PagePolicy* policy : all_page_policies()) help.emplace_back(policy->summary);
  const std::vector<std::string> names = page_policy_names();
  int index =
      static_cast<int>(std::find(names.begin(), names.end(), page_policy_name(pages)) - names.begin());
  if (choose("pages", index, names, help))
    pages.policy = page_policy_of(names[static_cast<std::size_t>(index)]);
  tooltip("G: virtual shadow maps in place of maps, for filters that read depths; docs/pages.md");
  if (!pages.on()) return;
  edit_size(pages);
  ImGui::SliderInt("page capacity", &pages.capacity, 1, 1 << 14, "%d",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tooltip("pages that the pool holds; where more are needed, all levels coarsen evenly");
  constexpr double kNone = 0.0, kMost = 16.0;
  ImGui::SliderScalar("page target", ImGuiDataType_Double, &pages.target_m, &kNone, &kMost,
                      pages.target_m > 0.0 ? "m %.2f" : "the pool's least m",
                      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tooltip("error m (pixels per texel) that pages are opened for; 0: the least that the pool holds");
}

}  // namespace gnomon::tool::view
