// Does a stable map that was moved by whole texels, and drawn in its new strips alone, show what it would
// show drawn whole?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "gnomon/motion.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "prune_pair.hpp"

namespace gnomon::render {
namespace {

constexpr int kWidth = 160, kHeight = 90, kMapSize = 512;
const DirectionalLight kSun{{0.5, -0.8, 0.4}};
// What the rule promises: so many pixels may be off by more than half a step of 8 bits.
constexpr double kOffPixels = 2e-4, kStep = 0.5 / 255.0;
// Texels whose depth is another by more than a slope's share of the rasterizer's subpixel: an edge moved over
// their middle.
constexpr double kOffTexels = 2e-4, kDepth = 1e-5;

const PruneRules kScrolling = exact_prune_rules().with(PruneRule::scrolled_maps);
const PruneRules kDrawnAgain = exact_prune_rules().without(PruneRule::held_maps);

PlanOptions stable_options(const FilterSettings& filter) {
  PlanOptions options;
  options.resolution.max_size = kMapSize;
  options.fit = Fit::stable;
  options.prune = exact_prune_rules();
  set_margin(filter, options);
  return options;
}

/// Of every `channels`-th value: how many differ by more than `step`.
std::size_t off_by(const FloatImage& a, const FloatImage& b, double step) {
  std::size_t count = 0;
  const auto channels = static_cast<std::size_t>(a.channels);
  for (std::size_t i = 0; i < a.values.size(); i += channels)
    count += std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i])) > step ? 1 : 0;
  return count;
}

std::uint64_t scrolled_texels(const FrameStats& stats) {
  return stats.saved[static_cast<std::size_t>(PruneRule::scrolled_maps)].texels;
}

struct Off {
  std::size_t pixels = 0, of_pixels = 0, texels = 0, of_texels = 0;
};

/// Frames along the scene's path, each drawn from the last one's maps and whole.
void fly(Pair& pair, const char* filter_text, int frames, bool all_casters, Off& off) {
  const FilterSettings filter = parse_filter(filter_text).settings;
  ASSERT_NE(filter.filter, nullptr) << filter_text;
  const PlanOptions options = stable_options(filter);
  const PreparedFilter with = pair.pruned.prepare(filter), without = pair.full.prepare(filter);
  const CameraPath path = default_path(pair.scene);
  std::uint64_t texels = 0, all = 0, scrolled = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = path.at(0.3 + frame / 600.0, kWidth, kHeight);
    const ShadowPlan plan = make_plan(camera, kSun, pair.bounds(), options);
    const FrameStats stats = pair.pruned.draw(plan, camera, with, mask_only(kScrolling));
    all += pair.full.draw(plan, camera, without, mask_only(kDrawnAgain)).texels;
    texels += stats.texels;
    scrolled += scrolled_texels(stats);
    const FloatImage mask = pair.full.mask();
    off.pixels += off_by(pair.pruned.mask(), mask, kStep);
    off.of_pixels += mask.values.size() / 2;
    for (int map = 0; all_casters && map < plan.map_count; ++map) {
      const FloatImage depth = pair.full.depth_map(map);
      off.texels += off_by(pair.pruned.depth_map(map), depth, kDepth);
      off.of_texels += depth.values.size();
    }
  }
  EXPECT_GT(scrolled, 0u) << pair.scene.name << ", " << filter_text;
  // The first frame is drawn whole, and so is a map whose depths change.
  EXPECT_LT(static_cast<double>(texels), 0.6 * static_cast<double>(all)) << pair.scene.name;
}

TEST(Scroll, masks_are_those_of_maps_drawn_whole_to_the_stated_share_of_pixels) {
  struct Flown {
    const char* scene;
    std::vector<const char*> filters;
    int frames;
  };
  const Flown flights[] = {{"hangar", {"hard", "vsm:radius=2", "pcss"}, 8},
                           {"fence", {"pcf", "esm", "msm", "power_cdf"}, 8},
                           {"trees", {"vsm:radius=2"}, 4},
                           {"terrain", {"pcf"}, 4},
                           {"city", {"hard"}, 3}};
  Off off;
  for (const Flown& flown : flights) {
    Pair pair(load_builtin(flown.scene));
    for (const char* filter : flown.filters) {
      fly(pair, filter, flown.frames, false, off);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(off.of_pixels, 800'000u);
  EXPECT_LE(static_cast<double>(off.pixels), kOffPixels * static_cast<double>(off.of_pixels)) << off.pixels;
}

TEST(Scroll, maps_whose_every_texel_is_read_hold_what_maps_drawn_whole_hold) {
  Off off;
  for (const char* scene : {"hangar", "fence"}) {
    Pair pair(load_builtin(scene));
    fly(pair, "lvsm:placement=1", 8, true, off);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(off.of_texels, 10'000'000u);
  EXPECT_LE(static_cast<double>(off.texels), kOffTexels * static_cast<double>(off.of_texels)) << off.texels;
}

/// A camera in a scene, and the plans of where it goes.
struct Flight {
  Pair pair;
  FilterSettings filter = default_settings(filters::pcf);
  PreparedFilter with = pair.pruned.prepare(filter), without = pair.full.prepare(filter);
  PlanOptions options = stable_options(filter);
  Camera camera = default_path(pair.scene).at(0.3, kWidth, kHeight);
  /// Half way between the places where maps are drawn from another origin.
  explicit Flight(const char* scene = "hangar") : pair(load_builtin(scene)) {
    constexpr double kPlaces = 8.0;
    camera.position = glm::round(camera.position / kPlaces) * kPlaces + glm::dvec3(0.0, 2.0, 0.0);
  }
  [[nodiscard]] ShadowPlan plan(const glm::dvec3& light = kSun.direction) const {
    return make_plan(camera, DirectionalLight{light}, pair.bounds(), options);
  }
  /// So many texels of the nearest map along the light frame's x.
  void step(double texels) {
    const ShadowMap map = plan().map[0];
    const glm::dmat4& m = map.clip_from_world;
    const glm::dvec3 across = glm::dvec3(m[0][0], m[1][0], m[2][0]);
    camera.position += across * (texels * 2.0 / (map.width * glm::dot(across, across)));
  }
  FrameStats draw(const ShadowPlan& plan, PruneRules rules = kScrolling) {
    return pair.pruned.draw(plan, camera, with, mask_only(rules));
  }
};

TEST(Scroll, texels_drawn_are_those_of_the_strips_where_no_caster_is_new) {
  Flight flight;
  // All casters, so that none comes into reach.
  const PruneRules rules = kScrolling.without(PruneRule::swept_casters);
  const ShadowPlan before = flight.plan();
  ASSERT_GT(before.map_count, 1);
  EXPECT_EQ(scrolled_texels(flight.draw(before, rules)), 0u) << "nothing to scroll from";
  flight.step(-7.0);
  const ShadowPlan after = flight.plan();
  ASSERT_EQ(after.map_count, before.map_count);
  const FrameStats stats = flight.draw(after, rules);
  int scrolled = 0;
  for (std::size_t i = 0; i < after.maps().size(); ++i) {
    const MapReuse moved = reuse(before.map[i], after.map[i]);
    std::uint64_t strips = 0;
    for (int s = 0; s < moved.strip_count; ++s) {
      const TexelRect& strip = moved.strip[static_cast<std::size_t>(s)];
      strips += static_cast<std::uint64_t>(strip.width) * static_cast<std::uint64_t>(strip.height);
    }
    EXPECT_EQ(stats.map[i].texels, strips) << i;
    scrolled += moved.kind == ReuseKind::scrolled ? 1 : 0;
  }
  EXPECT_GT(scrolled, 0);
  // No farther than the camera: the scene's bounds hold the grid back.
  EXPECT_GT(stats.map[0].texels, 0u);
  EXPECT_LE(stats.map[0].texels, 7u * kMapSize);
  flight.pair.full.draw(after, flight.camera, flight.without, mask_only(kDrawnAgain));
  EXPECT_EQ(off_by(flight.pair.pruned.mask(), flight.pair.full.mask(), kStep), 0u);
}

TEST(Scroll, casters_that_only_a_later_view_needs_are_drawn_where_they_are_missing) {
  for (const double side : {-1.0, 1.0}) {
    Flight flight("terrain");  // tiles of ground, in strips by halves
    const PruneRules all_casters = kScrolling.without(PruneRule::swept_casters);
    flight.draw(flight.plan(), all_casters);
    // As if only receivers on one side of the camera were in view while a strip comes in.
    flight.step(60.0 * side);
    ShadowPlan some = flight.plan();
    const glm::dmat4& m = some.map[0].clip_from_world;
    const glm::dvec3 across = glm::normalize(glm::dvec3(m[0][0], m[1][0], m[2][0]));
    for (std::size_t i = 0; i < some.maps().size(); ++i) {
      some.map[i].cull_planes[0] =
          glm::dvec4(-side * across, side * glm::dot(across, flight.camera.position));
      some.map[i].cull_plane_count = 1;
    }
    EXPECT_GT(scrolled_texels(flight.draw(some)), 0u);
    flight.step(side);
    const ShadowPlan all = flight.plan();
    // Every caster is to be there now, and all of it.
    EXPECT_GT(scrolled_texels(flight.draw(all, all_casters)), 0u);
    flight.pair.full.draw(all, flight.camera, flight.without, mask_only(kPruneNothing));
    for (int map = 0; map < all.map_count; ++map) {
      const FloatImage depth = flight.pair.full.depth_map(map);
      EXPECT_LE(static_cast<double>(off_by(flight.pair.pruned.depth_map(map), depth, kDepth)),
                kOffTexels * static_cast<double>(depth.values.size()))
          << "map " << map << ", side " << side;
    }
  }
}

TEST(Scroll, another_light_size_origin_or_the_rule_switched_off_draws_maps_whole) {
  Flight flight;
  const auto whole = [](const FrameStats& stats) {
    return stats.texels == static_cast<std::uint64_t>(stats.map_count) * kMapSize * kMapSize;
  };
  ASSERT_TRUE(whole(flight.draw(flight.plan()))) << "the first frame";
  flight.step(-7.0);
  EXPECT_FALSE(whole(flight.draw(flight.plan())));
  flight.step(-7.0);
  EXPECT_TRUE(whole(flight.draw(flight.plan(),
                                kScrolling.without(PruneRule::scrolled_maps).without(PruneRule::held_maps))));
  flight.step(-7.0);
  EXPECT_FALSE(whole(flight.draw(flight.plan()))) << "from maps that were drawn without the rule, too";
  EXPECT_TRUE(whole(flight.draw(flight.plan({0.5, -0.8, 0.4001}))));
  EXPECT_TRUE(whole(flight.draw(flight.plan()))) << "back again";
  flight.options.resolution.max_size = kMapSize / 2;
  const FrameStats smaller = flight.draw(flight.plan());
  EXPECT_EQ(smaller.texels, static_cast<std::uint64_t>(smaller.map_count) * kMapSize * kMapSize / 4);
  flight.options.resolution.max_size = kMapSize;
  EXPECT_TRUE(whole(flight.draw(flight.plan())));
  // A matrix of float knows positions from one origin; where that moves on all is drawn anew.
  flight.camera.position.x +=
      0.5 * (flight.pair.scene.bounds_world.max.x - flight.pair.scene.bounds_world.min.x);
  const ShadowPlan far = flight.plan();
  EXPECT_TRUE(whole(flight.draw(far)));
}

TEST(Scroll, maps_of_every_clip_space_move_the_same_way) {
  for (const ClipSpace& space :
       {kVulkan, kDirect3D,
        ClipSpace{NdcDepth::zero_to_one, true, false, Handedness::left, FirstRow::y_plus_one},
        ClipSpace{NdcDepth::minus_one_to_one, true, true}}) {
    Flight flight;
    flight.options.clip_space = space;
    flight.draw(flight.plan());
    // The same way in the world: the other way, the hangar's casters are not worth the strips.
    flight.step(space.handedness == Handedness::left ? 10.0 : -10.0);
    flight.camera.position.y += 0.02;
    const ShadowPlan plan = flight.plan();
    EXPECT_GT(scrolled_texels(flight.draw(plan)), 0u);
    flight.pair.full.draw(plan, flight.camera, flight.without, mask_only(kDrawnAgain));
    EXPECT_LE(off_by(flight.pair.pruned.mask(), flight.pair.full.mask(), kStep), 3u);
  }
}

TEST(Scroll, savings_and_what_is_drawn_add_up_to_the_frame_drawn_whole) {
  Pair pair(load_builtin("fence"));
  const FilterSettings filter = default_settings(filters::pcf);
  const PlanOptions options = stable_options(filter);
  const PreparedFilter with = pair.pruned.prepare(filter), without = pair.full.prepare(filter);
  const CameraPath path = default_path(pair.scene);
  for (int frame = 0; frame < 6; ++frame) {
    const Camera camera = path.at(0.3 + frame / 600.0, kWidth, kHeight);
    const ShadowPlan plan = make_plan(camera, kSun, pair.bounds(), options);
    const FrameStats few = pair.pruned.draw(plan, camera, with, mask_only(kScrolling));
    const FrameStats all = pair.full.draw(plan, camera, without, mask_only(kPruneNothing));
    std::uint64_t texels = few.texels, triangles = 0, triangles_of_all = 0;
    for (std::size_t i = 0; i < plan.maps().size(); ++i) {
      triangles += few.map[i].triangles;
      triangles_of_all += all.map[i].triangles;
    }
    for (const PruneRule rule : {PruneRule::swept_casters, PruneRule::caster_clusters, PruneRule::held_maps,
                                 PruneRule::scrolled_maps}) {
      const PruneSaving& saved = few.saved[static_cast<std::size_t>(rule)];
      texels += saved.texels;
      triangles += saved.triangles;
    }
    EXPECT_EQ(texels, all.texels) << frame;
    EXPECT_EQ(triangles, triangles_of_all) << frame;
  }
}

}  // namespace
}  // namespace gnomon::render
