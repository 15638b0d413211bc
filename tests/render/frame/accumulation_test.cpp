// Temporal accumulation: does the mask come closer to the exact shadow, and forget what it must?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "frame/blue_noise.hpp"
#include "gnomon/motion.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

FrameOptions accumulating() {
  FrameOptions options;
  options.accumulation.on = true;
  return options;
}

PlanOptions planned(const FilterSettings& filter, int size) {
  PlanOptions options;
  options.resolution.max_size = size;
  options.cascades = 1;
  options.warp.warp = &warps::none;
  set_margin(filter, options);
  options.filter.texels += kJitterReachTexels;
  // Results near texels' centres count most, and they need next to no bias.
  options.bias.slope_texels *= 0.05;
  options.bias.normal_offset_texels *= 0.05;
  return options;
}

/// Draws frames of a scene from one plan, whose grid moves.
class Stills {
 public:
  explicit Stills(FilterSettings filter = default_settings(filters::hard), int map_size = 64)
      : scene_(box_on_ground()), renderer_(scene_), filter_(std::move(filter)), map_size_(map_size) {}
  Frame frame(std::uint32_t index, const FrameOptions& options, const Camera& camera = still()) {
    const ShadowPlan plan = plan_for(scene_, camera, light_, planned(filter_, map_size_));
    return draw(renderer_, camera, jittered(plan, jitter_texels(index)), filter_, options);
  }
  /// After so many frames of a view at rest.
  Frame after(int frames, FrameOptions options = accumulating()) {
    Frame last;
    for (int i = 0; i < frames; ++i) {
      options.frame_index = static_cast<std::uint32_t>(i);
      options.accumulation.restart = i == 0;
      last = frame(options.frame_index, options);
    }
    return last;
  }
  void draw_exactly() {
    const Camera camera = still();
    renderer_.draw(plan_for(scene_, camera, light_, planned(filter_, map_size_)), camera,
                   renderer_.prepare(filters::hard, Source::irregular()), accumulating());
  }
  void turn_light(const glm::dvec3& light) { light_ = light; }
  [[nodiscard]] static Camera still() { return camera_on_box(kSize, kSize); }
  /// Pixels of the ground whose mask is on the wrong side of one half.
  [[nodiscard]] int wrong(const Frame& frame) const {
    int count = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (!frame.surface(i) || std::abs(frame.point(i).y) > 1e-3) continue;
      const bool shadow = hits_box(frame.point(i), -light_, glm::dvec3(kBoxMin), glm::dvec3(kBoxMax));
      count += shadow == (frame.lit(i) > 0.5f) ? 1 : 0;
    }
    return count;
  }

 private:
  Scene scene_;
  Renderer renderer_;
  FilterSettings filter_;
  int map_size_;
  glm::dvec3 light_ = kSlant;
};

bool same_mask(const Frame& a, const Frame& b) {
  return a.mask.values == b.mask.values;
}

TEST(Accumulation, first_frame_is_that_frame_alone) {
  Stills stills;
  const Frame alone = stills.frame(0, {}), first = stills.frame(0, accumulating());
  EXPECT_TRUE(same_mask(alone, first));
  EXPECT_GT(stills.wrong(alone), 50) << "a coarse map has stairs";
}

TEST(Accumulation, sixty_four_frames_leave_a_tenth_of_the_misclassified_pixels) {
  Stills stills;
  const int alone = stills.wrong(stills.after(1)), eight = stills.wrong(stills.after(8));
  const int all = stills.wrong(stills.after(64));
  EXPECT_LT(eight, 0.5 * alone);
  EXPECT_LE(all, 0.1 * alone);
}

TEST(Accumulation, does_not_change_from_frame_to_frame_once_it_has_converged) {
  Stills stills;
  const Frame before = stills.after(64);
  FrameOptions options = accumulating();
  const Frame after = stills.frame(64, options);
  int flips = 0, flips_alone = 0;
  const Frame one = stills.frame(63, {}), other = stills.frame(64, {});
  for (std::size_t i = 0; i < before.pixels(); ++i) {
    flips += (before.lit(i) > 0.5f) != (after.lit(i) > 0.5f) ? 1 : 0;
    flips_alone += (one.lit(i) > 0.5f) != (other.lit(i) > 0.5f) ? 1 : 0;
  }
  EXPECT_GT(flips_alone, 50);
  EXPECT_LT(flips, flips_alone / 20);
}

TEST(Accumulation, restart_forgets_and_so_does_a_frame_without) {
  Stills stills;
  stills.after(16);
  stills.turn_light(glm::normalize(glm::dvec3(-0.5, -1.0, 0.3)));
  FrameOptions options = accumulating();
  options.accumulation.restart = true;
  const Frame restarted = stills.frame(3, options);
  const Frame alone = stills.frame(3, {});
  EXPECT_TRUE(same_mask(restarted, alone));
  EXPECT_TRUE(same_mask(stills.frame(3, accumulating()), alone)) << "after a frame without accumulation";
}

/// The last frame of a view that moves by more than a pixel a frame, accumulated and alone.
struct Moved {
  Frame accumulated, alone;
};
Moved after_motion(Stills& stills, double depth_tolerance = Accumulation{}.depth_tolerance) {
  Camera camera = Stills::still();
  // Looked up where they were on the image, points would be others.
  const glm::dvec3 aside = glm::normalize(glm::cross(camera.forward, camera.up));
  const glm::dvec3 step = 0.05 * aside + 0.02 * camera.up;
  FrameOptions options = accumulating();
  options.accumulation.depth_tolerance = depth_tolerance;
  Frame last;
  constexpr int kFrames = 24;
  for (int i = 0; i < kFrames; ++i) {
    last = stills.frame(static_cast<std::uint32_t>(i), options, camera);
    camera.position += step;
  }
  camera.position -= step;
  return {last, stills.frame(kFrames - 1, {}, camera)};
}

TEST(Accumulation, a_moving_view_finds_its_points_again) {
  Stills stills;
  const Moved moved = after_motion(stills);
  const int alone = stills.wrong(moved.alone);
  EXPECT_GT(alone, 50);
  EXPECT_LT(stills.wrong(moved.accumulated), 0.5 * alone);
}

TEST(Accumulation, neighbours_in_a_slanted_plane_are_the_same_surface) {
  // From pixel to pixel the ground's depth changes by more than the tolerance.
  constexpr double kNarrow = 2e-4;
  Stills stills;
  const Moved moved = after_motion(stills, kNarrow);
  EXPECT_LT(stills.wrong(moved.accumulated), 0.5 * stills.wrong(moved.alone));
}

TEST(Accumulation, a_moving_view_keeps_no_history_of_details_as_small_as_pixels) {
  // No texel is as long as a pixel: reads between pixels would wear off what they resolve.
  constexpr int kFine = 1024;
  Stills sharp(default_settings(filters::hard), kFine);
  const Moved moved = after_motion(sharp);
  EXPECT_TRUE(same_mask(moved.accumulated, moved.alone));
  Stills soft(parse_filter("pcf:radius=24").settings, kFine);
  const Moved blurred = after_motion(soft);
  EXPECT_FALSE(same_mask(blurred.accumulated, blurred.alone))
      << "a kernel of many pixels has no such details";
}

TEST(Accumulation, rejects_the_history_of_another_surface) {
  // Ground that the box hid from the camera has no history, though there were pixels where it would have
  // been.
  Stills stills;
  const Camera before = Stills::still();
  Camera camera = before;
  camera.position += 3.0 * glm::normalize(glm::cross(camera.forward, camera.up));
  const Frame alone = stills.frame(40, {}, camera);
  const auto changed = [&](double tolerance) {
    stills.after(32);
    FrameOptions options = accumulating();
    options.accumulation.depth_tolerance = tolerance;
    const Frame frame = stills.frame(40, options, camera);
    int revealed = 0, different = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      const glm::dvec3 point = frame.point(i);
      if (!frame.surface(i) || std::abs(point.y) > 1e-3) continue;
      constexpr double kPixel = 0.1;  // world units: at the outline the history of the ground is right
      if (!hits_box(point, before.position - point, glm::dvec3(kBoxMin) + kPixel,
                    glm::dvec3(kBoxMax) - kPixel))
        continue;
      ++revealed;
      different += frame.lit(i) != alone.lit(i) ? 1 : 0;
    }
    EXPECT_GT(revealed, 100);
    return different;
  };
  EXPECT_EQ(changed(0.01), 0);
  EXPECT_GT(changed(1.0), 10);
}

/// What the first frame after a caster's move differs in from that frame alone.
struct AfterMove {
  int behind = 0,
      ghosts = 0;  // pixels of the ground whose kernel sees the caster's shadow, and those that differ
  int elsewhere = 0, kept = 0;  // all others
};
AfterMove after_move(const char* text, double radius_world) {
  const FilterSettings filter = parse_filter(text).settings;
  const Scene before = boxes_on_ground();
  constexpr std::size_t kMover = 1;  // the box that the camera looks at
  Scene after = before;
  const glm::dvec3 step(0.8, 0.0, 0.5);
  Instance& moved = after.instances[kMover];
  moved.world_from_object[3] += glm::dvec4(step, 0.0);
  moved.bounds_world.min += step;
  moved.bounds_world.max += step;
  Renderer renderer(before);
  const Camera camera = Stills::still();
  const auto frame = [&](const Scene& scene, std::uint32_t index, const FrameOptions& options) {
    const ShadowPlan plan = plan_for(scene, camera, kSlant, planned(filter, 64));
    return draw(renderer, camera, jittered(plan, jitter_texels(index)), filter, options);
  };
  constexpr std::uint32_t kFrames = 32;
  for (std::uint32_t i = 0; i < kFrames; ++i) frame(before, i, accumulating());
  EXPECT_TRUE(renderer.move_instance(kMover, moved));
  const Frame first = frame(after, kFrames, accumulating());
  const Frame alone = frame(after, kFrames, {});
  AfterMove count;
  for (std::size_t i = 0; i < first.pixels(); ++i) {
    if (!first.surface(i) || std::abs(first.point(i).y) > 1e-3) continue;
    const auto in_shadow_of = [&](const Scene& scene) {
      const Box& box = scene.instances[kMover].bounds_world;
      return hits_box(first.point(i), -kSlant, box.min - radius_world, box.max + radius_world);
    };
    const bool affected = in_shadow_of(before) || in_shadow_of(after);
    (affected ? count.behind : count.elsewhere) += 1;
    (affected ? count.ghosts : count.kept) += first.lit(i) != alone.lit(i) ? 1 : 0;
  }
  return count;
}

TEST(Accumulation, forgets_what_lies_behind_a_caster_that_moves_and_nothing_else) {
  const AfterMove hard = after_move("hard", 0.0);
  EXPECT_GT(hard.behind, 200);
  EXPECT_EQ(hard.ghosts, 0);
  EXPECT_GT(hard.elsewhere, 2000);
  EXPECT_GT(hard.kept, 300) << "edges of other shadows stay converged";
  const AfterMove wide = after_move("pcf:unit=world,radius=1.5", 1.5);
  EXPECT_GT(wide.behind, hard.behind + 200);
  EXPECT_EQ(wide.ghosts, 0);
  EXPECT_GT(wide.kept, 300);
}

/// Pixels of the ground in the box's shadow that differ.
int differing_behind_the_box(const Frame& a, const Frame& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    if (!a.surface(i) || std::abs(a.point(i).y) > 1e-3) continue;
    const bool behind = hits_box(a.point(i), -kSlant, glm::dvec3(kBoxMin), glm::dvec3(kBoxMax));
    count += behind && a.lit(i) != b.lit(i) ? 1 : 0;
  }
  return count;
}

TEST(Accumulation, forgets_what_lies_behind_each_of_many_casters_that_moved_and_not_for_good) {
  Stills stills;
  constexpr std::uint32_t kFrames = 32;
  const Frame rested = stills.after(kFrames);
  // More boxes than have places of their own: the last ones share one. All but the last are below the ground.
  std::vector<Box> moved(40, Box{{0.0, -50.0, 0.0}, {0.1, -49.0, 0.1}});
  moved.back() = {glm::dvec3(kBoxMin), glm::dvec3(kBoxMax)};
  FrameOptions options = accumulating();
  options.moved_world = moved;
  const Frame first = stills.frame(kFrames, options), alone = stills.frame(kFrames, {});
  EXPECT_GT(differing_behind_the_box(rested, alone), 10);
  EXPECT_EQ(differing_behind_the_box(first, alone), 0);
  stills.after(4);
  stills.frame(4, options);
  Frame last;
  for (std::uint32_t i = 5; i <= kFrames; ++i) last = stills.frame(i, accumulating());
  EXPECT_GT(differing_behind_the_box(last, alone), 10) << "what rests accumulates again";
}

TEST(Accumulation, keeps_what_a_local_light_lights_where_casters_move_beyond_it) {
  const Scene scene = box_on_ground();
  const std::vector<Box> boxes = boxes_of(scene);
  const Camera camera = Stills::still();
  const FilterSettings filter = default_settings(filters::hard);
  const Light local = PointLight{{-3.0, 6.0, 3.0}, 60.0};
  const ShadowPlan plan = make_plan(camera, local, {boxes, boxes}, planned(filter, 64));
  Renderer told(scene), untold(scene);
  const std::vector<Box> beyond{{{-50.0, 8.0, -50.0}, {50.0, 9.0, 50.0}}};
  Frame a, b, alone;
  constexpr std::uint32_t kFrames = 9;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    FrameOptions options = accumulating();
    options.light = &local;
    const ShadowPlan shaken = jittered(plan, jitter_texels(i));
    b = draw(untold, camera, shaken, filter, options);
    if (i + 1 == kFrames) options.moved_world = beyond;
    a = draw(told, camera, shaken, filter, options);
    options.accumulation.on = false;
    if (i + 1 == kFrames) alone = draw(untold, camera, shaken, filter, options);
  }
  EXPECT_TRUE(same_mask(a, b));
  EXPECT_FALSE(same_mask(a, alone));
}

TEST(Accumulation, a_view_at_rest_remembers_no_more_frames_than_it_may) {
  const auto change = [](double memory) {
    Stills stills;
    FrameOptions options = accumulating();
    options.accumulation.memory = memory;
    const Frame before = stills.after(32, options), after = stills.frame(32, options);
    double sum = 0.0;
    for (std::size_t i = 0; i < before.pixels(); ++i) sum += std::abs(after.lit(i) - before.lit(i));
    return sum;
  };
  EXPECT_GT(change(1.0), 4.0 * change(64.0));
}

TEST(Accumulation, an_exact_frame_forgets) {
  Stills stills;
  stills.after(16);
  stills.turn_light(glm::normalize(glm::dvec3(-0.5, -1.0, 0.3)));
  stills.draw_exactly();
  const Frame after = stills.frame(3, accumulating());
  EXPECT_TRUE(same_mask(after, stills.frame(3, {})));
}

TEST(Accumulation, noise_that_moves_averages_to_the_whole_kernel) {
  // Four turning samples of a disc, 32 frames of them, against 64 samples.
  const Scene scene = box_on_ground();
  Renderer renderer(scene);
  const Camera camera = camera_on_box(kSize, kSize);
  const FilterSettings few = parse_filter("pcf:pattern=1,samples=4,radius=4").settings,
                       many = parse_filter("pcf:pattern=1,samples=64,radius=4").settings;
  PlanOptions planned;
  planned.resolution.max_size = 256;
  set_margin(few, planned);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, planned);
  const Frame whole = draw(renderer, camera, plan, many, {});
  const auto error_of = [&](const Frame& frame) {
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) sum += std::abs(frame.lit(i) - whole.lit(i));
    return sum;
  };
  const double still = error_of(draw(renderer, camera, plan, few, {}));
  for (const SampleNoise noise : {SampleNoise::gradient, SampleNoise::blue}) {
    FrameOptions options = accumulating();
    options.noise = noise;
    options.accumulation.confidence_power = 0.0;
    Frame last;
    for (options.frame_index = 0; options.frame_index < 32; ++options.frame_index)
      last = draw(renderer, camera, plan, few, options);
    EXPECT_LT(error_of(last), 0.35 * still) << static_cast<int>(noise);
    EXPECT_GT(still, 10.0);
  }
}

TEST(BlueNoise, has_every_value_once_and_little_of_low_frequencies) {
  const std::vector<float> noise = blue_noise();
  ASSERT_EQ(noise.size(), static_cast<std::size_t>(kBlueNoiseSide * kBlueNoiseSide));
  EXPECT_EQ(std::set<float>(noise.begin(), noise.end()).size(), noise.size());
  EXPECT_EQ(noise, blue_noise());
  // Power of the waves of 1 to 6 periods over the tile; white noise has the values' variance in every wave.
  constexpr double kTau = 6.283185307179586;
  double low = 0.0, high = 0.0;
  int lows = 0, highs = 0;
  for (const int v : {0, 1, 2, 4, 6, 20, 28, 32}) {
    for (const int u : {1, 2, 3, 5, 6, 19, 27, 31}) {
      double re = 0.0, im = 0.0;
      for (int y = 0; y < kBlueNoiseSide; ++y) {
        for (int x = 0; x < kBlueNoiseSide; ++x) {
          const double value = noise[static_cast<std::size_t>(y * kBlueNoiseSide + x)] - 0.5;
          const double angle = kTau * (u * x + v * y) / kBlueNoiseSide;
          re += value * std::cos(angle);
          im += value * std::sin(angle);
        }
      }
      const double power = (re * re + im * im) / (kBlueNoiseSide * kBlueNoiseSide) * 12.0;
      const bool is_low = u <= 6 && v <= 6;
      if (is_low) {
        low += power;
        ++lows;
      } else if (u >= 19 && v >= 20) {
        high += power;
        ++highs;
      }
    }
  }
  EXPECT_LT(low / lows, 0.05) << "1: white noise";
  EXPECT_GT(high / highs, 0.8);
}

}  // namespace
}  // namespace gnomon::render
