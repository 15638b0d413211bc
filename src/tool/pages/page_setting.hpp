// Which settings draw pages in place of maps, and which cannot?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/scene/default_light.hpp"

namespace gnomon::tool {

/// Pages in place of whole maps.
struct PageSetting {
  const PagePolicy* policy = nullptr;  ///< nullptr: whole maps
  int page_texels = 128;               ///< served along each side of a page: 64, 128 or 256
  int capacity = 1024;                 ///< pages that the pool holds
  double target_m = 1.0;               ///< error that pages are opened for; 0: the least that the pool holds

  [[nodiscard]] bool on() const noexcept { return policy != nullptr; }
  [[nodiscard]] bool operator==(const PageSetting&) const noexcept = default;
};
/// More pages than drivers are known to take layers for.
inline constexpr int kMaxPoolPages = 1 << 16;
inline constexpr double kMaxTargetM = 1e6;

/// The error for which plan_pages opens pages. 0 is the least that points read some pixels apart can be
/// given: a plan spends its pool, but where every pixel has as fine texels before.
[[nodiscard]] double target_of(double target_m, int page_texels) noexcept;
/// With a fallback, so that surfaces between the points that were read keep a shadow.
[[nodiscard]] PageOptions page_options_of(const PageSetting& setting, const PlanOptions& plan) noexcept;

/// A setting that pages cannot be drawn with, and the reason.
struct NoPages {
  std::string what, why;
};
/// `plan`: with the border of the filter (set_margin).
[[nodiscard]] std::optional<NoPages> no_pages(const render::FilterSettings& filter, const PlanOptions& plan,
                                              int page_texels);
/// Least pages of a pool under this light: every map of the base has up to four of its coarsest level.
[[nodiscard]] int least_pool_pages(LightKind light) noexcept;
/// Why this setting draws nothing, in one line; empty: it does. Asks the driver for memory where the pool is
/// large: a context must be current.
[[nodiscard]] std::string page_refusal(const PageSetting& setting, const render::FilterSettings& filter,
                                       const PlanOptions& plan, LightKind light);

/// "off" and the policies of the registry.
[[nodiscard]] std::vector<std::string> page_policy_names();
[[nodiscard]] std::string page_policy_name(const PageSetting& setting);
/// The policy of a name; nullptr for "off" and for names that are unknown.
[[nodiscard]] const PagePolicy* page_policy_of(const std::string& name) noexcept;
/// True where a page has so many texels along each side.
[[nodiscard]] bool is_page_size(int texels) noexcept;

/// --pages, --page-size, --page-capacity and --page-target.
[[nodiscard]] std::vector<Option> page_setting_options(PageSetting& setting);
/// Throws std::runtime_error where --page-size names no size of a page.
void check_page_size(const PageSetting& setting);

}  // namespace gnomon::tool
