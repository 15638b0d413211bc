// Does a stable map tell truly which of its texels hold from one frame to the next?
#include "gnomon/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/bounds.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// A texel's place to this: far below what a sample could show.
constexpr double kTexel = 1e-6;

/// Texel coordinates and depth of a point as the map's memory counts them.
glm::dvec3 place(const ShadowMap& map, const ClipSpace& space, const glm::dvec3& p) {
  const glm::dvec4 t = texture_from_clip(space) * map.clip_from_world * glm::dvec4(p, 1.0);
  return {t.x / t.w * map.width, t.y / t.w * map.height, t.z / t.w};
}

ClipSpace draw_clip_space() {
  return {static_cast<NdcDepth>(pick(2)), chance(0.5), chance(0.5), static_cast<Handedness>(pick(2)),
          static_cast<FirstRow>(pick(2))};
}

Case stable_case() {
  Case c;
  c.camera = perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 100.0, 600, 400);
  c.light = {0.3, -1.0, 0.2};
  c.receivers = c.casters = {{{-500, -10, -500}, {500, 20, 500}}};
  c.options.fit = Fit::stable;
  c.options.cascades = 3;
  c.options.resolution.max_size = 128;
  return c;
}

/// How often each texel of a map of this size is kept or drawn again.
std::vector<int> cover(const MapReuse& r, int width, int height) {
  std::vector<int> times(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  const auto add = [&](const TexelRect& rect) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      for (int x = rect.x; x < rect.x + rect.width; ++x) {
        require(x >= 0 && y >= 0 && x < width && y < height, "outside of the map", x, y);
        ++times[static_cast<std::size_t>(y * width + x)];
      }
    }
  };
  add(r.kept);
  for (int i = 0; i < r.strip_count; ++i) add(r.strip[static_cast<std::size_t>(i)]);
  return times;
}

TEST(Reuse, the_same_map_twice_is_identical_and_leaves_nothing_to_draw) {
  const ShadowPlan plan = stable_case().plan();
  ASSERT_EQ(plan.map_count, 3);
  for (const ShadowMap& map : plan.maps()) {
    const MapReuse r = reuse(map, map);
    EXPECT_EQ(r.kind, ReuseKind::identical);
    EXPECT_EQ(r.shift_x, 0);
    EXPECT_EQ(r.shift_y, 0);
    EXPECT_EQ(r.kept, (TexelRect{0, 0, 128, 128}));
    EXPECT_EQ(r.strip_count, 0);
  }
}

TEST(Reuse, a_camera_that_steps_seven_texels_aside_leaves_a_strip_of_seven) {
  Case c = stable_case();
  c.light = {0, -1, 0};  // the axes across it are the world's x and z
  const ShadowPlan before = c.plan();
  const double texel = before.map[0].snap_key.texel.x;
  EXPECT_NEAR(texel, before.map[0].texel_world.x, 1e-9 * texel);
  c.camera.position.x += 7.0 * texel;
  const ShadowPlan after = c.plan();
  const MapReuse r = reuse(before.map[0], after.map[0]);
  ASSERT_EQ(r.kind, ReuseKind::scrolled);
  EXPECT_EQ(std::abs(r.shift_x) + std::abs(r.shift_y), 7);
  ASSERT_EQ(r.strip_count, 1);
  EXPECT_EQ(r.strip[0].width * r.strip[0].height, 7 * 128);
  EXPECT_EQ(r.kept.width * r.kept.height, 121 * 128);
}

TEST(Reuse, another_light_size_grid_depth_or_fit_is_drawn_whole) {
  const Case c = stable_case();
  const ShadowMap map = c.plan().map[0];
  const auto refused = [&](const ShadowMap& other, const char* what) {
    for (const MapReuse& r : {reuse(map, other), reuse(other, map)}) {
      EXPECT_EQ(r.kind, ReuseKind::none) << what;
      EXPECT_TRUE(r.kept.empty()) << what;
      ASSERT_EQ(r.strip_count, 1) << what;
    }
    EXPECT_EQ(reuse(map, other).strip[0], (TexelRect{0, 0, other.width, other.height})) << what;
  };
  Case other = c;
  other.light.x += 1e-6;
  refused(other.plan().map[0], "light");
  other = c;
  other.options.resolution.max_size = 256;
  refused(other.plan().map[0], "size");
  other = c;
  other.options.fit = Fit::tight;
  refused(other.plan().map[0], "tight");
  other = c;
  other.options.filter.texels = 3.0;
  refused(other.plan().map[0], "margin");
  other = c;
  other.options.clip_space = kVulkan;
  refused(other.plan().map[0], "clip space");
  refused(c.plan().map[1], "another cascade");
  ShadowMap deeper = map;
  ++deeper.snap_key.depth_near;
  refused(deeper, "depth");
  ShadowMap positional = map, moved = map;
  positional.light_world.w = moved.light_world.w = 1.0;
  moved.clip_from_world[3].x += 1e-3;
  EXPECT_EQ(reuse(positional, moved).kind, ReuseKind::none);
  const ShadowMap tight = [&] {
    Case t = c;
    t.options.fit = Fit::tight;
    return t.plan().map[0];
  }();
  ShadowMap next = tight;
  next.clip_from_world[3].x += 1e-12;
  EXPECT_EQ(reuse(tight, next).kind, ReuseKind::none);
  EXPECT_EQ(reuse(tight, tight).kind, ReuseKind::identical);  // nothing moved
}

TEST(Reuse, a_step_over_the_whole_map_or_beyond_what_keys_can_count_leaves_nothing) {
  const ShadowMap map = stable_case().plan().map[0];
  for (const std::int64_t step : {std::int64_t{127}, std::int64_t{128}, std::int64_t{1} << 40}) {
    for (const std::int64_t sign : {-1, 1}) {
      ShadowMap along_x = map, along_y = map;
      along_x.snap_key.x += sign * step;
      along_y.snap_key.y += sign * step;
      const ReuseKind expected = step == 127 ? ReuseKind::scrolled : ReuseKind::none;
      EXPECT_EQ(reuse(map, along_x).kind, expected) << step;
      EXPECT_EQ(reuse(map, along_y).kind, expected) << step;
    }
  }
  ShadowMap lost = map;
  lost.snap_key.x = std::int64_t{1} << 53;
  ShadowMap beside = lost;
  beside.clip_from_world[3].x += 1e-12;
  EXPECT_EQ(reuse(lost, beside).kind, ReuseKind::none);
}

TEST(Reuse, a_world_points_old_texel_plus_the_shift_is_its_new_texel_in_every_clip_space) {
  int scrolled = 0, two_strips = 0;
  for_all(600, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 2});
    c.options.fit = Fit::stable;
    c.options.split.pseudo_near = 0.0;
    c.options.split.range = SplitRange::camera;
    c.options.cascades = 1 + pick(3);
    c.options.resolution.max_size = 64;
    c.options.filter.texels = std::min(c.options.filter.texels, 4.0);
    c.options.clip_space = draw_clip_space();
    const double f = 4.0 * c.camera.far_depth;
    c.receivers = c.casters = {{c.camera.position - glm::dvec3(f), c.camera.position + glm::dvec3(f)}};
    RC_LOG() << c;
    const ShadowPlan before = c.plan();
    if (before.map_count == 0) return;
    Case moved = c;
    const double reach = 40.0 * before.map[0].snap_key.texel.x;
    glm::dvec3 step = glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * reach;
    // Mostly across the light: along it, the depth range moves on.
    const glm::dvec3 light = before.light_direction;
    if (chance(0.8)) step -= light * glm::dot(step, light);
    moved.camera.position += step;
    const ShadowPlan after = moved.plan();
    Random random(3);
    for (const ShadowMap& old_map : before.maps()) {
      for (const ShadowMap& new_map : after.maps()) {
        if (old_map.cascade != new_map.cascade) continue;
        const MapReuse r = reuse(old_map, new_map, c.options.clip_space);
        for (const int times : cover(r, new_map.width, new_map.height)) require(times == 1, "covered", times);
        if (r.kind == ReuseKind::none) continue;
        scrolled += r.kind == ReuseKind::scrolled;
        two_strips += r.strip_count == 2;
        for (int i = 0; i < 4; ++i) {
          const glm::dvec3 p = point_at(c.camera, random.between(-1, 1), random.between(-1, 1),
                                        random.between(new_map.depth_begin, new_map.depth_end));
          const glm::dvec3 was = place(old_map, c.options.clip_space, p);
          const glm::dvec3 is = place(new_map, c.options.clip_space, p);
          require(
              std::abs(was.x + r.shift_x - is.x) <= kTexel && std::abs(was.y + r.shift_y - is.y) <= kTexel,
              "texel", was.x, was.y, "shift", r.shift_x, r.shift_y, "now", is.x, is.y);
          require(std::abs(was.z - is.z) <= 1e-9, "depth", was.z, is.z);
        }
        // What is kept was in the old map.
        const TexelRect from{r.kept.x - r.shift_x, r.kept.y - r.shift_y, r.kept.width, r.kept.height};
        require(from.x >= 0 && from.y >= 0 && from.x + from.width <= old_map.width &&
                    from.y + from.height <= old_map.height,
                "source", from.x, from.y);
      }
    }
  });
  EXPECT_GT(scrolled, 200);
  EXPECT_GT(two_strips, 150);
}

TEST(Reuse, the_planes_of_a_rectangle_hold_what_can_shadow_it_and_nothing_else) {
  int inside = 0, outside = 0, above = 0;
  for_all(400, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 8});
    c.options.clip_space = draw_clip_space();
    RC_LOG() << c;
    const ClipSpace space = c.options.clip_space;
    const ShadowPlan plan = c.plan();
    Random random(4);
    for (const ShadowMap& map : plan.maps()) {
      const TexelRect rect{random.pick(map.width / 2), random.pick(map.height / 2),
                           1 + random.pick(map.width / 2), 1 + random.pick(map.height / 2)};
      const auto planes = rectangle_planes(map, rect, space);
      const glm::dmat4 world_from_texture = glm::inverse(texture_from_clip(space) * map.clip_from_world);
      for (int i = 0; i < 8; ++i) {
        // In and round the rectangle, from beyond the far plane to twice the depth range above the near
        // plane.
        const double u = (rect.x + random.between(-0.3, 1.3) * rect.width) / map.width;
        const double v = (rect.y + random.between(-0.3, 1.3) * rect.height) / map.height;
        const double fall = random.between(-2.0, 1.3);  // 0: near plane, 1: far plane
        const glm::dvec4 h = world_from_texture * glm::dvec4(u, v, space.reversed_z ? 1.0 - fall : fall, 1.0);
        if (!(h.w > 0.0)) continue;
        const glm::dvec3 p = glm::dvec3(h) / h.w;
        const glm::dvec3 t = place(map, space, p);
        // A map of a single point far from the origin has texels below the rounding of positions.
        if (std::abs(t.x - u * map.width) + std::abs(t.y - v * map.height) > 1e-4) continue;
        const double x = t.x - rect.x, y = t.y - rect.y;
        const double from_edge = std::min({std::abs(x), std::abs(x - rect.width), std::abs(y),
                                           std::abs(y - rect.height), 100.0 * std::abs(1.0 - fall)});
        if (from_edge < 1e-3) continue;  // on a plane, rounding decides
        const bool expected = x > 0 && y > 0 && x < rect.width && y < rect.height && fall < 1.0;
        bool held = true;
        for (const glm::dvec4& plane : planes) held = held && glm::dot(glm::dvec3(plane), p) + plane.w >= 0.0;
        require(held == expected, "at", x, y, "of", rect.width, rect.height, "fall", fall, "held", held);
        ++(expected ? inside : outside);
        above += expected && fall < 0.0;
      }
    }
  });
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
  EXPECT_GT(above, 200);
}

TEST(Rebased, an_eye_at_the_origin_gets_the_matrix_from_world_and_all_else_stays) {
  const ShadowMap map = stable_case().plan().map[0];
  const ShadowMap moved = rebased(map, glm::dvec3(0.0));
  EXPECT_EQ(moved.clip_from_camera_relative, glm::mat4(map.clip_from_world));
  EXPECT_EQ(moved.clip_from_world, map.clip_from_world);
  EXPECT_EQ(moved.cull_planes, map.cull_planes);
  EXPECT_EQ(reuse(map, moved).kind, ReuseKind::identical);
}

TEST(Rebased, by_hand_a_step_moves_the_last_column_alone) {
  ShadowMap map;
  map.clip_from_world = glm::dmat4(0.5, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, -0.1, 0.2, 1, 2, 3, 4);
  const glm::mat4 moved = rebased(map, {2.0, 4.0, 10.0}).clip_from_camera_relative;
  EXPECT_EQ(moved[3], glm::vec4(2.0f, 3.0f, 2.0f, 6.0f));
  EXPECT_EQ(moved[2], glm::vec4(0.0f, 0.0f, -0.1f, 0.2f));
}

TEST(Rebased, points_keep_their_texel_to_a_thousandth_under_any_steps_of_the_eye_far_from_the_origin) {
  int checked = 0;
  for_all(300, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3});
    const glm::dvec3 far_away = glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * 1e6;
    c.camera.position += far_away;
    for (std::vector<Box>* boxes : {&c.casters, &c.receivers}) {
      for (Box& box : *boxes) box = {box.min + far_away, box.max + far_away};
    }
    const ShadowPlan plan = c.plan();
    Random random(static_cast<std::uint64_t>(pick(1 << 20)));
    for (const ShadowMap& map : plan.maps()) {
      ShadowMap kept = map;
      glm::dvec3 eye = c.camera.position;
      for (int step = 0; step < 20; ++step) {
        eye += random.direction() * (0.02 * map.depth_end);
        kept = rebased(kept, eye);
      }
      for (const glm::dvec3& point : visible_points(c, random, 2, 4)) {
        const glm::dvec4 exact = map.clip_from_world * glm::dvec4(point, 1.0);
        if (!(exact.w > 0.0) || std::abs(exact.x) > exact.w || std::abs(exact.y) > exact.w) continue;
        // Floats hold the offset itself to 2^-24: what they make of it is no fault of the matrix.
        const glm::dvec3 offset(glm::vec3(point - eye));
        const glm::dvec4 ideal = map.clip_from_world * glm::dvec4(eye + offset, 1.0);
        const glm::dvec4 got = glm::dmat4(kept.clip_from_camera_relative) * glm::dvec4(offset, 1.0);
        const glm::dvec2 size(map.width, map.height);
        const glm::dvec2 off = 0.5 * size * (glm::dvec2(got) / got.w - glm::dvec2(ideal) / ideal.w);
        // As good as the plan's own matrix at its own eye, which is a float too.
        const glm::dvec3 own(glm::vec3(point - c.camera.position));
        const glm::dvec4 planned = glm::dmat4(map.clip_from_camera_relative) * glm::dvec4(own, 1.0);
        const glm::dvec4 planned_ideal = map.clip_from_world * glm::dvec4(c.camera.position + own, 1.0);
        const glm::dvec2 own_off =
            0.5 * size * (glm::dvec2(planned) / planned.w - glm::dvec2(planned_ideal) / planned_ideal.w);
        ++checked;
        require(glm::length(off) <= 1e-3 + 4.0 * glm::length(own_off), "off by", glm::length(off),
                "planned by", glm::length(own_off), c);
      }
    }
  });
  EXPECT_GT(checked, 1000);
}

TEST(Reuse, a_set_lists_the_casters_of_a_strip) {
  Case c = stable_case();
  c.light = {0, -1, 0};
  const ShadowMap map = c.plan().map[0];
  // A pole over each texel's centre: the strip lists its own and those on its edge lines.
  const glm::dmat4 world_from_texture = glm::inverse(texture_from_clip({}) * map.clip_from_world);
  std::vector<Box> poles;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec4 p =
          world_from_texture * glm::dvec4((x + 0.5) / map.width, (y + 0.5) / map.height, 0.5, 1.0);
      poles.push_back({glm::dvec3(p) - glm::dvec3(0, 1, 0), glm::dvec3(p) + glm::dvec3(0, 500, 0)});
    }
  }
  std::vector<CasterBlock> blocks(CasterSet::block_count(poles.size()));
  std::vector<std::uint32_t> indices(CasterSet::index_count(poles.size())), list(poles.size());
  const CasterSet set(poles, blocks, indices);
  const TexelRect strip{5, 0, 3, map.height};
  EXPECT_EQ(set.cull(rectangle_planes(map, strip), list), 3u * static_cast<std::size_t>(map.height));
  for (std::size_t i = 0; i < 3u * static_cast<std::size_t>(map.height); ++i) {
    const int x = static_cast<int>(list[i]) % map.width;
    EXPECT_TRUE(x >= 5 && x < 8) << x;
  }
}

}  // namespace
}  // namespace gnomon::test
