// Do plans of pages keep their budgets, serve every point, and share no place?
#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "check.hpp"
#include "geometry.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::stress {
namespace {

constexpr int kPages = 512;

std::string of(std::uint64_t count, const char* words, std::uint64_t all) {
  return std::to_string(count) + words + std::to_string(all);
}

/// Pages within the pool, each in its level and with a slot of its own.
void check_places(const PagePlan& plan, Report& report) {
  if (plan.pages.size() > kPages)
    report.add("pool_exceeded", static_cast<double>(plan.pages.size()),
               of(plan.pages.size(), " pages in a pool of ", kPages));
  std::vector<char> taken(kPages, 0);
  for (const Page& page : plan.pages) {
    const bool inside = page.level < plan.levels.size() && page.slot < kPages && page.column >= 0 &&
                        page.row >= 0 &&
                        (page.column + 1) * plan.page_texels <= plan.levels[page.level].width &&
                        (page.row + 1) * plan.page_texels <= plan.levels[page.level].height;
    if (!inside || taken[page.slot]++ != 0)
      report.add("pool_place_taken", page.slot,
                 inside ? "slot " + std::to_string(page.slot) + " holds two pages"
                        : "a page lies beside its level or the pool");
  }
}

/// Whether light through the middle of the box falls onto a texel of the page, clear of its border.
bool clearly_reaches(const PagePlan& plan, const Page& page, const Box& box) {
  const ShadowMap map = page_map(plan, page);
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(0.5 * (box.min + box.max), 1.0);
  if (!(clip.w > 0.0)) return false;
  const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
  // The page's own depths are those of all casters.
  constexpr double kInside = 0.99;
  return std::max(std::abs(ndc.x), std::abs(ndc.y)) < kInside && std::abs(ndc.z) < kInside;
}

/// A caster that moved: the pages that it clearly lies before are drawn again.
void check_moved(const Case& input, const PagePlan& plan, std::span<PageSlot> slots,
                 std::span<std::uint32_t> table, Report& report) {
  std::vector<KeptPage> kept(plan.pages.size());
  constexpr std::size_t kMost = 4;
  for (std::size_t i = 0; i < std::min(input.casters.size(), kMost); ++i) {
    const Box& box = input.casters[i];
    (void)keep_pages(plan, {&box, 1}, slots, table, kept);
    if (box.empty()) continue;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (!kept[k].draw && clearly_reaches(plan, plan.pages[k], box))
        report.add("page_stale", 1.0,
                   "page " + std::to_string(k) + " is kept, though caster " + std::to_string(i) +
                       " moved before it");
    }
  }
}

/// Points whose page is coarser than the target: no more than the plan counts.
void check_errors(const Case& input, const PagePlan& plan, std::span<const glm::dvec3> points,
                  Report& report) {
  constexpr double kRounding = 1.0 + 1e-6;
  std::uint64_t above = 0;
  double worst = 0.0;
  for (const glm::dvec3& point : points) {
    const int page = page_serving(plan, point);
    if (page < 0) continue;
    ++report.counts().page_points;
    const ShadowMap& level = plan.levels[plan.pages[static_cast<std::size_t>(page)].level];
    const PointAliasing m = measure_perspective(level, input.camera, point);
    const double side = std::max(m.m_s, m.m_t);
    if (m.status != PointAliasing::Status::ok || !(side > plan.target_m * kRounding)) continue;
    ++above;
    worst = std::max(worst, side / plan.target_m);
  }
  const std::uint64_t said = plan.points_capped + plan.points_outside;
  if (above > said)
    report.add("page_above_target", worst,
               std::string(plan.policy->name) + ": " +
                   of(above, " points are above the target, said to be ", said) + ", the worst by " +
                   std::to_string(worst) + ", target " + std::to_string(plan.target_m));
}

void check_kept(const Case& input, const PagePlan& plan, Report& report) {
  std::vector<PageSlot> slots(kPages);
  std::vector<std::uint32_t> table(page_table_size(kPages));
  std::vector<KeptPage> kept(plan.pages.size());
  const KeptPages first = keep_pages(plan, {}, slots, table, kept);
  if (!first.fits || first.drawn != plan.pages.size())
    report.add("page_stale", 1.0, of(first.drawn, " pages drawn into an empty pool of ", plan.pages.size()));
  const KeptPages again = keep_pages(plan, {}, slots, table, kept);
  if (again.drawn != 0)
    report.add("page_stale", static_cast<double>(again.drawn),
               of(again.drawn, " pages drawn again, nothing has moved, of ", plan.pages.size()));
  check_moved(input, plan, slots, table, report);
  std::vector<char> taken(kPages, 0);
  for (const KeptPage& page : kept) {
    if (taken[page.slot]++ != 0)
      report.add("pool_place_taken", page.slot, "two kept pages lie in slot " + std::to_string(page.slot));
  }
}

/// Whether rounding decides which page holds the point: the edges of pages are open by a millionth of their
/// side, which may be less than what positions lose. Not all policies have texels as large as pixels.
bool decided_by_rounding(const PagePlan& plan, const LightAt& light, const View& view,
                         const glm::dvec3& point) {
  constexpr double kEdge = 1e-6, kRounding = 64.0 * 0x1p-53;  // as the planner's
  const glm::dvec3 travel(light.travel(Real3(point) - view.eye));
  const glm::dvec3 sizes = glm::abs(point) + glm::abs(plan.origin_world);
  const double lost = kRounding * std::max({sizes.x, sizes.y, sizes.z});
  return std::any_of(plan.levels.begin(), plan.levels.end(), [&](const ShadowMap& level) {
    const glm::dvec2 texel = texel_extent_world(level.clip_from_world, level.texels(), travel, point);
    return kEdge * plan.page_texels * std::min(texel.x, texel.y) < lost;
  });
}

}  // namespace

void check_pages(const Case& input, std::span<const glm::dvec3> seen, Report& report) {
  // Of a point whose pixel is smaller than this of its coordinates, rounding decides the page.
  constexpr double kResolved = 1e-9;
  const Camera& camera = input.camera;
  const double slope =
      std::min((camera.right - camera.left) / camera.width, (camera.top - camera.bottom) / camera.height);
  std::vector<glm::dvec3> points;
  for (const glm::dvec3& point : seen) {
    const glm::dvec3 at = glm::abs(point);
    const double pixel = slope * (camera.orthographic ? 1.0 : glm::length(point - camera.position));
    if (pixel > kResolved * std::max({at.x, at.y, at.z})) points.push_back(point);
  }
  if (points.empty()) return;
  const View view(camera);
  const LightAt light(input.light, view);
  for (const PagePolicy* policy : all_page_policies()) {
    PageOptions options;
    options.plan = input.options;
    options.plan.filter = {};  // a kernel of world units, or wider than a page, is refused by name
    options.policy = policy;
    options.capacity = kPages;
    std::vector<std::byte> memory(page_memory(kPages, points.size()));
    const PagePlan plan = quiet("plan_pages", report, [&] {
      return plan_pages({.camera = input.camera, .points_world = points}, input.light, input.bounds(),
                        options, memory);
    });
    if (plan.status == PlanStatus::invalid_input) {
      report.add("pages_refused", 1.0, std::string(policy->name) + ": " + std::string(plan.invalid_field));
      continue;
    }
    if (plan.status != PlanStatus::ok) continue;
    report.counts().pages += static_cast<long long>(plan.pages.size());
    check_places(plan, report);
    check_kept(input, plan, report);
    // The others spend the pool, or follow what a picture reports.
    if (policy == &page_policies::resolution || policy == &page_policies::clipmap)
      check_errors(input, plan, points, report);
    std::uint64_t served = 0, open = 0;
    for (const glm::dvec3& point : points) {
      const bool has_page = page_serving(plan, point) >= 0;
      served += has_page ? 1 : 0;
      open += !has_page && decided_by_rounding(plan, light, view, point) ? 1 : 0;
    }
    if (served + open < plan.points || plan.points + plan.points_outside != points.size())
      report.add("point_without_page", static_cast<double>(points.size() - served),
                 std::string(policy->name) + ": " +
                     of(served, " points have a page, said to be ", plan.points) + ", " +
                     of(plan.points_outside, " more lie outside, of ", points.size()));
  }
}

}  // namespace gnomon::stress
