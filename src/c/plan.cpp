// Plans of C: maps and omissions into the caller's arrays, and what is done with them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "c/convert.hpp"
#include "c/memory.hpp"
#include "geometry/usable.hpp"
#include "plan/input.hpp"

static_assert(sizeof(gnomon::ShaderBlock) == GNOMON_SHADER_BLOCK_FLOATS * sizeof(float));
static_assert(GNOMON_VERSION_MAJOR == 0 && GNOMON_VERSION_MINOR == 1 && GNOMON_VERSION_PATCH == 0 &&
              gnomon::kVersion == "0.1.0");

namespace gnomon::c {
namespace {

/// Where a plan is to be written: what is wrong with it, or nullptr.
const char* fault_of_rooms(const gnomon_plan* plan) noexcept {
  if (const char* fault = fault_of(plan)) return fault;
  if (plan->map_room < 0) return "plan.map_room";
  if (plan->map_room > 0 && plan->maps == nullptr) return "plan.maps";
  if (plan->map_room > 0 && !known_size<gnomon_map>(plan->map_size)) return "plan.map_size";
  if (plan->omission_room < 0) return "plan.omission_room";
  return plan->omission_room > 0 && plan->omissions == nullptr ? "plan.omissions" : nullptr;
}

std::int32_t refuse_plan(const char* fault, gnomon_plan* plan, const char** invalid_field) noexcept {
  plan->status = GNOMON_INVALID_INPUT;
  plan->map_count = plan->omission_count = 0;
  return refuse(fault, invalid_field);
}

std::int32_t write_plan(const ShadowPlan& from, gnomon_plan* to, const char** invalid_field) noexcept {
  if (from.status == PlanStatus::invalid_input)
    return refuse_plan(gnomon::c::field_of(from.invalid_field), to, invalid_field);
  if (from.map_count > to->map_room) return refuse_plan("plan.map_room", to, invalid_field);
  gnomon_plan p;
  if (const char* fault = read(to, p)) return refuse(fault, invalid_field);
  p.status = static_cast<std::int32_t>(from.status);
  p.map_count = from.map_count;
  p.omission_count = from.omission_count;
  p.selection = static_cast<std::int32_t>(from.selection);
  p.sizes_vary = from.sizes_vary ? 1 : 0;
  from_vector(from.origin_world, p.origin);
  from_vector(from.light_direction, p.light_direction);
  p.clip_space = from_clip_space(from.clip_space);
  p.bias_constant_texels = from.bias.constant_texels;
  p.bias_slope_texels = from.bias.slope_texels;
  p.bias_normal_offset_texels = from.bias.normal_offset_texels;
  p.bias_max_slope = from.bias.max_slope;
  write_maps(from.maps(), p);
  from_omissions(from.omitted(), p.omissions, p.omission_room);
  write(p, to);
  return done(invalid_field, p.status);
}

}  // namespace

void write_maps(std::span<const ShadowMap> maps, const gnomon_plan& to) noexcept {
  char* at = reinterpret_cast<char*>(to.maps);
  gnomon_map older;
  for (const ShadowMap& map : maps) {
    if (to.map_size == sizeof older) {
      gnomon_map& record = *reinterpret_cast<gnomon_map*>(at);
      from_map(map, record);
      record.size = sizeof record;
    } else {
      from_map(map, older);
      write_bytes(older, to.map_size, at);
    }
    at += to.map_size;
  }
}

}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_make_plan(const gnomon_view* view, const gnomon_light* light, const gnomon_scene* scene,
                         const gnomon_plan_options* options, gnomon_history* history, gnomon_plan* plan,
                         const char** invalid_field) {
  if (const char* fault = fault_of_rooms(plan)) return refuse(fault, invalid_field);
  View v;
  Light l;
  SceneBounds bounds;
  PlanOptions o;
  const char* fault = to_view(view, v);
  if (fault == nullptr) fault = to_light(light, l);
  if (fault == nullptr) fault = to_scene(scene, bounds);
  if (fault == nullptr) fault = to_options(options, o);
  if (fault != nullptr) return refuse_plan(fault, plan, invalid_field);
  return write_plan(make_plan(v, l, bounds, o, history != nullptr ? &history->history : nullptr), plan,
                    invalid_field);
}

int32_t gnomon_plan_views(const gnomon_camera* const* cameras, int32_t count, const gnomon_light* light,
                          const gnomon_scene* scene, const gnomon_plan_options* options, gnomon_plan* plan,
                          const char** invalid_field) {
  if (const char* fault = fault_of_rooms(plan)) return refuse(fault, invalid_field);
  if (cameras == nullptr) return refuse_plan("cameras", plan, invalid_field);
  if (count < 1 || count > GNOMON_MAX_VIEWS) return refuse_plan("count", plan, invalid_field);
  std::array<Camera, kMaxViews> views;
  Light l;
  SceneBounds bounds;
  PlanOptions o;
  const char* fault = nullptr;
  for (int32_t i = 0; i < count && fault == nullptr; ++i)
    fault = to_camera(cameras[i], views[static_cast<std::size_t>(i)]);
  if (fault == nullptr) fault = to_light(light, l);
  if (fault == nullptr) fault = to_scene(scene, bounds);
  if (fault == nullptr) fault = to_options(options, o);
  if (fault != nullptr) return refuse_plan(fault, plan, invalid_field);
  return write_plan(
      plan_views(std::span<const Camera>(views.data(), static_cast<std::size_t>(count)), l, bounds, o), plan,
      invalid_field);
}

void gnomon_describe(const gnomon_omission* omission, gnomon_text* text) {
  if (omission == nullptr || text == nullptr) return;
  *text = {};
  if (omission->kind < 0 || omission->kind > GNOMON_CASCADE_WITHOUT_GAIN) return;
  const OmissionText words = describe(Omission{static_cast<OmissionKind>(omission->kind), omission->map,
                                               omission->a, omission->b, omission->saves_texels});
  static_assert(sizeof words.what == sizeof text->what && sizeof words.why == sizeof text->why);
  std::memcpy(text->what, words.what.data(), sizeof text->what);
  std::memcpy(text->why, words.why.data(), sizeof text->why);
}

gnomon_history* gnomon_history_create(void) {
  return new_object<gnomon_history>();
}
void gnomon_history_destroy(gnomon_history* history) {
  std::free(history);
}
void gnomon_history_clear(gnomon_history* history) {
  if (history != nullptr) history->history.clear();
}
void gnomon_history_copy(const gnomon_history* from, gnomon_history* to) {
  if (from != nullptr && to != nullptr) to->history = from->history;
}
int32_t gnomon_history_events(const gnomon_history* history, gnomon_event* events, int32_t room) {
  if (history == nullptr) return 0;
  const std::span<const PlanEvent> all = history->history.events();
  for (std::size_t i = 0; i < all.size() && events != nullptr && static_cast<int32_t>(i) < room; ++i)
    events[i] = {static_cast<int32_t>(all[i].kind), all[i].map, all[i].density_ratio};
  return static_cast<int32_t>(all.size());
}

int32_t gnomon_select(const gnomon_plan* plan, const double* points, const double* view_depths, int64_t count,
                      int32_t* indices, const char** invalid_field) {
  ShadowPlan p;
  if (const char* fault = to_plan(plan, p)) return refuse(fault, invalid_field);
  if (count < 0) return refuse("count", invalid_field);
  std::span<const glm::dvec3> list;
  if (const char* fault = to_points(points, count, "points", list)) return refuse(fault, invalid_field);
  if (count > 0 && view_depths == nullptr) return refuse("view_depths", invalid_field);
  if (count > 0 && indices == nullptr) return refuse("indices", invalid_field);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!usable(list[i])) return refuse("points", invalid_field);
    if (!usable(view_depths[i])) return refuse("view_depths", invalid_field);
  }
  for (std::size_t i = 0; i < list.size(); ++i) indices[i] = map_serving(p, list[i], view_depths[i]);
  return done(invalid_field);
}

int32_t gnomon_rebased(const gnomon_map* map, const double origin[3], gnomon_map* to,
                       const char** invalid_field) {
  ShadowMap record;
  if (const char* fault = to_map(map, record)) return refuse(fault, invalid_field);
  if (origin == nullptr || !usable(to_vector(origin))) return refuse("origin", invalid_field);
  if (fault_of(to) != nullptr) return refuse("to", invalid_field);
  gnomon_map all;
  set_defaults(all);
  from_map(rebased(record, to_vector(origin)), all);
  write(all, to);
  return done(invalid_field);
}

int32_t gnomon_compare(const gnomon_map* previous, const gnomon_map* current,
                       const gnomon_clip_space* clip_space, gnomon_reuse* out, const char** invalid_field) {
  ShadowMap before, now;
  if (const char* fault = to_map(previous, before)) return refuse(fault, invalid_field);
  if (const char* fault = to_map(current, now)) return refuse(fault, invalid_field);
  if (out == nullptr) return refuse("reuse", invalid_field);
  const MapReuse found = reuse(before, now, to_clip_space(clip_space));
  *out = {static_cast<int32_t>(found.kind),
          found.shift_x,
          found.shift_y,
          found.strip_count,
          from_rect(found.kept),
          {from_rect(found.strip[0]), from_rect(found.strip[1])}};
  return done(invalid_field);
}

int32_t gnomon_rectangle_planes(const gnomon_map* map, const gnomon_texel_rect* rectangle,
                                const gnomon_clip_space* clip_space, double planes[20],
                                const char** invalid_field) {
  ShadowMap record;
  if (const char* fault = to_map(map, record)) return refuse(fault, invalid_field);
  if (rectangle == nullptr || rectangle->x < 0 || rectangle->y < 0 || rectangle->width < 1 ||
      rectangle->height < 1 || rectangle->width > record.width - rectangle->x ||
      rectangle->height > record.height - rectangle->y)
    return refuse("rectangle", invalid_field);
  if (planes == nullptr) return refuse("planes", invalid_field);
  const auto found = rectangle_planes(record, to_rect(*rectangle), to_clip_space(clip_space));
  for (std::size_t i = 0; i < found.size(); ++i) from_vector(found[i], planes + 4 * i);
  return done(invalid_field);
}

int32_t gnomon_shader_block(const gnomon_plan* plan, int32_t layer_width, int32_t layer_height,
                            double blur_texels, float block[GNOMON_SHADER_BLOCK_FLOATS],
                            const char** invalid_field) {
  ShadowPlan p;
  if (const char* fault = to_plan(plan, p)) return refuse(fault, invalid_field);
  if (layer_width < 0) return refuse("layer_width", invalid_field);
  if (layer_height < 0) return refuse("layer_height", invalid_field);
  if (!(blur_texels >= 0.0 && blur_texels <= kLargest)) return refuse("blur_texels", invalid_field);
  if (block == nullptr) return refuse("block", invalid_field);
  const ShaderBlock all = shader_block(p, {layer_width, layer_height, blur_texels});
  std::memcpy(block, &all, sizeof all);
  return done(invalid_field);
}

void gnomon_visible_depths_clear(gnomon_visible_depths* depths) {
  if (depths != nullptr) *reinterpret_cast<VisibleDepths*>(depths) = {};
}
int32_t gnomon_visible_depths_add(gnomon_visible_depths* depths, const float* view_depths, int64_t count,
                                  const char** invalid_field) {
  if (depths == nullptr) return refuse("depths", invalid_field);
  if (count < 0) return refuse("count", invalid_field);
  if (view_depths == nullptr && count > 0) return refuse("view_depths", invalid_field);
  reinterpret_cast<VisibleDepths*>(depths)->add(
      std::span<const float>(view_depths, static_cast<std::size_t>(count)));
  return done(invalid_field);
}

}  // extern "C"
