// From many lights to their maps in one pool: input checks, importance, sizes, places, and which are due.
#include "gnomon/lights.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "geometry/usable.hpp"
#include "geometry/vector.hpp"
#include "lights/importance.hpp"
#include "lights/sizes.hpp"
#include "plan/input.hpp"
#include "plan/memory.hpp"
#include "resolve/resolve.hpp"

namespace gnomon {
namespace {

constexpr int kMaxPoolSide = 1 << 16;

bool power_of_two(int value) noexcept {
  return value > 0 && std::has_single_bit(static_cast<unsigned>(value));
}

/// The side of the smallest maps that any budget leads to.
int smallest_side(const LightOptions& o) noexcept {
  const int side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(least_budget_side(o.plan))));
  return o.page_budget > 0 ? std::max(side, o.page_texels) : side;
}

std::string_view invalid_budgets(const LightOptions& o) noexcept {
  const LightCosts& costs = o.costs;
  if (o.texel_budget < 1) return "lights.texel_budget";
  if (o.page_budget < 0) return "lights.page_budget";
  if (o.page_budget > 0 && (!power_of_two(o.page_texels) || o.page_texels > o.most_size))
    return "lights.page_texels";
  if (!(o.millisecond_budget >= 0.0 && o.millisecond_budget <= kLargest)) return "lights.millisecond_budget";
  for (const double cost : {costs.per_map, costs.per_megatexel, costs.per_kilodraw, costs.per_megatriangle})
    if (!(cost >= 0.0 && cost <= kLargest)) return "lights.costs";
  return {};
}

std::string_view invalid_options(const LightOptions& o) noexcept {
  // Before its sides are computed from it.
  if (!(o.plan.filter.texels >= 0.0 && o.plan.filter.texels <= 0.25 * kMaxMapSize))
    return "options.filter.texels";
  if (!power_of_two(o.most_size) || o.most_size > kMaxMapSize || o.most_size < least_budget_side(o.plan))
    return "lights.most_size";
  if (!power_of_two(o.least_size) || o.least_size > o.most_size) return "lights.least_size";
  for (const int side : {o.pool_width, o.pool_height}) {
    if (side < 1 || side > kMaxPoolSide || side % o.most_size != 0)
      return "lights.pool_width, lights.pool_height";
  }
  if (const std::string_view field = invalid_budgets(o); !field.empty()) return field;
  if (!(o.enough_m >= 0.0 && o.enough_m <= kLargest)) return "lights.enough_m";
  if (o.most_frames < 1 || o.most_frames > kMaxCadenceFrames) return "lights.most_frames";
  if (!(o.full_share > 0.0 && o.full_share <= 1.0)) return "lights.full_share";
  if (!(o.keep_gain >= 1.0 && o.keep_gain <= kLargest)) return "lights.keep_gain";
  return {};
}

/// The caller's memory, in parts.
struct LightMemory {
  std::span<LightMaps> maps;     // one for each light
  std::span<LightWork> work;     // one for each light
  std::span<LightPlace> places;  // kMaxMaps for each light
  std::span<LightPoint> points;  // one for each visible point
  std::span<Polytope> view;      // one
  std::span<ShadowPlan> sun;     // one, of the sun that is looked at
};

LightMemory parts_of(std::span<std::byte> memory, std::size_t lights, std::size_t points) noexcept {
  MemoryParts parts(memory);
  return {parts.take<LightMaps>(lights),
          parts.take<LightWork>(lights),
          parts.take<LightPlace>(kMaxMaps * lights),
          parts.take<LightPoint>(points),
          parts.take<Polytope>(1),
          parts.take<ShadowPlan>(1)};
}

std::string_view invalid_request(const LightRequest& request) noexcept {
  const auto counts = [](double v) { return v >= 0.0 && v <= kLargest; };
  if (!counts(request.weight)) return "light.weight";
  if (!counts(request.draws)) return "light.draws";
  return counts(request.triangles) ? std::string_view{} : "light.triangles";
}

/// The first broken input; `plan` takes its name.
bool refuse(const View& view, std::span<const LightRequest> lights, const SceneBounds& bounds,
            const PlanOptions& options, LightPlan& plan) noexcept {
  if (lights.size() > kMaxLights) {
    plan.invalid_field = "lights";
    return true;
  }
  plan.invalid_field = first_invalid_field(view, DirectionalLight{}, bounds, options);
  if (!plan.invalid_field.empty()) return true;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    // Boxes and points may be many: they are read once.
    plan.invalid_field = first_invalid_field(view.camera, lights[i].light, SceneBounds{}, options);
    if (plan.invalid_field.empty()) plan.invalid_field = invalid_request(lights[i]);
    if (plan.invalid_field.empty()) continue;
    plan.invalid_light = static_cast<int>(i);
    return true;
  }
  return false;
}

bool same(const glm::dvec3& a, const glm::dvec3& b) noexcept {
  return a == b;
}
bool same_light(const Light& a, const Light& b) noexcept {
  if (a.index() != b.index()) return false;
  if (const auto* sun = std::get_if<DirectionalLight>(&a))
    return same(sun->direction, std::get_if<DirectionalLight>(&b)->direction);
  if (const auto* spot = std::get_if<SpotLight>(&a)) {
    const auto* other = std::get_if<SpotLight>(&b);
    return same(spot->position, other->position) && same(spot->direction, other->direction) &&
           spot->outer_radians == other->outer_radians && spot->range == other->range;
  }
  const auto *point = std::get_if<PointLight>(&a), *other = std::get_if<PointLight>(&b);
  return point != nullptr && other != nullptr && same(point->position, other->position) &&
         point->range == other->range;
}

int level_of(int side, int least) noexcept {
  return side > least ? static_cast<int>(std::bit_width(static_cast<unsigned>(side / least))) - 1 : 0;
}

/// Frames from one drawing to the next for a light that lights this share of the picture.
int frames_for(const Light& light, double share, const LightOptions& o) noexcept {
  // A sun's cascades follow the view.
  if (std::holds_alternative<DirectionalLight>(light)) return 1;
  int frames = 1;
  for (; share < o.full_share && frames < o.most_frames; share *= 2.0) frames *= 2;
  return std::min(frames, o.most_frames);
}

/// One call of plan_lights.
class LightPlanner {
 public:
  LightPlanner(std::span<const LightRequest> lights, const LightOptions& options, const SizeLadder& ladder,
               const LightMemory& memory, LightHistory* history, LightPlan& plan) noexcept
      : lights_(lights), options_(options), ladder_(ladder), memory_(memory), history_(history), plan_(plan) {
    grid_ = {ladder.least, ladder.top, options.pool_width / options.most_size,
             options.pool_height / options.most_size};
  }

  void weigh(const LightView& view) noexcept;
  /// The budget that is too small for any sizes; empty where none is.
  [[nodiscard]] std::string_view size() noexcept;
  void place() noexcept;
  void finish() noexcept;

 private:
  [[nodiscard]] std::span<LightWork> mapped() const noexcept { return memory_.work.first(count_); }
  [[nodiscard]] LightMaps& maps_of(const LightWork& light) const noexcept {
    return memory_.maps[light.light];
  }
  /// nullptr where nothing is remembered of it.
  [[nodiscard]] const LightState* last_of(std::uint32_t light) const noexcept {
    if (history_ == nullptr) return nullptr;
    const LightState& state = history_->lights[light];
    return state.frame >= 0 ? &state : nullptr;
  }
  /// Whether its maps can stay where they are.
  [[nodiscard]] bool stays(const LightWork& light) const noexcept {
    const LightState* last = last_of(light.light);
    return last != nullptr && last->size == maps_of(light).size && last->map_count == light.maps;
  }
  /// Of one drawing of its maps, whatever their size.
  [[nodiscard]] double fixed_milliseconds(const LightRequest& request, int maps) const noexcept {
    return options_.costs.per_map * maps + 1e-3 * options_.costs.per_kilodraw * request.draws +
           1e-6 * options_.costs.per_megatriangle * request.triangles;
  }
  [[nodiscard]] bool place_all(bool keep) noexcept;
  [[nodiscard]] bool due(const LightWork& light) const noexcept;

  std::span<const LightRequest> lights_;
  const LightOptions& options_;
  const SizeLadder& ladder_;
  const LightMemory& memory_;
  LightHistory* history_;
  LightPlan& plan_;
  PoolGrid grid_;
  std::size_t count_ = 0;  // lights with maps
  bool any_receiver_ = false;
};

void LightPlanner::weigh(const LightView& view) noexcept {
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    const LightRequest& request = lights_[i];
    const LightImportance found = importance_of(view, request.light);
    LightMaps& maps = memory_.maps[i];
    maps = {};
    maps.outcome = found.outcome;
    any_receiver_ = any_receiver_ || found.outcome != LightOutcome::without_receiver;
    if (found.outcome != LightOutcome::mapped) continue;
    maps.share = found.share;
    // Texels for m = 1, until the size is known.
    maps.m = std::isfinite(found.demand) ? min_of(found.demand, kLargest) : kLargest;
    maps.frames = frames_for(request.light, found.share, options_);
    maps.map_count = maps.frames > 1 ? found.all_maps : found.seen_maps;
    int top = ladder_.top;
    if (options_.enough_m > 0.0) {
      for (top = ladder_.floor; top < ladder_.top && maps.m > options_.enough_m * ladder_.inside(top);) ++top;
    }
    const LightState* last = last_of(i);
    const double square = static_cast<double>(ladder_.least) * ladder_.least;
    memory_.work[count_++] = {request.weight * found.share * maps.m,
                              0.0,
                              i,
                              maps.map_count,
                              0,
                              top,
                              last != nullptr ? level_of(last->size, ladder_.least) : 0,
                              1e-6 * options_.costs.per_megatexel * square * maps.map_count / maps.frames,
                              fixed_milliseconds(request, maps.map_count) / maps.frames};
  }
}

std::string_view LightPlanner::size() noexcept {
  const std::int64_t square = std::int64_t{ladder_.least} * ladder_.least;
  SizeBudget budget{std::min<std::int64_t>(options_.texel_budget / square, grid_.squares())};
  const std::int64_t page = std::int64_t{options_.page_texels} * options_.page_texels;
  if (options_.page_budget > 0) budget.cells = std::min(budget.cells, options_.page_budget * page / square);
  // Sums in another order are off by less.
  constexpr double kRounding = 1e-12;
  if (options_.millisecond_budget > 0.0)
    budget.milliseconds = options_.millisecond_budget * (1.0 - kRounding);
  if (!choose_sizes(mapped(), ladder_, budget, options_.keep_gain)) {
    std::int64_t maps = 0;
    for (const LightWork& light : mapped()) maps += light.maps;
    if (maps <= budget.cells) return "lights.millisecond_budget";
    return options_.page_budget > 0 ? "lights.page_budget" : "lights.texel_budget";
  }
  for (const LightWork& light : mapped()) {
    LightMaps& maps = maps_of(light);
    maps.size = ladder_.least << light.level;
    maps.m /= ladder_.inside(light.level);
    if (light.level < ladder_.floor) maps.outcome = LightOutcome::below_least_size;
    plan_.texels += std::int64_t{maps.size} * maps.size * light.maps;
    plan_.error += lights_[light.light].weight * maps.share * maps.m;
  }
  plan_.milliseconds = milliseconds_of(mapped());
  if (options_.page_budget > 0) plan_.pages = plan_.texels / page;
  return {};
}

/// Keeps maps of the same size where they are, and places the others largest first. False where what is kept
/// leaves no room for one of them.
bool LightPlanner::place_all(bool keep) noexcept {
  TakenRuns taken(memory_.places);
  if (keep) {
    for (const LightWork& light : mapped()) {
      if (!stays(light)) continue;
      const LightState& last = *last_of(light.light);
      for (std::size_t k = 0; k < static_cast<std::size_t>(light.maps); ++k) {
        taken.add(last.place[k], static_cast<std::uint32_t>(SizeLadder::cells(light.level)));
        maps_of(light).place[k] = grid_.rectangle(last.place[k], light.level);
      }
    }
    // States that were copied from one light to another.
    if (!taken.sort(grid_.squares())) return false;
  }
  for (int level = ladder_.top; level >= 0; --level) {
    TakenRuns::Cursor cursor;
    for (const LightWork& light : mapped()) {
      if (light.level != level || (keep && stays(light))) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(light.maps); ++k) {
        std::uint32_t begin = 0;
        if (!taken.take(cursor, static_cast<std::uint32_t>(SizeLadder::cells(level)), grid_.squares(), begin))
          return false;
        maps_of(light).place[k] = grid_.rectangle(begin, level);
      }
    }
  }
  return true;
}

void LightPlanner::place() noexcept {
  const bool keeps = history_ != nullptr;
  if (keeps && place_all(true)) return;
  plan_.repacked = keeps;
  // Longest first and into an empty pool they fit: choose_sizes counted no more squares than there are.
  static_cast<void>(place_all(false));
}

bool LightPlanner::due(const LightWork& light) const noexcept {
  const LightState* last = last_of(light.light);
  const LightRequest& request = lights_[light.light];
  const LightMaps& maps = maps_of(light);
  if (last == nullptr || request.changed || !stays(light) || !same_light(last->light, request.light))
    return true;
  for (std::size_t k = 0; k < static_cast<std::size_t>(light.maps); ++k) {
    if (!(maps.place[k] == grid_.rectangle(last->place[k], light.level))) return true;
  }
  const std::int64_t now = history_->frame;
  // By turns, so that not all fall into one frame.
  return now - last->frame >= maps.frames || (now + light.light) % maps.frames == 0;
}

/// The square at which a map lies: the inverse of PoolGrid::rectangle.
std::uint32_t square_at(const PoolGrid& grid, const TexelRect& rectangle) noexcept {
  const int cell_side = grid.least << grid.top;
  const int cell = rectangle.y / cell_side * grid.columns + rectangle.x / cell_side;
  std::uint32_t square = static_cast<std::uint32_t>(cell) << (2 * grid.top);
  const auto x = static_cast<std::uint32_t>(rectangle.x % cell_side / grid.least);
  const auto y = static_cast<std::uint32_t>(rectangle.y % cell_side / grid.least);
  for (int bit = 0; bit < grid.top; ++bit)
    square |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
  return square;
}

/// Which lights are due, and what the next frame remembers of all of them.
void LightPlanner::finish() noexcept {
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    const bool has_maps = at < count_ && memory_.work[at].light == i;
    if (!has_maps) {
      if (history_ != nullptr) history_->lights[i] = {};
      continue;
    }
    const LightWork& light = memory_.work[at++];
    LightMaps& maps = memory_.maps[i];
    maps.due = due(light);
    ++plan_.mapped;
    if (maps.due) {
      ++plan_.due;
      plan_.due_texels += std::int64_t{maps.size} * maps.size * light.maps;
      plan_.due_milliseconds +=
          (light.fixed + light.price * static_cast<double>(SizeLadder::cells(light.level))) * maps.frames;
    }
    if (history_ == nullptr || !maps.due) continue;
    LightState& state = history_->lights[i];
    state.light = lights_[i].light;
    state.frame = history_->frame;
    state.size = maps.size;
    state.map_count = light.maps;
    for (std::size_t k = 0; k < static_cast<std::size_t>(light.maps); ++k)
      state.place[k] = square_at(grid_, maps.place[k]);
  }
  plan_.status = plan_.mapped > 0 ? PlanStatus::ok
                 : any_receiver_  ? PlanStatus::no_caster
                                  : PlanStatus::nothing_visible;
  if (history_ == nullptr) return;
  ++history_->frame;
  history_->options = options_;
  history_->least_side = ladder_.least;
}

/// Places of another pool are none of this one.
void forget_other_pool(const LightOptions& now, int least, LightHistory& history) noexcept {
  const LightOptions& last = history.options;
  bool other = now.pool_width != last.pool_width || now.pool_height != last.pool_height ||
               now.most_size != last.most_size || history.least_side != least;
  for (const LightState& state : history.lights) {
    if (state.frame < 0) continue;
    other = other || state.size < least || state.size > now.most_size || state.frame >= history.frame ||
            state.map_count < 1 || state.map_count > kMaxMaps;
  }
  if (!other) return;
  for (LightState& state : history.lights) state = {};
}

}  // namespace

std::size_t light_memory(std::size_t lights, std::size_t points) noexcept {
  return kMemorySlack + memory_of<LightMaps>(lights) + memory_of<LightWork>(lights) +
         memory_of<LightPlace>(kMaxMaps * lights) + memory_of<LightPoint>(points) + memory_of<Polytope>(1) +
         memory_of<ShadowPlan>(1);
}

LightPlan plan_lights(const View& view, std::span<const LightRequest> lights, const SceneBounds& bounds,
                      const LightOptions& options, std::span<std::byte> memory,
                      LightHistory* history) noexcept {
  LightPlan plan;
  plan.invalid_field = invalid_options(options);
  if (!plan.invalid_field.empty()) return plan;
  const int least = smallest_side(options);
  const PlanOptions reference = resolve_lights(options.plan, least);
  View seen = view;
  seen.depths = nullptr;  // not read
  if (refuse(seen, lights, bounds, reference, plan)) return plan;
  if (memory.size() < light_memory(lights.size(), view.points_world.size())) plan.invalid_field = "memory";
  if (history != nullptr && history->lights.size() < lights.size()) plan.invalid_field = "history.lights";
  if (!plan.invalid_field.empty()) return plan;
  if (history != nullptr) forget_other_pool(options, least, *history);
  plan.pool_width = options.pool_width;
  plan.pool_height = options.pool_height;
  const LightMemory parts = parts_of(memory, lights.size(), view.points_world.size());
  const SizeLadder ladder{least, level_of(options.least_size, least), level_of(options.most_size, least),
                          std::ceil(options.plan.filter.texels)};
  LightPlanner planner(lights, options, ladder, parts, history, plan);
  seen.camera = with_finite_far(view.camera, bounds.receivers);
  planner.weigh(light_view(seen, bounds, reference, parts.points, parts.view.front(), parts.sun.data(),
                           options.most_size));
  if (const std::string_view too_small = planner.size(); !too_small.empty()) {
    plan = {};
    plan.invalid_field = too_small;
    return plan;
  }
  planner.place();
  planner.finish();
  plan.lights = parts.maps;
  return plan;
}

PlanOptions light_options(const LightOptions& options, const LightMaps& maps) noexcept {
  return resolve_lights(options.plan, maps.size > 0 ? maps.size : options.plan.resolution.max_size);
}

Camera camera_round(const Light& light, const Camera& camera) noexcept {
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  if (spot == nullptr && point == nullptr) return camera;
  const glm::dvec3 position = spot != nullptr ? spot->position : point->position;
  // Room for the rounding of its planes.
  const double half = (spot != nullptr ? spot->range : point->range) * (1.0 + 1.0 / 256.0);
  Camera round = orthographic_camera(position + glm::dvec3(0.0, 0.0, half), {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0},
                                     2.0 * half, 1.0, 0.0, 2.0 * half, camera.width, camera.height);
  return round;
}

Atlas light_atlas(const LightPlan& plan, std::size_t light) noexcept {
  Atlas atlas;
  if (light >= plan.lights.size() || plan.lights[light].map_count == 0) return atlas;
  const LightMaps& maps = plan.lights[light];
  atlas.width = plan.pool_width;
  atlas.height = plan.pool_height;
  atlas.place = maps.place;
  atlas.count = maps.map_count;
  atlas.efficiency = static_cast<double>(maps.size) * maps.size * maps.map_count /
                     (static_cast<double>(plan.pool_width) * plan.pool_height);
  return atlas;
}

OmissionText describe(const LightMaps& maps, const LightOptions& options) noexcept {
  OmissionText text{};
  const auto write = [&](const char* what, const char* why) {
    std::snprintf(text.what.data(), text.what.size(), "%s", what);
    std::snprintf(text.why.data(), text.why.size(), "%s", why);
  };
  switch (maps.outcome) {
    case LightOutcome::mapped:
      write("none", "the light has maps of at least the least size");
      break;
    case LightOutcome::below_least_size:
      std::snprintf(text.what.data(), text.what.size(), "maps of %d in place of %d", maps.size,
                    options.least_size);
      std::snprintf(text.why.data(), text.why.size(), "the budget does not suffice for all lights");
      break;
    case LightOutcome::without_receiver:
      write("all maps", "the light lights no receiver in view");
      break;
    case LightOutcome::without_caster:
      write("all maps", "no caster lies within the light's range and cone");
      break;
  }
  return text;
}

}  // namespace gnomon
