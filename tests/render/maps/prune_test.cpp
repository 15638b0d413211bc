// Does leaving out change the mask? Frames with every exact rule against the same frames with none, bit by
// bit.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "../scene/shared_files.hpp"
#include "base/random.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "prune_pair.hpp"

namespace gnomon::render {
namespace {

constexpr int kWidth = 160, kHeight = 90, kMapSize = 256;

double mean_difference(const FloatImage& a, const FloatImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values.size(); i += 2) sum += std::abs(a.values[i] - b.values[i]);
  return 2.0 * sum / static_cast<double>(a.values.size());
}

struct Tally {
  std::size_t views = 0, shadowed = 0, held = 0;
  std::array<PruneSaving, kPruneRuleCount> saved{};
  void add(const FrameStats& stats) {
    for (std::size_t r = 0; r < kPruneRuleCount; ++r) {
      saved[r].instances += stats.saved[r].instances;
      saved[r].maps += stats.saved[r].maps;
    }
    for (int i = 0; i < stats.map_count; ++i) {
      const MapStats& map = stats.map[static_cast<std::size_t>(i)];
      held += map.held ? 1 : 0;
    }
  }
  [[nodiscard]] const PruneSaving& of(PruneRule rule) const { return saved[static_cast<std::size_t>(rule)]; }
};

/// A sun, or a local light over what the camera is about to see.
Light random_light(std::uint64_t seed, Random& random, const Camera& camera, double reach) {
  const glm::dvec3 across{random.between(-1, 1), -random.between(0.3, 1), random.between(-1, 1)};
  const double height = random.between(0.02, 0.1) * reach;
  const glm::dvec3 over =
      camera.position + glm::normalize(camera.forward) * height + glm::dvec3(0, height, 0);
  if (seed % 5 == 3) return SpotLight{over, across, random.between(0.3, 2.0), reach};
  if (seed % 5 == 4) return PointLight{over, reach};
  return DirectionalLight{across};
}

/// Pixels whose visibility differs, of those within the light's range and cone: a face without a receiver
/// there may still hold surfaces that the light leaves dark.
std::size_t differing_where_lit(const FloatImage& a, const FloatImage& b, const FloatImage& positions,
                                const glm::dvec3& eye, const Light& light) {
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  if (spot == nullptr && point == nullptr) return differing(a, b);
  const glm::dvec3 centre = spot != nullptr ? spot->position : point->position;
  const double range = spot != nullptr ? spot->range : point->range;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.values.size() / 2; ++i) {
    const float* const at = &positions.values[i * static_cast<std::size_t>(positions.channels)];
    const glm::dvec3 ray = eye + glm::dvec3(at[0], at[1], at[2]) - centre;
    const double distance = glm::length(ray);
    const bool in_cone = spot == nullptr || glm::dot(ray, glm::normalize(spot->direction)) >=
                                                distance * std::cos(spot->outer_radians);
    if (!(distance <= range && in_cone)) continue;
    count += std::bit_cast<std::uint32_t>(a.values[2 * i]) != std::bit_cast<std::uint32_t>(b.values[2 * i])
                 ? 1
                 : 0;
  }
  return count;
}

/// A few steps of a camera, some of them none, under one technique.
void fly(Pair& pair, std::uint64_t seed, int frames, Tally& tally) {
  Random random(seed);
  const Fit fit = std::array{Fit::tight, Fit::stable, Fit::warped_stable}[seed % 3];
  constexpr std::array kFilters{"pcf",
                                "vsm:radius=2",
                                "hard",
                                "pcss",
                                "smrt",
                                "savsm",
                                "lvsm:placement=1",
                                "esm",
                                "vsm:mipmap=1,anisotropy=4",
                                "esm:mipmap=1",
                                "pcf:unit=world,radius=0.1",
                                "evsm4:unit=world,radius=0.1"};
  const FilterSettings filter =
      parse_filter(kFilters[(seed + seed / kFilters.size()) % kFilters.size()]).settings;
  ASSERT_NE(filter.filter, nullptr);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  options.fit = fit;
  options.cascades = 1 + static_cast<int>(seed % 4);
  options.prune = exact_prune_rules();
  set_margin(filter, options);
  const PreparedFilter with = pair.pruned.prepare(filter), without = pair.full.prepare(filter);
  const CameraPath path = default_path(pair.scene);
  double t = random.unit();
  Box all_boxes;
  for (const Box& box : pair.boxes) {
    all_boxes.extend(box.min);
    all_boxes.extend(box.max);
  }
  const Light light =
      random_light(seed, random, path.at(t, kWidth, kHeight), glm::length(all_boxes.max - all_boxes.min));
  PlanHistory history;
  for (int frame = 0; frame < frames; ++frame) {
    if (frame % 3 != 2) t += 1.0 / 2000.0;  // else the view stands still
    const Camera camera = path.at(t, kWidth, kHeight);
    const ShadowPlan plan = fit == Fit::warped_stable
                                ? make_plan(camera, light, pair.bounds(), options, &history)
                                : make_plan(camera, light, pair.bounds(), options);
    ShadowPlan all = plan;
    if (fit != Fit::warped_stable) {
      PlanOptions without_rules = options;
      without_rules.prune = kPruneNothing;
      all = make_plan(camera, light, pair.bounds(), without_rules);
      ASSERT_GE(all.map_count, plan.map_count);
    }
    tally.add(pair.pruned.draw(plan, camera, with, mask_only(exact_prune_rules())));
    pair.full.draw(all, camera, without, mask_only(kPruneNothing));
    const FloatImage mask = pair.full.mask();
    ASSERT_EQ(differing_where_lit(pair.pruned.mask(), mask, pair.full.positions(), camera.position, light),
              0u)
        << pair.scene.name << ", seed " << seed << ", frame " << frame << ", " << to_string(filter) << ", "
        << to_string(fit);
    tally.shadowed += shadowed(mask);
    ++tally.views;
  }
}

TEST(Prune, exact_rules_change_no_bit_of_the_mask_in_any_built_in_scene) {
  struct Flown {
    const char* name;
    int flights, frames;
  };
  Tally tally;
  // The large scenes take long to draw whole.
  for (const Flown& flown : {Flown{"hangar", 15, 6}, Flown{"fence", 15, 6}, Flown{"trees", 3, 5},
                             Flown{"terrain", 2, 3}, Flown{"city", 1, 2}}) {
    Pair pair(load_builtin(flown.name));
    for (int i = 0; i < flown.flights; ++i) {
      fly(pair, static_cast<std::uint64_t>(i), flown.frames, tally);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GE(tally.views, 200u);
  EXPECT_GT(tally.shadowed, tally.views * 100) << "scenes without shadows prove nothing";
  for (const PruneRule rule : {PruneRule::swept_casters, PruneRule::held_maps})
    EXPECT_GT(tally.of(rule).instances, 0u);
  // Whatever receives casts, too: no face has receivers and no caster.
  for (const PruneRule rule : {PruneRule::empty_cascades, PruneRule::empty_faces})
    EXPECT_GT(tally.of(rule).maps, 0u) << static_cast<int>(rule);
  EXPECT_GT(tally.held, 0u);
}

TEST(Prune, exact_rules_change_no_bit_of_the_mask_in_real_scenes) {
  // They are a folder beside this project, which not every machine has.
  const std::vector<std::filesystem::path> files = test::gltf_files(test::shared_folder() / "scenes");
  if (files.empty()) GTEST_SKIP() << "no real scenes in " << test::shared_folder();
  constexpr std::uintmax_t kLargestFile = 4u << 20;  // larger ones take too long here
  Tally tally;
  for (const std::filesystem::path& file : files) {
    if (std::filesystem::file_size(file) > kLargestFile) continue;
    Scene scene;
    try {
      scene = load_gltf(file);
    } catch (const SceneError&) {
      continue;
    }
    if (scene.triangle_count() > 100'000) continue;
    Pair pair(std::move(scene));
    fly(pair, tally.views, 3, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.views, 0u);
}

TEST(Prune, an_unchanged_view_draws_no_map_and_filters_none) {
  const Scene scene = load_builtin("hangar");
  const std::vector<Box> boxes = boxes_of(scene);
  Renderer renderer(scene);
  const Camera camera = default_path(scene).at(0.3, kWidth, kHeight);
  for (const Filter* filter : {&filters::pcf, &filters::vsm, &filters::savsm, &filters::esm}) {
    PlanOptions options;
    options.resolution.max_size = kMapSize;
    set_margin(default_settings(*filter), options);
    const PreparedFilter prepared = renderer.prepare(*filter);
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {boxes, boxes}, options);
    ASSERT_GT(plan.map_count, 0);
    renderer.draw(plan, camera, prepared, mask_only({}));
    const FloatImage first = renderer.mask();
    const FrameStats still = renderer.draw(plan, camera, prepared, mask_only({}));
    EXPECT_EQ(still.texels, 0u) << filter->info.name;
    EXPECT_EQ(still.prefilter_passes, 0) << filter->info.name;
    for (int i = 0; i < still.map_count; ++i) EXPECT_TRUE(still.map[static_cast<std::size_t>(i)].held);
    EXPECT_EQ(differing(renderer.mask(), first), 0u) << filter->info.name;
    const FrameStats redrawn =
        renderer.draw(plan, camera, prepared, mask_only(PruneRules{}.without(PruneRule::held_maps)));
    EXPECT_GT(redrawn.texels, 0u) << filter->info.name;
    EXPECT_EQ(differing(renderer.mask(), first), 0u) << filter->info.name;
  }
}

/// One view of a scene's flight with its maps.
struct View {
  Camera camera;
  ShadowPlan plan;
};
View view_of(const Scene& scene, int cascades) {
  const std::vector<Box> boxes = boxes_of(scene);
  const Camera camera = default_path(scene).at(0.3, kWidth, kHeight);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  options.cascades = cascades;
  return {camera, make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {boxes, boxes}, options)};
}

TEST(Prune, what_a_filter_stored_under_other_settings_is_not_taken_for_its_own) {
  const Scene scene = load_builtin("hangar");
  const View view = view_of(scene, 4);
  const Camera& camera = view.camera;
  const ShadowPlan& all = view.plan;
  Renderer renderer(scene), fresh(scene);
  ASSERT_GT(all.map_count, 1);
  ShadowPlan nearest = all;
  nearest.map_count = 1;
  const auto draw = [&](Renderer& with, const ShadowPlan& plan, const char* filter) {
    with.draw(plan, camera, with.prepare(parse_filter(filter).settings), mask_only({}));
    return with.mask();
  };
  const FloatImage wanted = draw(fresh, all, "savsm:floor=1e-6");
  const FloatImage other = draw(renderer, all, "savsm:slope=0.1,floor=0.01");
  EXPECT_GT(differing(other, wanted), 0u) << "the settings are to make a difference";
  // Stores the first map alone; the others hold what the settings before left there.
  draw(renderer, nearest, "savsm:floor=1e-6");
  EXPECT_EQ(differing(draw(renderer, all, "savsm:floor=1e-6"), wanted), 0u);
}

TEST(Prune, maps_that_are_added_are_filtered) {
  const Scene scene = load_builtin("hangar");
  const View view = view_of(scene, 4);
  ASSERT_GT(view.plan.map_count, 1);
  ShadowPlan nearest = view.plan;
  nearest.map_count = 1;
  Renderer renderer(scene), fresh(scene);
  for (Renderer* with : {&renderer, &fresh}) {
    const PreparedFilter filter = with->prepare(parse_filter("vsm:radius=2").settings);
    if (with == &renderer) with->draw(nearest, view.camera, filter, mask_only({}));
    with->draw(view.plan, view.camera, filter, mask_only({}));
  }
  EXPECT_EQ(differing(renderer.mask(), fresh.mask()), 0u);
}

TEST(Prune, newly_relevant_casters_are_added_to_a_cached_map) {
  const Scene scene = load_builtin("hangar");
  const View view = view_of(scene, 1);
  const Camera& camera = view.camera;
  const ShadowPlan& all = view.plan;
  Renderer renderer(scene), fresh(scene);
  ASSERT_EQ(all.map_count, 1);
  // The same map, as if only receivers on one side of the camera had been in view before.
  ShadowPlan some = all;
  const glm::dvec3 across = glm::normalize(glm::cross(all.light_direction, camera_axes(camera).up));
  some.map[0].cull_planes[0] = glm::dvec4(across, -glm::dot(across, camera.position));
  some.map[0].cull_plane_count = 1;
  const PreparedFilter filter = renderer.prepare(filters::pcf);
  const MapStats before = renderer.draw(some, camera, filter, mask_only({})).map[0];
  const MapStats added = renderer.draw(all, camera, filter, mask_only({})).map[0];
  const MapStats whole = fresh.draw(all, camera, fresh.prepare(filters::pcf), mask_only({})).map[0];
  EXPECT_GT(added.instances, 0u);
  EXPECT_LT(added.instances, whole.instances);
  EXPECT_GE(before.instances + added.instances, whole.instances);
  EXPECT_EQ(differing(renderer.mask(), fresh.mask()), 0u);
}

TEST(Prune, savings_and_what_is_drawn_add_up_to_the_frame_without_rules) {
  const Scene scene = load_builtin("fence");
  const std::vector<Box> boxes = boxes_of(scene);
  Renderer pruned(scene), full(scene);
  const PreparedFilter with = pruned.prepare(filters::pcf), without = full.prepare(filters::pcf);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  const CameraPath path = default_path(scene);
  PruneSaving sum;
  for (const double t : {0.1, 0.1, 0.4, 0.7}) {
    const Camera camera = path.at(t, kWidth, kHeight);
    const auto plan = [&](PruneRules rules) {
      PlanOptions with_rules = options;
      with_rules.prune = rules;
      return make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {boxes, boxes}, with_rules);
    };
    const FrameStats few = pruned.draw(plan({}), camera, with, mask_only({}));
    const FrameStats all = full.draw(plan(kPruneNothing), camera, without, mask_only(kPruneNothing));
    std::uint64_t texels = few.texels, triangles = 0, triangles_of_all = 0;
    for (int i = 0; i < few.map_count; ++i) triangles += few.map[static_cast<std::size_t>(i)].triangles;
    for (int i = 0; i < all.map_count; ++i)
      triangles_of_all += all.map[static_cast<std::size_t>(i)].triangles;
    for (const PruneSaving& saved : few.saved) {
      texels += saved.texels;
      triangles += saved.triangles;
      sum.texels += saved.texels;
      sum.triangles += saved.triangles;
    }
    EXPECT_EQ(texels, all.texels) << t;
    EXPECT_EQ(triangles, triangles_of_all) << t;
  }
  EXPECT_GT(sum.texels, 0u);
  EXPECT_GT(sum.triangles, 0u);
}

TEST(Prune, depths_pulled_to_what_is_there_change_no_more_than_their_rounding) {
  Pair pair(load_builtin("hangar"));
  constexpr double kHalfAStep = 0.5 / 255;  // of 8 bits, mean over the picture
  std::size_t shadowed_pixels = 0;
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const FilterSettings filter = parse_filter(seed % 2 == 0 ? "hard" : "pcf:radius=2").settings;
    PlanOptions options;
    options.resolution.max_size = kMapSize;
    set_margin(filter, options);
    const Camera camera = default_path(pair.scene).at(random.unit(), kWidth, kHeight);
    const Light light = random_light(seed, random, camera, 60.0);
    const ShadowPlan tight = make_plan(camera, light, pair.bounds(), options);
    options.prune = options.prune.without(PruneRule::light_depths);
    const ShadowPlan loose = make_plan(camera, light, pair.bounds(), options);
    pair.pruned.draw(tight, camera, pair.pruned.prepare(filter), mask_only({}));
    pair.full.draw(loose, camera, pair.full.prepare(filter), mask_only({}));
    const FloatImage mask = pair.full.mask();
    shadowed_pixels += shadowed(mask);
    const double moved = mean_difference(pair.pruned.mask(), mask);
    EXPECT_LE(moved, kHalfAStep) << seed;
    changed += moved > 0.0 ? 1 : 0;
  }
  EXPECT_GT(shadowed_pixels, 20'000u);
  EXPECT_GT(changed, 0) << "the rule is exact, and should say so";
}

TEST(Prune, stable_cascades_that_the_next_one_serves_leave_the_mask_as_it_is) {
  int spared = 0;
  std::uint64_t saved = 0;
  std::size_t shadowed_pixels = 0;
  for (const char* const scene : {"fence", "trees", "city"}) {
    Pair pair(load_builtin(scene));
    const Box& all = pair.scene.bounds_world;
    const glm::dvec3 middle = 0.5 * (all.min + all.max), size = all.max - all.min;
    for (const glm::dvec3 from : {glm::dvec3(1.0, 0.6, 0.3), glm::dvec3(-0.7, 0.5, 1.0)}) {
      // From outside: what each cascade's map spans is the scene.
      const glm::dvec3 eye = middle + from * (0.6 * glm::length(size));
      const Camera camera = perspective_camera(eye, middle - eye, {0, 1, 0}, 1.0, 16.0 / 9.0, 0.1,
                                               4.0 * glm::length(size), kWidth, kHeight);
      PlanOptions options;
      options.resolution.max_size = kMapSize;
      options.fit = Fit::stable;
      options.cascades = 4;
      const FilterSettings filter = parse_filter("hard").settings;
      set_margin(filter, options);
      const DirectionalLight sun{{0.4, -1.0, 0.3}};
      const ShadowPlan few = make_plan({camera}, sun, pair.bounds(), options);
      const PruneRules without = options.prune = options.prune.without(PruneRule::equal_cascades);
      const ShadowPlan more = make_plan({camera}, sun, pair.bounds(), options);
      const FrameStats stats =
          pair.pruned.draw(few, camera, pair.pruned.prepare(filter), mask_only(default_prune_rules()));
      pair.full.draw(more, camera, pair.full.prepare(filter), mask_only(without));
      std::uint64_t texels = stats.texels;
      for (const PruneSaving& of_rule : stats.saved) texels += of_rule.texels;
      EXPECT_EQ(texels, 4u * kMapSize * kMapSize) << scene;
      EXPECT_LE(few.map_count, more.map_count) << scene;
      spared += more.map_count - few.map_count;
      saved += stats.saved[static_cast<std::size_t>(PruneRule::equal_cascades)].maps;
      const FloatImage mask = pair.full.mask();
      shadowed_pixels += shadowed(mask);
      EXPECT_LE(differing(pair.pruned.mask(), mask), 2u) << scene;
    }
  }
  EXPECT_GT(spared, 1);
  EXPECT_GE(saved, static_cast<std::uint64_t>(spared));  // also those that hold no receiver in view
  EXPECT_GT(shadowed_pixels, 500u);
}

TEST(Prune, a_filter_that_chooses_from_depths_reads_back_only_maps_that_changed) {
  const Scene scene = load_builtin("hangar");
  const std::vector<Box> boxes = boxes_of(scene);
  Renderer renderer(scene);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  const PreparedFilter placed = renderer.prepare(parse_filter("lvsm:placement=1").settings);
  const PreparedFilter plain = renderer.prepare(filters::pcf);
  const auto draw = [&](double t, const PreparedFilter& filter) {
    const Camera camera = default_path(scene).at(t, kWidth, kHeight);
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {boxes, boxes}, options);
    return renderer.draw(plan, camera, filter, mask_only({}));
  };
  const FrameStats first = draw(0.3, placed);
  EXPECT_GT(first.map_count, 0);
  EXPECT_EQ(first.maps_read_back, first.map_count);
  const FloatImage mask = renderer.mask();
  EXPECT_EQ(draw(0.3, placed).maps_read_back, 0);
  EXPECT_EQ(differing(renderer.mask(), mask), 0u);
  EXPECT_GT(draw(0.6, placed).maps_read_back, 0);
  // Another filter draws the maps anew; what was chosen before is of other depths.
  EXPECT_EQ(draw(0.3, plain).maps_read_back, 0);
  EXPECT_GT(draw(0.3, placed).maps_read_back, 0);
  EXPECT_EQ(differing(renderer.mask(), mask), 0u);
}

TEST(Prune, a_filter_that_stores_less_within_a_bound_draws_the_same_picture) {
  const Scene scene = load_builtin("hangar");
  const std::vector<Box> boxes = boxes_of(scene);
  Renderer renderer(scene);
  const FilterSettings full = parse_filter("esm:c=80").settings;
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  options.prune = PruneRules::all();
  set_margin(full, options);
  const Camera camera = default_path(scene).at(0.6, kWidth, kHeight);
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {boxes, boxes}, options);
  renderer.draw(plan, camera, renderer.prepare(full), mask_only({}));
  const FloatImage wanted = renderer.mask();
  ASSERT_GT(shadowed(wanted), 100u);
  const FilterFit fit = fit_filter(full, renderer.drawn_depths(full, plan));
  ASSERT_TRUE(fit.saves());
  renderer.draw(plan, camera, renderer.prepare(fit.settings), mask_only({}));
  EXPECT_LE(mean_difference(renderer.mask(), wanted), 0.5 / 255);
}

/// Pebbles on a plate: what a small caster's rule is for.
Scene pebbles() {
  Scene scene = load_builtin("fence");
  const Instance some = scene.instances.front();
  const Box box = some.bounds_world;
  const glm::dvec3 middle = 0.5 * (box.min + box.max);
  for (int i = 0; i < 400; ++i) {
    Instance pebble = some;
    const double size = 0.004 / std::max(1e-9, glm::length(box.max - box.min));
    const glm::dvec3 at{-10.0 + (i % 20), 0.2, -10.0 + (i / 20)};
    glm::dmat4 shrink(size);
    shrink[3] = glm::dvec4(at - size * middle, 1.0);
    pebble.world_from_object = shrink * some.world_from_object;
    pebble.bounds_world = {at - 0.5 * size * (box.max - box.min), at + 0.5 * size * (box.max - box.min)};
    scene.instances.push_back(pebble);
  }
  return scene;
}

TEST(Prune, small_casters_take_no_more_of_the_shadow_than_their_share) {
  const Scene scene = pebbles();
  const std::vector<Box> boxes = boxes_of(scene);
  Renderer pruned(scene), full(scene);
  const PreparedFilter with = pruned.prepare(filters::hard), without = full.prepare(filters::hard);
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  options.cascades = 1;
  std::uint64_t dropped = 0;
  const PruneRules rule = exact_prune_rules().with(PruneRule::small_casters);
  const CameraPath path = default_path(scene);
  for (const double t : {0.0, 0.25, 0.5, 0.75}) {
    const Camera camera = path.at(t, kWidth, kHeight);
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.4, -1, 0.3}}, {boxes, boxes}, options);
    ASSERT_EQ(plan.map_count, 1);
    const FrameStats stats = pruned.draw(plan, camera, with, mask_only(rule));
    full.draw(plan, camera, without, mask_only(kPruneNothing));
    const std::uint64_t small = stats.saved[static_cast<std::size_t>(PruneRule::small_casters)].instances;
    dropped += small;
    // Each may cover the middle of one texel.
    EXPECT_LE(static_cast<double>(small), kLostShare * kMapSize * kMapSize) << t;
    // In the map itself: the share that the bound speaks of.
    const FloatImage a = pruned.depth_map(0), b = full.depth_map(0);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) changed += a.values[i] != b.values[i] ? 1 : 0;
    EXPECT_LE(static_cast<double>(changed), kLostShare * static_cast<double>(a.values.size())) << t;
  }
  EXPECT_GT(dropped, 0u);
}

}  // namespace
}  // namespace gnomon::render
