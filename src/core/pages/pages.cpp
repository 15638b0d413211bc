// From visible points to resident pages: input checks, the base, levels, the pool.
#include "gnomon/pages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>

#include "geometry/matrix.hpp"
#include "geometry/usable.hpp"
#include "lanes/elementary.hpp"
#include "pages/fill.hpp"
#include "plan/input.hpp"
#include "plan/memory.hpp"
#include "resolve/resolve.hpp"

namespace gnomon {
namespace {

constexpr std::array kPolicies = {
#define GNOMON_PAGE_POLICY(name) &page_policies::name,
#include "gnomon/page_policies.def"
#undef GNOMON_PAGE_POLICY
};

std::string_view invalid_pages(const PageOptions& o) noexcept {
  if (o.page_texels != 64 && o.page_texels != 128 && o.page_texels != 256) return "pages.page_texels";
  if (o.virtual_texels > kMaxVirtualTexels || o.virtual_texels < 1) return "pages.virtual_texels";
  if (o.page_texels > o.virtual_texels) return "pages.page_texels";
  if (o.capacity < 1 || o.capacity > kMaxPages) return "pages.capacity";
  if (!(o.target_m >= kLeastError && o.target_m <= kLargest)) return "pages.target_m";
  if (!(o.share > 0.0 && o.share <= 1.0)) return "pages.share";
  if (o.levels_per_octave < 1 || o.levels_per_octave > 4) return "pages.levels_per_octave";
  if (o.trials < 1 || o.trials > 16) return "pages.trials";
  if (!(o.reach_texels >= 0.0 && o.reach_texels <= o.page_texels)) return "pages.reach_texels";
  if (!(o.least_light_sine >= 0.0 && o.least_light_sine <= 1.0)) return "pages.least_light_sine";
  if (!(o.plan.filter.texels >= 0.0 && o.plan.filter.texels <= 0.25 * o.page_texels))
    return "options.filter.texels";
  // Of levels whose texels differ a thousandfold no border holds it.
  if (o.plan.filter.world != 0.0) return "options.filter.world";
  return {};
}

/// Bytes of all but the points; slack included.
std::size_t memory_without_points(int capacity) noexcept {
  const int pages = std::clamp(capacity, 0, kMaxPages);
  return kMemorySlack + memory_of<ShadowMap>(kMaxPageLevels) +
         memory_of<Page>(static_cast<std::size_t>(pages)) + memory_of<std::uint32_t>(page_table_size(pages)) +
         memory_of<PageContext>(1);
}

/// No points where the memory is too small.
PageMemory parts_of(std::span<std::byte> memory, int capacity) noexcept {
  const std::size_t others = memory_without_points(capacity);
  if (memory.size() < others) return {};
  // Points are counted in 32 bits.
  const std::size_t points = std::min<std::size_t>((memory.size() - others) / sizeof(PagePoint),
                                                   std::numeric_limits<std::uint32_t>::max() - 1);
  MemoryParts parts(memory), grids(memory);
  return {parts.take<ShadowMap>(kMaxPageLevels),
          grids.take<PageGrid>(kLadders),
          grids.take<PageSample>(kPageSamples),
          parts.take<Page>(static_cast<std::size_t>(capacity)),
          parts.take<std::uint32_t>(page_table_size(capacity)),
          parts.take<PageContext>(1).data(),
          parts.take<PagePoint>(points)};
}

std::string_view invalid_points(const View& view, const PageHistory& history,
                                const PageMemory& memory) noexcept {
  const std::size_t count = view.points_world.size();
  if (memory.points.empty() || memory.points.size() < count) return "memory";
  if (const auto field = first_invalid_points(view); !field.empty()) return field;
  if (!history.feedback.empty() && history.feedback.size() != count) return "history.feedback";
  return {};
}

void omit(PagePlan& plan, const Omission& omission) noexcept {
  if (plan.omission_count < kMaxOmissions)
    plan.omission[static_cast<std::size_t>(plan.omission_count)] = omission;
  ++plan.omission_count;
}

/// The ladder: whole octaves are exact, so that steps of two plans agree to the last bit.
void make_ladder(PageContext& c) noexcept {
  c.per_page = 1.0 / c.options.page_texels;
  c.steps = c.options.policy->octaves ? 1 : c.options.levels_per_octave;
  const double octaves =
      elementary::log2(static_cast<double>(c.options.virtual_texels) / c.options.page_texels);
  for (int step = 0; step < kLadder; ++step) {
    const int whole = (step + c.steps - 1) / c.steps, part = whole * c.steps - step;
    c.shrink[static_cast<std::size_t>(step)] =
        std::ldexp(elementary::exp2(static_cast<double>(part) / c.steps), -whole);
  }
  c.deepest = std::min(static_cast<int>(octaves * c.steps + 1e-9), kLadder - 1);
}

/// Pages for an error of target_m times `factor`; false where the pool does not hold them.
bool fits(PageContext& c, double factor, PagePlan& plan) noexcept {
  c.target = plan.target_m = c.options.target_m * factor;
  c.chosen = 0;
  c.options.policy->assign(c);
  plan.points_coarser = 0;
  if (c.options.share == 1.0) return open_pages(c);
  LeftToCoarser left = leave_to_coarser(c, kShareRounds);
  if (!left.open && left.rounds >= 0) {
    // The rounds before the one that filled the pool, from the same levels: their pages fit.
    c.options.policy->assign(c);
    left = leave_to_coarser(c, left.rounds);
  }
  plan.points_coarser = left.points;
  return left.open;
}

/// The size and place of the grids, among the trials, with the fewest pages.
void choose_sizes(PageContext& c, PagePlan& plan) noexcept {
  size_base(0, c);
  if (c.options.trials == 1) return;
  int best = 0;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (int trial = 0; trial < c.options.trials; ++trial) {
    size_base(trial, c);
    if (!fits(c, 1.0, plan) || c.page_count >= fewest) continue;
    fewest = c.page_count;
    best = trial;
  }
  size_base(best, c);
}

/// Coarsens all levels by the same factor until the pool holds their pages. False where it never does.
bool fit_pool(PageContext& c, PagePlan& plan) noexcept {
  if (fits(c, 1.0, plan)) return true;
  // Octaves up, then thirty-seconds back: a twentieth of a pool stays empty.
  constexpr int kMaxOctaves = 60, kHalvings = 5;
  for (int octave = 1; octave <= kMaxOctaves; ++octave) {
    if (!fits(c, elementary::exp2(octave), plan)) continue;
    double high = octave, low = octave - 1;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (low + high);
      (fits(c, elementary::exp2(middle), plan) ? high : low) = middle;
    }
    return fits(c, elementary::exp2(high), plan);
  }
  return false;
}

/// The record of one level.
ShadowMap level_map(const PageContext& c, std::uint32_t level) noexcept {
  const PageBase& base = c.base_of(level);
  const PageGrid g = c.grid(level);
  ShadowMap map = base.map;
  const int page = c.options.page_texels;
  map.width = g.columns * page;
  map.height = g.rows * page;
  map.filter_margin_texels = 0;
  const glm::dvec4 place_x = base.row_x + base.row_w * base.shift.x,
                   place_y = base.row_y + base.row_w * base.shift.y;
  const glm::dvec4 row_x = place_x * (2.0 / (g.side.x * g.columns)) -
                           base.row_w * (2.0 * static_cast<double>(g.first_x) / g.columns + 1.0);
  const glm::dvec4 row_y = place_y * (2.0 / (g.side.y * g.rows)) -
                           base.row_w * (2.0 * static_cast<double>(g.first_y) / g.rows + 1.0);
  for (int i = 0; i < 4; ++i) {
    map.clip_from_world[i][0] = row_x[i];
    map.clip_from_world[i][1] = row_y[i];
  }
  map.clip_from_camera_relative = glm::mat4(counted_from(map.clip_from_world, c.camera.position));
  // Of a texel of the level over one of the base's record.
  const glm::dvec2 scale =
      g.side / static_cast<double>(page) * glm::dvec2(base.map.width, base.map.height) / base.unit;
  const double longer = max_of(map.texel_world.x, map.texel_world.y);
  map.texel_world *= scale;
  map.texel_world_max *= scale;
  const double bias = longer > 0.0 ? max_of(map.texel_world.x, map.texel_world.y) / longer : 0.0;
  map.bias_world = {map.bias_world.constant * bias, map.bias_world.slope * bias,
                    map.bias_world.normal_offset * bias};
  map.m_s_max *= scale.x;
  map.m_t_max *= scale.y;
  map.m_max *= max_of(scale.x, scale.y);
  map.storage = map.m_s_max * map.m_t_max * map.width * static_cast<double>(map.height) /
                (static_cast<double>(c.camera.width) * c.camera.height);
  if (base.fixed) {
    map.snap_key.valid = true;
    map.snap_key.x = g.first_x * page;
    map.snap_key.y = g.first_y * page;
    map.snap_key.texel = g.side / static_cast<double>(page);
  }
  return map;
}

/// Levels that have pages, coarsest first; pages in that order, and their table.
void finish(PageContext& c, PagePlan& plan) noexcept {
  std::array<std::uint32_t, kLadders> count{};
  const std::span<Page> pages = c.memory.pages.first(c.page_count);
  for (const Page& page : pages) ++count[page.level];
  std::array<std::uint32_t, kLadders> listed{};
  std::uint32_t levels = 0;
  for (std::uint32_t step = 0; step <= static_cast<std::uint32_t>(c.deepest); ++step) {
    for (std::uint32_t base = 0; base < static_cast<std::uint32_t>(c.base_count); ++base) {
      const std::uint32_t level = base * kLadder + step;
      if (count[level] == 0) continue;
      c.memory.levels[levels] = level_map(c, level);
      listed[level] = levels++;
    }
  }
  // Opened from the finest level to the coarsest, and by face from the last to the first.
  for (Page& page : pages) page.level = listed[page.level];
  std::reverse(pages.begin(), pages.end());
  const auto table = c.memory.table.first(page_table_size(static_cast<int>(pages.size())));
  std::fill(table.begin(), table.end(), 0u);
  for (std::uint32_t i = 0; i < pages.size(); ++i) {
    pages[i].slot = i;
    add_to_table(table, pages, i);
  }
  plan.levels = c.memory.levels.first(levels);
  plan.pages = pages;
  plan.table = table;
}

void report(const PageContext& c, PagePlan& plan) noexcept {
  plan.points = c.point_count - c.outside;
  plan.points_outside = c.outside;
  plan.points_capped = c.edge_on;
  for (std::size_t i = 0; i < c.point_count; ++i) {
    const PagePoint& point = c.memory.points[i];
    if (point.level == kOutside) continue;
    const double excess = c.excess(point) / plan.target_m;
    if (!(excess * c.shrink[static_cast<std::size_t>(c.deepest)] <= 1.0)) ++plan.points_capped;
  }
  if (plan.target_m > c.options.target_m)
    omit(plan, {OmissionKind::pages_coarsened, -1, c.options.target_m, plan.target_m, 0});
  if (plan.points_coarser > 0)
    omit(plan, {OmissionKind::points_left_coarser, -1, static_cast<double>(plan.points_coarser), 0.0, 0});
  if (plan.points_capped > 0)
    omit(plan, {OmissionKind::points_beyond_levels, -1, static_cast<double>(plan.points_capped), 0.0, 0});
}

}  // namespace

std::span<const PagePolicy* const> all_page_policies() noexcept {
  return kPolicies;
}

const PagePolicy* find_page_policy(std::string_view name) noexcept {
  for (const PagePolicy* policy : kPolicies) {
    if (policy->name == name) return policy;
  }
  return nullptr;
}

std::size_t page_memory(int capacity, std::size_t points) noexcept {
  return memory_without_points(capacity) + memory_of<PagePoint>(points);
}

PagePlan plan_pages(const View& view, const Light& light, const SceneBounds& bounds,
                    const PageOptions& options, std::span<std::byte> memory,
                    const PageHistory* history) noexcept {
  PagePlan plan;
  PageOptions pages = options;
  if (pages.policy == nullptr) pages.policy = &page_policies::resolution;
  plan.policy = pages.policy;
  plan.invalid_field = first_invalid_field(view.camera, light, bounds, pages.plan);
  if (plan.invalid_field.empty()) plan.invalid_field = invalid_pages(pages);
  if (!plan.invalid_field.empty()) return plan;
  const PageHistory known = history != nullptr ? *history : PageHistory{};
  const PageMemory parts = parts_of(memory, pages.capacity);
  plan.invalid_field = invalid_points(view, known, parts);
  if (!plan.invalid_field.empty()) return plan;
  const ResolvedPages how = resolve_pages(pages);
  const Camera finite = with_finite_far(view.camera, bounds.receivers);
  PageContext& c =
      *::new (parts.context) PageContext{finite, view, known, how.options, parts, camera_axes(finite)};
  plan.clip_space = pages.plan.clip_space;
  plan.bias = pages.plan.bias;
  plan.page_texels = pages.page_texels;
  plan.border_texels = static_cast<int>(std::ceil(pages.plan.filter.texels));
  plan.capacity = pages.capacity;
  plan.target_m = pages.target_m;
  plan.status = plan_base(light, bounds, how, c, plan);
  if (plan.status != PlanStatus::ok) return plan;
  make_ladder(c);
  add_points(bounds, c);
  choose_sizes(c, plan);
  if (!fit_pool(c, plan)) {
    // Every map of the base needs a page, a grid that does not follow the camera up to four.
    plan.status = PlanStatus::invalid_input;
    plan.invalid_field = "pages.capacity";
    return plan;
  }
  finish(c, plan);
  report(c, plan);
  if (plan.pages.empty()) plan.status = PlanStatus::nothing_visible;
  return plan;
}

}  // namespace gnomon
