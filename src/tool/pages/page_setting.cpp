// Which settings draw pages in place of maps, and which cannot?
#include "page_setting.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gnomon/render/page_filter.hpp"
#include "gnomon/render/probe.hpp"
#include "visible_surfaces.hpp"

namespace gnomon::tool {

double target_of(double target_m, int page_texels) noexcept {
  // A page of a smaller error is narrower on the screen than the points are apart, and leaves the pixels
  // between them to the coarsest level.
  constexpr double kPointsAcross = 2.0;
  return target_m > 0.0 ? target_m : kPointsAcross * VisibleSurfaces::kStride / page_texels;
}

PageOptions page_options_of(const PageSetting& setting, const PlanOptions& plan) noexcept {
  PageOptions options;
  options.plan = plan;
  options.policy = setting.policy;
  options.page_texels = setting.page_texels;
  options.capacity = setting.capacity;
  options.target_m = target_of(setting.target_m, setting.page_texels);
  options.fallback = true;
  return options;
}

std::optional<NoPages> no_pages(const render::FilterSettings& filter, const PlanOptions& plan,
                                int page_texels) {
  if (!plan.warp.shape->affine)
    return NoPages{std::string(plan.warp.shape->name), "bends lines, and pages have linear texels"};
  if (const std::string_view why = render::page_filter_refusal(filter); !why.empty())
    return NoPages{render::to_string(filter), std::string(why)};
  if (filter.unit == render::KernelUnit::world)
    return NoPages{render::to_string(filter), "kernel in world units, which no page border holds"};
  if (plan.filter.texels > 0.25 * page_texels)
    return NoPages{render::to_string(filter),
                   fmt::format("border of more than a quarter of a page of {} texels", page_texels)};
  return std::nullopt;
}

int least_pool_pages(LightKind light) noexcept {
  constexpr int kOfAMap = 4, kCubeFaces = 6;
  return light == LightKind::point ? kOfAMap * kCubeFaces : kOfAMap;
}

std::string page_refusal(const PageSetting& setting, const render::FilterSettings& filter,
                         const PlanOptions& plan, LightKind light) {
  if (const auto why = no_pages(filter, plan, setting.page_texels))
    return fmt::format("no pages with {}: {}", why->what, why->why);
  if (const int least = least_pool_pages(light); setting.capacity < least)
    return fmt::format("page_capacity {}: this light needs at least {} pages", setting.capacity, least);
  // As the renderer lays a pool out, but for the quarter that it grows by.
  constexpr double kSurelyThere = 256.0 * 1024 * 1024;
  const double bytes = render::bytes_per_texel(filter);
  constexpr int kPagesAcross = 8;
  const int slot = setting.page_texels + 2 * static_cast<int>(std::ceil(plan.filter.texels));
  if (bytes * slot * slot * setting.capacity <= kSurelyThere) return {};
  const int side = kPagesAcross * slot,
            layers = (setting.capacity + kPagesAcross * kPagesAcross - 1) / (kPagesAcross * kPagesAcross);
  const render::FittingMaps fitting = render::largest_maps(side, layers, bytes, 0.0);
  if (fitting.size >= side) return {};
  return fmt::format("page_capacity {}: so many pages do not fit ({})", setting.capacity, fitting.why);
}

std::vector<std::string> page_policy_names() {
  return names_in(all_page_policies(), {"off"});
}

std::string page_policy_name(const PageSetting& setting) {
  return setting.on() ? std::string(setting.policy->name) : "off";
}

const PagePolicy* page_policy_of(const std::string& name) noexcept {
  return name == "off" ? nullptr : find_page_policy(name);
}

bool is_page_size(int texels) noexcept {
  return texels == 64 || texels == 128 || texels == 256;
}

std::vector<Option> page_setting_options(PageSetting& setting) {
  const std::vector<std::string> policies = page_policy_names();
  const auto set_policy = [&setting, policies](const std::string& name) {
    setting.policy = page_policy_of(name);
    return std::find(policies.begin(), policies.end(), name) != policies.end();
  };
  return {{.name = "--pages",
           .target = ParsedWord{set_policy, page_policy_name(setting)},
           .help = "draw pages of virtual shadow maps in place of maps, by this policy (docs/pages.md)",
           .names = policies},
          {.name = "--page-size",
           .target = &setting.page_texels,
           .help = "texels along each side of a page: 64, 128 or 256",
           .range = {{kLeastPageTexels, kMaxPageTexels}},
           .needs = "--pages"},
          {.name = "--page-capacity",
           .target = &setting.capacity,
           .help = "pages that the pool holds; fewer than needed: all levels coarsen evenly",
           .range = {{1, kMaxPoolPages}},
           .needs = "--pages"},
          {.name = "--page-target",
           .target = &setting.target_m,
           .help = "error m that pages are opened for; 0: the least that the pool holds",
           .range = {{0.0, kMaxTargetM}},
           .needs = "--pages"}};
}

void check_page_size(const PageSetting& setting) {
  if (!is_page_size(setting.page_texels))
    throw std::runtime_error(fmt::format("--page-size {}: wants 64, 128 or 256", setting.page_texels));
}

}  // namespace gnomon::tool
