// Plans of many lights, for C.
#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#include "c/convert.hpp"
#include "c/memory.hpp"
#include "plan/input.hpp"
#include "plan/memory.hpp"

struct gnomon_light_history {
  gnomon::LightState* lights = nullptr;
  gnomon::LightHistory history;
};

namespace gnomon::c {
namespace {

const char* to_light_options(const gnomon_light_options* from, LightOptions& to) noexcept {
  if (from == nullptr) return nullptr;
  gnomon_light_options o;
  if (const char* fault = read(from, o)) return fault;
  if (const char* fault = to_options(o.plan, to.plan)) return fault;
  to.pool_width = o.pool_width;
  to.pool_height = o.pool_height;
  to.texel_budget = o.texel_budget;
  to.page_budget = o.page_budget;
  to.page_texels = o.page_texels;
  to.millisecond_budget = o.millisecond_budget;
  to.costs = {o.cost_per_map, o.cost_per_megatexel, o.cost_per_kilodraw, o.cost_per_megatriangle};
  to.least_size = o.least_size;
  to.most_size = o.most_size;
  to.enough_m = o.enough_m;
  to.most_frames = o.most_frames;
  to.full_share = o.full_share;
  to.keep_gain = o.keep_gain;
  return nullptr;
}

const char* to_request(const void* from, std::uint32_t size, LightRequest& to) noexcept {
  gnomon_light_request r;
  set_defaults(r);
  read_bytes(from, size, r);
  if (r.light == nullptr) return "light_request.light";
  if (const char* fault = to_light(r.light, to.light)) return fault;
  to.weight = r.weight;
  to.changed = r.changed != 0;
  to.draws = r.draws;
  to.triangles = r.triangles;
  return nullptr;
}

gnomon_light_maps from_light_maps(const LightMaps& from) noexcept {
  gnomon_light_maps to{};
  to.size = sizeof to;
  to.outcome = static_cast<std::int32_t>(from.outcome);
  to.texels = from.size;
  to.map_count = from.map_count;
  for (std::size_t i = 0; i < from.place.size(); ++i) to.place[i] = from_rect(from.place[i]);
  to.share = from.share;
  to.m = from.m;
  to.frames = from.frames;
  to.due = from.due ? 1 : 0;
  return to;
}

const char* fault_of_rooms(const gnomon_light_plan* plan, std::int64_t count) noexcept {
  if (plan->light_room < count) return "light_plan.light_room";
  if (plan->lights == nullptr && count > 0) return "light_plan.lights";
  return count > 0 && !known_size<gnomon_light_maps>(plan->light_size) ? "light_plan.light_size" : nullptr;
}

std::int32_t refuse_lights(const char* fault, std::int32_t light, gnomon_light_plan* plan,
                           const char** invalid_field) noexcept {
  gnomon_light_plan p;
  if (read(plan, p) == nullptr) {
    p.status = GNOMON_INVALID_INPUT;
    p.invalid_light = light;
    p.light_count = 0;
    write(p, plan);
  }
  return refuse(fault, invalid_field);
}

void from_light_plan(const LightPlan& from, gnomon_light_plan& to) noexcept {
  to.status = static_cast<std::int32_t>(from.status);
  to.invalid_light = from.invalid_light;
  to.light_count = static_cast<std::int64_t>(from.lights.size());
  to.pool_width = from.pool_width;
  to.pool_height = from.pool_height;
  to.texels = from.texels;
  to.due_texels = from.due_texels;
  to.pages = from.pages;
  to.milliseconds = from.milliseconds;
  to.due_milliseconds = from.due_milliseconds;
  to.error = from.error;
  to.mapped = from.mapped;
  to.due = from.due;
  to.repacked = from.repacked ? 1 : 0;
  char* at = reinterpret_cast<char*>(to.lights);
  for (const LightMaps& maps : from.lights) {
    write_bytes(from_light_maps(maps), to.light_size, at);
    at += to.light_size;
  }
}

bool holds(const gnomon_light_history* history, std::int64_t light) noexcept {
  return history != nullptr && light >= 0 && static_cast<std::size_t>(light) < history->history.lights.size();
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

gnomon_light_history* gnomon_light_history_create(int64_t lights) {
  if (lights < 0 || lights > GNOMON_MAX_LIGHTS) return nullptr;
  auto* history = new_object<gnomon_light_history>();
  if (history == nullptr) return nullptr;
  const auto count = static_cast<std::size_t>(lights);
  history->lights = new_array<LightState>(count);
  if (history->lights == nullptr) {
    std::free(history);
    return nullptr;
  }
  history->history.lights = {history->lights, count};
  return history;
}

void gnomon_light_history_destroy(gnomon_light_history* history) {
  if (history == nullptr) return;
  std::free(history->lights);
  std::free(history);
}

void gnomon_light_history_swap(gnomon_light_history* history, int64_t a, int64_t b) {
  if (holds(history, a) && holds(history, b)) std::swap(history->lights[a], history->lights[b]);
}

void gnomon_light_history_forget(gnomon_light_history* history, int64_t light) {
  if (holds(history, light)) history->lights[light] = {};
}

int64_t gnomon_light_memory(int64_t lights, int64_t points) {
  if (lights < 0 || lights > GNOMON_MAX_LIGHTS || points < 0 || points > INT32_MAX) return 0;
  const auto count = static_cast<std::size_t>(lights);
  return static_cast<int64_t>(kMemorySlack + memory_of<LightRequest>(count) +
                              light_memory(count, static_cast<std::size_t>(points)));
}

int32_t gnomon_plan_lights(const gnomon_view* view, const gnomon_light_request* requests,
                           uint32_t request_size, int64_t count, const gnomon_scene* scene,
                           const gnomon_light_options* options, gnomon_light_history* history, void* memory,
                           int64_t bytes, gnomon_light_plan* plan, const char** invalid_field) {
  if (const char* fault = fault_of(plan)) return refuse(fault, invalid_field);
  View v;
  SceneBounds bounds;
  LightOptions o;
  const char* fault = to_view(view, v);
  if (fault == nullptr && (count < 0 || count > GNOMON_MAX_LIGHTS)) fault = "count";
  if (fault == nullptr && requests == nullptr && count > 0) fault = "requests";
  if (fault == nullptr && !known_size<gnomon_light_request>(request_size)) fault = "request_size";
  if (fault == nullptr) fault = fault_of_rooms(plan, count);
  if (fault == nullptr) fault = to_scene(scene, bounds);
  if (fault == nullptr) fault = to_light_options(options, o);
  if (fault == nullptr && memory == nullptr) fault = "memory";
  if (fault == nullptr && bytes < gnomon_light_memory(count, static_cast<int64_t>(v.points_world.size())))
    fault = "bytes";
  if (fault != nullptr) return refuse_lights(fault, -1, plan, invalid_field);
  MemoryParts parts({static_cast<std::byte*>(memory), static_cast<std::size_t>(bytes)});
  const auto total = static_cast<std::size_t>(count);
  const std::span<LightRequest> lights = parts.take<LightRequest>(total);
  for (std::size_t i = 0; i < total; ++i) {
    LightRequest* const light = new (&lights[i]) LightRequest;
    const char* at = reinterpret_cast<const char*>(requests) + i * request_size;
    if (const char* bad = to_request(at, request_size, *light))
      return refuse_lights(bad, static_cast<std::int32_t>(i), plan, invalid_field);
  }
  const std::span<std::byte> rest = parts.take<std::byte>(light_memory(total, v.points_world.size()));
  const LightPlan found =
      plan_lights(v, lights, bounds, o, rest, history != nullptr ? &history->history : nullptr);
  if (found.status == PlanStatus::invalid_input)
    return refuse_lights(gnomon::c::field_of(found.invalid_field), found.invalid_light, plan, invalid_field);
  gnomon_light_plan p;
  if (const char* late = read(plan, p)) return refuse(late, invalid_field);
  from_light_plan(found, p);
  write(p, plan);
  return done(invalid_field, p.status);
}

int32_t gnomon_light_plan_options(const gnomon_light_options* options, const gnomon_light_maps* maps,
                                  gnomon_plan_options* plan_options, const char** invalid_field) {
  LightOptions o;
  gnomon_light_maps m;
  if (const char* fault = to_light_options(options, o)) return refuse(fault, invalid_field);
  if (const char* fault = read(maps, m)) return refuse(fault, invalid_field);
  if (const char* fault = fault_of(plan_options)) return refuse(fault, invalid_field);
  LightMaps sizes;
  sizes.size = m.texels;
  sizes.map_count = m.map_count;
  gnomon_plan_options all;
  set_defaults(all);
  from_options(light_options(o, sizes), all);
  write(all, plan_options);
  return done(invalid_field);
}

int32_t gnomon_light_atlas(const gnomon_light_plan* plan, int64_t light, gnomon_atlas* atlas,
                           const char** invalid_field) {
  gnomon_light_plan p;
  if (const char* fault = read(plan, p)) return refuse(fault, invalid_field);
  if (p.lights == nullptr) return refuse("light_plan.lights", invalid_field);
  if (!known_size<gnomon_light_maps>(p.light_size)) return refuse("light_plan.light_size", invalid_field);
  if (light < 0 || light >= p.light_count || light >= p.light_room) return refuse("light", invalid_field);
  gnomon_light_maps maps;
  set_defaults(maps);
  read_bytes(reinterpret_cast<const char*>(p.lights) + light * p.light_size, p.light_size, maps);
  if (maps.map_count < 0 || maps.map_count > GNOMON_MAX_MAPS)
    return refuse("light_maps.map_count", invalid_field);
  if (p.pool_width < 1 || p.pool_height < 1) return refuse("light_plan.pool_width", invalid_field);
  if (atlas == nullptr) return refuse("atlas", invalid_field);
  LightMaps one;
  one.size = maps.texels;
  one.map_count = maps.map_count;
  for (std::size_t i = 0; i < one.place.size(); ++i) one.place[i] = to_rect(maps.place[i]);
  LightPlan of_one;
  of_one.lights = {&one, 1};
  of_one.pool_width = p.pool_width;
  of_one.pool_height = p.pool_height;
  *atlas = from_atlas(light_atlas(of_one, 0));
  return done(invalid_field);
}

int32_t gnomon_camera_round(const gnomon_light* light, const gnomon_camera* camera, gnomon_camera* round,
                            const char** invalid_field) {
  Light l;
  Camera c;
  if (const char* fault = to_light(light, l)) return refuse(fault, invalid_field);
  if (const char* fault = to_camera(camera, c)) return refuse(fault, invalid_field);
  if (fault_of(round) != nullptr) return refuse("round", invalid_field);
  const std::string_view field = first_invalid_field(c, l, {}, PlanOptions{});
  if (!field.empty()) return refuse(gnomon::c::field_of(field), invalid_field);
  gnomon_camera all;
  set_defaults(all);
  from_camera(camera_round(l, c), all);
  write(all, round);
  return done(invalid_field);
}

}  // extern "C"
