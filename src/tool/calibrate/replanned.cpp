// A view of a sweep as the planner sees it: what it predicts of each technique, and which it picks.
#include "replanned.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "animation_words.hpp"
#include "identifier_word.hpp"

namespace gnomon::tool {
namespace {

constexpr double kMega = 1e6;

/// The scene under a row's light: one of a kind, or one of several over the scene, as "spot 1 of 8".
SceneView lit_scene(const report::Row& row) {
  LightPlacement placement{LightKind::sun, row.light_elevation_deg, row.light_azimuth_deg};
  const std::size_t word_end = row.light.find(' ');
  if (!light_kind_from_name(row.light.substr(0, word_end), placement.kind))
    throw std::runtime_error("light '" + row.light + "': wants sun, spot or point");
  SceneView scene(row.scene, placement);
  if (word_end == std::string::npos) return scene;
  int number = 0, count = 0, read = 0;
  if (std::sscanf(row.light.c_str() + word_end, " %d of %d%n", &number, &count, &read) != 2 ||
      word_end + static_cast<std::size_t>(read) != row.light.size() || number < 1 || number > count ||
      count > kMostLocalLights)
    throw std::runtime_error("light '" + row.light + "': wants the number of a light, as in spot 1 of 8");
  scene.set_light(local_lights(count, scene.scene().bounds_world)[static_cast<std::size_t>(number - 1)]);
  return scene;
}

/// The same, where it plays an animation in the row's pose.
SceneView posed_scene(const report::Row& row) {
  SceneView scene = lit_scene(row);
  if (row.animation.empty()) return scene;
  const Scene at_rest = scene.scene();
  const int animation = animation_of(row.scene, at_rest.motion, row.animation);
  const Animation& played = at_rest.motion.animations[static_cast<std::size_t>(animation)];
  Pose posed;
  (void)pose(at_rest, animation, looped_time(played, row.animation_time_s), posed);
  scene.take(posed);
  return scene;
}

/// Half side of the box of comparisons that the filter averages, texels.
double averaged_texels(const render::FilterSettings& filter) noexcept {
  const render::FilterInfo& info = filter.filter->info;
  const bool averages = info.has_kernel && info.penumbra_radius_world == nullptr;
  return averages && filter.unit == render::KernelUnit::texels ? filter.radius + 0.5 : 0.0;
}

/// It takes comparisons of depths as they are, or averages them.
bool compares(const render::FilterSettings& filter) noexcept {
  const render::FilterInfo& info = filter.filter->info;
  return info.reads == render::MapRead::depth && info.penumbra_radius_world == nullptr;
}

/// Places of a frame's pixels, as a renderer gives them: from the camera, with the view depth; 0 where there
/// is sky.
FloatImage positions_of(const trace::SeenShadow& seen) {
  const Camera& camera = seen.camera;
  const CameraAxes axes = camera_axes(camera);
  FloatImage positions{camera.width, camera.height, 4, {}, {}};
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const float depth = seen.view_depths[positions.values.size() / 4];
      const double scale = camera.orthographic ? 1.0 : static_cast<double>(depth);
      const double right = camera.left + (camera.right - camera.left) * (column + 0.5) / camera.width,
                   up = camera.top + (camera.bottom - camera.top) * (row + 0.5) / camera.height;
      const glm::vec3 from_camera(axes.forward * static_cast<double>(depth) + axes.right * (right * scale) +
                                  axes.up * (up * scale));
      positions.values.insert(positions.values.end(), {from_camera.x, from_camera.y, from_camera.z, depth});
    }
  }
  return positions;
}

report::Technique without_filter(report::Technique technique) {
  technique.filter.clear();
  return technique;
}

}  // namespace

std::vector<View> views_of(const std::vector<report::Row>& rows) {
  std::map<std::string, std::size_t> known;
  std::vector<View> views;
  for (const report::Row& row : rows) {
    // No model predicts these: they read no map, or other maps.
    if (row.technique.filter.starts_with(kIrregular) || row.technique.filter.starts_with(kIdentifiers))
      continue;
    if (row.technique.is_given()) continue;  // planned by others
    // Its pages follow from the frames before.
    if (const PagePolicy* const policy = find_page_policy(row.technique.pages);
        policy != nullptr && (policy->feedback & kShadowChanged) != 0)
      continue;
    if (!row.times.known()) continue;  // of a frame that was not timed
    // Rows do not hold what the files of a path and of shadow proxies do.
    if (!row.camera.empty() || !row.edits.empty()) continue;
    const std::string light = fmt::format("{} {:g}/{:g} {}x{}", row.light, row.light_elevation_deg,
                                          row.light_azimuth_deg, row.width, row.height);
    const std::string scene =
        row.animation.empty() ? row.scene : fmt::format("{} playing {}", row.scene, row.animation);
    const std::string name = fmt::format("{} {}/{} {}", scene, row.frame + 1, row.frames, light);
    const auto [found, is_new] = known.try_emplace(name, views.size());
    if (is_new) views.push_back({name, fmt::format("{}, {} frames, {}", scene, row.frames, light), {}});
    views[found->second].rows.push_back(row);
  }
  return views;
}

double wrong_pixels(const report::Row& row) noexcept {
  return row.errors.false_lit + row.errors.false_shadow;
}

Replanned::Replanned(const View& view)
    : name_(view.name),
      scene_(posed_scene(view.rows.front())),
      camera_(scene_.camera(view.rows.front().frame, view.rows.front().frames, view.rows.front().width,
                            view.rows.front().height)),
      tracer_(scene_.scene()),
      shadow_(trace::seen_shadow(tracer_, camera_, scene_.light())) {
  surfaces_ = visible_surfaces(positions_of(shadow_), nullptr, camera_);
  // What is turned away from the light is drawn dark.
  std::vector<float> lit = shadow_.mask;
  for (float& value : lit) value = std::max(value, 0.0f);
  feedback_ = feedback_of(surfaces_, lit, {});
  for (std::size_t i = 0; i < feedback_.size(); ++i)
    feedback_[i] |= static_cast<std::uint8_t>(surfaces_.depth_edges[i] ? kDepthEdge : 0);
}

PageOptions Replanned::pages_of(const SweepEntry& entry) const noexcept {
  PageOptions pages = entry.pages;
  pages.plan = entry.plan;
  const bool positional = !std::holds_alternative<DirectionalLight>(scene_.light());
  const bool spot = std::holds_alternative<SpotLight>(scene_.light());
  pages.capacity = page_capacity(entry, !positional ? LightKind::sun
                                        : spot      ? LightKind::spot
                                                    : LightKind::point);
  return pages;
}

report::Observation Replanned::observe(const report::Row& row) const {
  const SweepEntry entry = sweep_entry(row.technique);
  report::Observation o;
  o.view = name_;
  o.filter = row.technique.filter;
  o.pages = entry.by_pages();
  o.megapixels = static_cast<double>(row.width) * row.height / kMega;
  o.bytes_per_texel = render::bytes_per_texel(entry.filter);
  o.frame_ms = row.times.plan_ns.median / kMega;
  o.depth_ms = row.times.depth_ms.median;
  o.prefilter_ms = row.times.prefilter_ms.median;
  o.lookup_ms = row.times.shade_ms.median;
  o.kernel_texels = averaged_texels(entry.filter);
  o.extent = entry.plan.filter;
  o.compares = compares(entry.filter);
  o.wrong = wrong_pixels(row);
  o.pixels = static_cast<double>(row.errors.pixels);
  const auto predict = [&](const auto& plan) {
    o.work = planned_work(plan, scene_.bounds(), scene_.work());
    const ShadowPicture shadow = shadow_.picture();
    o.expected = expected_error(plan, shadow, o.kernel_texels, pixels_between(shadow)).share();
  };
  if (!o.pages) {
    predict(make_plan(camera_, scene_.light(), scene_.bounds(), entry.plan));
    return o;
  }
  const PageOptions options = pages_of(entry);
  std::vector<std::byte> memory(page_memory(options.capacity, surfaces_.points.size()));
  const gnomon::View seen{.camera = camera_, .points_world = surfaces_.points};
  const PageHistory history{nullptr, feedback_};
  predict(plan_pages(seen, scene_.light(), scene_.bounds(), options, memory, &history));
  return o;
}

Replanned::Choice Replanned::choose(const View& view, const Budget& budget,
                                    const report::StoredCostModel& model) const {
  std::vector<const Warp*> warps;
  std::vector<SplitScheme> splits;
  std::vector<int> cascades, sizes;
  std::vector<report::Technique> paged;  // without their filters
  std::vector<PageOptions> pages;
  const report::Technique* maps = nullptr;
  int capacity = 0;
  const auto once = [](auto& list, const auto& value) {
    const bool is_new = std::find(list.begin(), list.end(), value) == list.end();
    if (is_new) list.push_back(value);
    return is_new;
  };
  for (const report::Row& row : view.rows) {
    const SweepEntry entry = sweep_entry(row.technique);
    if (entry.by_pages()) {
      if (!once(paged, without_filter(row.technique))) continue;
      pages.push_back(pages_of(entry));
      capacity = std::max(capacity, pages.back().capacity);
      continue;
    }
    if (entry.plan.fit != Fit::tight || entry.plan.split.partition != Partition::view_depth ||
        entry.plan.warp.warp == nullptr || !entry.plan.warp.shape->affine)
      throw std::runtime_error(row.technique.name() +
                               ": the planner chooses among named warps with linear texels, split by depth");
    if (maps == nullptr) maps = &row.technique;
    once(warps, entry.plan.warp.warp);
    once(splits, entry.plan.split.scheme);
    once(cascades, entry.plan.cascades);
    once(sizes, entry.plan.resolution.max_size);
  }
  if (maps == nullptr) throw std::runtime_error(view.name + ": has pages alone, and no maps beside them");
  if (splits.size() > 1) throw std::runtime_error(view.name + ": more than one kind of split");
  std::vector<FilterCost> filters;
  const CostModel costs = model.view(filters);
  std::vector<std::byte> memory(pages.empty() ? 0 : page_memory(capacity, surfaces_.points.size()));
  const TechniqueChoice choice =
      choose_technique(camera_, shadow_.picture(), scene_.light(), scene_.bounds(), scene_.work(),
                       {warps, splits, cascades, sizes, {pages, surfaces_.points, feedback_, memory}}, budget,
                       costs, sweep_entry(*maps).plan);
  if (choice.status == PlanStatus::invalid_input)
    throw std::runtime_error(view.name + ": no technique for " + std::string(choice.invalid_field));
  if (choice.status != PlanStatus::ok) return {choice.status};
  const Technique& chosen = choice.chosen;
  Choice named{choice.status, *maps, chosen.error, chosen.texels};
  if (chosen.pages >= 0) {
    named.technique = paged[static_cast<std::size_t>(chosen.pages)];
  } else {
    named.technique.warp = chosen.warp->name;
    named.technique.cascades = chosen.cascades;
    named.technique.map_size = chosen.map_size;
  }
  const auto& known = chosen.pages >= 0 ? model.pages.filters : model.filters;
  named.technique.filter = known[static_cast<std::size_t>(chosen.filter)].name;
  return named;
}

}  // namespace gnomon::tool
