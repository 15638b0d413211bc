// Page plans of C. The plan of C++ lies at the head of the caller's memory, where later calls find it.
#include <cstddef>
#include <new>

#include "c/convert.hpp"
#include "geometry/usable.hpp"
#include "plan/memory.hpp"

namespace gnomon::c {
namespace {

// Records are handed out as they lie in the memory.
static_assert(sizeof(Page) == sizeof(gnomon_page) && offsetof(Page, level) == offsetof(gnomon_page, level) &&
              offsetof(Page, column) == offsetof(gnomon_page, column) &&
              offsetof(Page, row) == offsetof(gnomon_page, row) &&
              offsetof(Page, slot) == offsetof(gnomon_page, slot) &&
              offsetof(Page, points) == offsetof(gnomon_page, points));
static_assert(sizeof(PageSlot) == sizeof(gnomon_page_slot) &&
              offsetof(PageSlot, texels) == offsetof(gnomon_page_slot, texels) &&
              offsetof(PageSlot, used) == offsetof(gnomon_page_slot, used) &&
              offsetof(PageSlot, behind) == offsetof(gnomon_page_slot, behind));
static_assert(sizeof(KeptPage) == sizeof(gnomon_kept_page) &&
              offsetof(KeptPage, draw) == offsetof(gnomon_kept_page, draw) &&
              offsetof(KeptPage, compose) == offsetof(gnomon_kept_page, compose));
static_assert(int{kShadowEdge} == int{GNOMON_SHADOW_EDGE} &&
              int{kShadowChanged} == int{GNOMON_SHADOW_CHANGED} && int{kDepthEdge} == int{GNOMON_DEPTH_EDGE});

/// What lies at the head of the memory of a page plan.
struct Head {
  std::uint64_t mark;
  PagePlan plan;
};
constexpr std::uint64_t kMark = 0x676e6f6d6f6e7067;  // "gnomonpg"
static_assert(std::is_trivially_destructible_v<Head>);

Head* head_of(const void* memory) noexcept {
  const auto at = reinterpret_cast<std::uintptr_t>(memory);
  return reinterpret_cast<Head*>((at + kMemoryAlignment - 1) / kMemoryAlignment * kMemoryAlignment);
}
constexpr std::size_t kHeadBytes = kMemorySlack + memory_of<Head>(1);

const char* to_page_plan(const gnomon_page_plan* from, const PagePlan*& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  if (from->memory == nullptr || head_of(from->memory)->mark != kMark) return "page_plan.memory";
  to = &head_of(from->memory)->plan;
  return nullptr;
}

const char* to_page_options(const gnomon_page_options* from, PageOptions& to) noexcept {
  if (from == nullptr) return nullptr;
  gnomon_page_options o;
  if (const char* fault = read(from, o)) return fault;
  if (const char* fault = to_options(o.plan, to.plan)) return fault;
  if (o.policy < 0 || static_cast<std::size_t>(o.policy) >= all_page_policies().size())
    return "page_options.policy";
  to.policy = all_page_policies()[static_cast<std::size_t>(o.policy)];
  to.page_texels = o.page_texels;
  to.capacity = o.capacity;
  to.target_m = o.target_m;
  to.share = o.share;
  to.levels_per_octave = o.levels_per_octave;
  to.trials = o.trials;
  to.virtual_texels = o.virtual_texels;
  to.reach_texels = o.reach_texels;
  to.fallback = o.fallback != 0;
  to.least_light_sine = o.least_light_sine;
  return nullptr;
}

const char* to_page_history(const gnomon_page_history* from, PageHistory& to) noexcept {
  if (from == nullptr) return nullptr;
  gnomon_page_history h;
  if (const char* fault = read(from, h)) return fault;
  if (h.last != nullptr) {
    if (const char* fault = to_page_plan(h.last, to.last)) return fault;
  }
  if (h.feedback_count < 0) return "page_history.feedback_count";
  if (h.feedback == nullptr && h.feedback_count > 0) return "page_history.feedback";
  to.feedback = {h.feedback, static_cast<std::size_t>(h.feedback_count)};
  return nullptr;
}

void from_page_plan(const PagePlan& from, gnomon_page_plan& to) noexcept {
  to.status = static_cast<std::int32_t>(from.status);
  to.omission_count = from.omission_count;
  from_omissions(from.omitted(), to.omissions, to.omission_room);
  to.pages = reinterpret_cast<const gnomon_page*>(from.pages.data());
  to.page_count = static_cast<std::int64_t>(from.pages.size());
  to.table = from.table.data();
  to.table_count = static_cast<std::int64_t>(from.table.size());
  to.level_count = static_cast<std::int32_t>(from.levels.size());
  to.policy = GNOMON_DEFAULT;
  for (std::size_t i = 0; i < all_page_policies().size(); ++i) {
    if (all_page_policies()[i] == from.policy) to.policy = static_cast<std::int32_t>(i);
  }
  to.page_texels = from.page_texels;
  to.border_texels = from.border_texels;
  to.capacity = from.capacity;
  from_vector(from.origin_world, to.origin);
  from_vector(from.light_direction, to.light_direction);
  to.clip_space = from_clip_space(from.clip_space);
  to.target_m = from.target_m;
  to.points = static_cast<std::int64_t>(from.points);
  to.points_outside = static_cast<std::int64_t>(from.points_outside);
  to.points_coarser = static_cast<std::int64_t>(from.points_coarser);
  to.points_capped = static_cast<std::int64_t>(from.points_capped);
}

std::int32_t refuse_pages(const char* fault, gnomon_page_plan* plan, const char** invalid_field) noexcept {
  plan->status = GNOMON_INVALID_INPUT;
  plan->page_count = plan->table_count = 0;
  plan->level_count = plan->omission_count = 0;
  plan->memory = nullptr;
  return refuse(fault, invalid_field);
}

std::int32_t write_map(const ShadowMap& from, gnomon_map* to, const char** invalid_field) noexcept {
  if (const char* fault = fault_of(to)) return refuse(fault, invalid_field);
  gnomon_map all;
  set_defaults(all);
  from_map(from, all);
  write(all, to);
  return done(invalid_field);
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int64_t gnomon_page_memory(int32_t capacity, int64_t points) {
  if (capacity < 1 || capacity > kMaxPages || points < 0 || points > INT32_MAX) return 0;
  return static_cast<int64_t>(kHeadBytes + page_memory(capacity, static_cast<std::size_t>(points)));
}

int32_t gnomon_plan_pages(const gnomon_view* view, const gnomon_light* light, const gnomon_scene* scene,
                          const gnomon_page_options* options, const gnomon_page_history* history,
                          void* memory, int64_t bytes, gnomon_page_plan* plan, const char** invalid_field) {
  if (const char* fault = fault_of(plan)) return refuse(fault, invalid_field);
  if (plan->omission_room < 0) return refuse_pages("page_plan.omission_room", plan, invalid_field);
  if (plan->omission_room > 0 && plan->omissions == nullptr)
    return refuse_pages("page_plan.omissions", plan, invalid_field);
  View v;
  Light l;
  SceneBounds bounds;
  PageOptions o;
  PageHistory h;
  const char* fault = to_view(view, v);
  if (fault == nullptr) fault = to_light(light, l);
  if (fault == nullptr) fault = to_scene(scene, bounds);
  if (fault == nullptr) fault = to_page_options(options, o);
  if (fault == nullptr) fault = to_page_history(history, h);
  if (fault == nullptr && memory == nullptr) fault = "memory";
  if (fault == nullptr && bytes < static_cast<int64_t>(kHeadBytes)) fault = "bytes";
  if (fault == nullptr && h.last != nullptr && h.last == &head_of(memory)->plan) fault = "page_history.last";
  if (fault != nullptr) return refuse_pages(fault, plan, invalid_field);
  Head* const head = new (head_of(memory)) Head{0, {}};
  const std::span<std::byte> rest(reinterpret_cast<std::byte*>(head + 1),
                                  static_cast<std::size_t>(bytes) - kHeadBytes);
  head->plan = plan_pages(v, l, bounds, o, rest, &h);
  if (head->plan.status == PlanStatus::invalid_input)
    return refuse_pages(gnomon::c::field_of(head->plan.invalid_field), plan, invalid_field);
  head->mark = kMark;
  gnomon_page_plan p;
  if (const char* late = read(plan, p)) return refuse(late, invalid_field);
  from_page_plan(head->plan, p);
  p.memory = memory;
  write(p, plan);
  return done(invalid_field, p.status);
}

int32_t gnomon_page_level(const gnomon_page_plan* plan, int32_t level, gnomon_map* map,
                          const char** invalid_field) {
  const PagePlan* p = nullptr;
  if (const char* fault = to_page_plan(plan, p)) return refuse(fault, invalid_field);
  if (level < 0 || static_cast<std::size_t>(level) >= p->levels.size()) return refuse("level", invalid_field);
  return write_map(p->levels[static_cast<std::size_t>(level)], map, invalid_field);
}

int32_t gnomon_page_map(const gnomon_page_plan* plan, int64_t page, gnomon_map* map,
                        const char** invalid_field) {
  const PagePlan* p = nullptr;
  if (const char* fault = to_page_plan(plan, p)) return refuse(fault, invalid_field);
  if (page < 0 || static_cast<std::size_t>(page) >= p->pages.size()) return refuse("page", invalid_field);
  return write_map(page_map(*p, p->pages[static_cast<std::size_t>(page)]), map, invalid_field);
}

int32_t gnomon_page_select(const gnomon_page_plan* plan, const double* points, int64_t count,
                           int32_t* indices, const char** invalid_field) {
  const PagePlan* p = nullptr;
  if (const char* fault = to_page_plan(plan, p)) return refuse(fault, invalid_field);
  if (count < 0) return refuse("count", invalid_field);
  std::span<const glm::dvec3> list;
  if (const char* fault = to_points(points, count, "points", list)) return refuse(fault, invalid_field);
  if (indices == nullptr && count > 0) return refuse("indices", invalid_field);
  for (const glm::dvec3& point : list) {
    if (!usable(point)) return refuse("points", invalid_field);
  }
  for (std::size_t i = 0; i < list.size(); ++i) indices[i] = page_serving(*p, list[i]);
  return done(invalid_field);
}

int32_t gnomon_measure_pages(const gnomon_page_plan* plan, const gnomon_view* view, const gnomon_scene* scene,
                             const gnomon_measure_options* options, gnomon_stats* stats,
                             double* texels_per_pixel, const char** invalid_field) {
  const PagePlan* p = nullptr;
  Measured m;
  const char* fault = to_page_plan(plan, p);
  if (fault == nullptr) fault = to_measured(view, scene, options, stats, m);
  if (fault != nullptr) return refuse(fault, invalid_field);
  const PageStats found = measure(*p, m.view, m.bounds, m.options);
  gnomon_stats all;
  set_defaults(all);
  from_stats(found.m, all);
  write(all, stats);
  if (texels_per_pixel != nullptr) *texels_per_pixel = found.texels_per_pixel;
  return done(invalid_field);
}

int32_t gnomon_expected_page_error(const gnomon_page_plan* plan, const gnomon_shadow_picture* picture,
                                   gnomon_wrong_pixels* pixels, const char** invalid_field) {
  const PagePlan* p = nullptr;
  const char* fault = to_page_plan(plan, p);
  return expect_pixels(
      fault, picture, pixels, invalid_field,
      [&](const ShadowPicture& shadow, double kernel) { return expected_error(*p, shadow, kernel); });
}

int64_t gnomon_page_table_size(int32_t slots) {
  return slots < 1 || slots > kMaxPages ? 0 : static_cast<int64_t>(page_table_size(slots));
}

int32_t gnomon_keep_pages(const gnomon_page_plan* plan, const double* moved, int64_t moved_count,
                          gnomon_page_slot* slots, int32_t slot_count, uint32_t* table,
                          gnomon_kept_page* kept, int64_t* drawn, const char** invalid_field) {
  const PagePlan* p = nullptr;
  if (const char* fault = to_page_plan(plan, p)) return refuse(fault, invalid_field);
  std::span<const Box> boxes;
  if (const char* fault = to_boxes({moved, moved_count, "moved", "moved_count"}, boxes))
    return refuse(fault, invalid_field);
  for (const Box& box : boxes) {
    if (!usable(box)) return refuse("moved", invalid_field);
  }
  if (slots == nullptr) return refuse("slots", invalid_field);
  if (slot_count < 1 || slot_count > kMaxPages || static_cast<std::size_t>(slot_count) < p->pages.size())
    return refuse("slot_count", invalid_field);
  if (table == nullptr) return refuse("table", invalid_field);
  if (kept == nullptr && !p->pages.empty()) return refuse("kept", invalid_field);
  const auto count = static_cast<std::size_t>(slot_count);
  // A bool of C++ holds nothing but 0 and 1.
  for (std::size_t i = 0; i < count; ++i) slots[i].behind = slots[i].behind != 0 ? 1 : 0;
  const KeptPages found =
      keep_pages(*p, boxes, {reinterpret_cast<PageSlot*>(slots), count}, {table, page_table_size(slot_count)},
                 {reinterpret_cast<KeptPage*>(kept), p->pages.size()});
  if (!found.fits) return refuse("slot_count", invalid_field);
  if (drawn != nullptr) *drawn = static_cast<int64_t>(found.drawn);
  return done(invalid_field);
}

}  // extern "C"
