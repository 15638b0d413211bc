// Do maps mean the same under every convention of clip space, texture, handedness and camera?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// A few roundings of coordinates of order one.
constexpr double kRounding = 1e-12;
// A texel's place in maps of up to 2048 texels, with clip coordinates good to 1e-9 (a long frustum's own
// rounding).
constexpr double kTexel = 1e-5;

std::vector<ClipSpace> all_clip_spaces() {
  std::vector<ClipSpace> all;
  for (int bits = 0; bits < 32; ++bits) {
    all.push_back({static_cast<NdcDepth>(bits & 1), (bits & 2) != 0, (bits & 4) != 0,
                   static_cast<Handedness>(bits >> 3 & 1), static_cast<FirstRow>(bits >> 4 & 1)});
  }
  return all;
}

glm::dvec3 ndc(const glm::dmat4& m, const glm::dvec3& p) {
  const glm::dvec4 h = m * glm::dvec4(p, 1.0);
  return glm::dvec3(h) / h.w;
}

/// A sloping sun over boxes, one warped map.
Case scene() {
  Case c;
  c.camera = perspective_camera({3, 6, 10}, {0.2, -0.3, -1}, {0, 1, 0}, 1.0, 1.6, 0.5, 150.0, 800, 500);
  c.light = {0.4, -1.0, 0.3};
  c.receivers = {{{-60, -1, -120}, {60, 0, 20}}, {{-10, 0, -40}, {4, 6, -20}}};
  c.casters = {{{-60, -1, -120}, {60, 0, 20}}, {{-10, 0, -40}, {4, 6, -20}}, {{5, 20, -30}, {9, 24, -20}}};
  c.options.cascades = 1;
  c.options.warp.warp = &warps::lispsm;
  return c;
}

/// What each API does with clip coordinates: where in memory a fragment is written and what its depth buffer
/// holds. From the APIs' own viewport transforms, for a viewport of the whole target and the default depth
/// range.
struct Api {
  const char* name;
  ClipSpace space;
  double (*row)(double y);    // share of the height, from the first row in memory
  double (*depth)(double z);  // as stored
};
const Api kApis[] = {
    // Window y = (y + 1) / 2 from the bottom, and the bottom row comes first.
    {"OpenGL", kOpenGl, [](double y) { return (y + 1) / 2; }, [](double z) { return (z + 1) / 2; }},
    {"OpenGL after glClipControl", kOpenGlZeroToOne, [](double y) { return (y + 1) / 2; },
     [](double z) { return z; }},
    // Framebuffer y = (y + 1) / 2 from the top, and the top row comes first.
    {"Vulkan", kVulkan, [](double y) { return (y + 1) / 2; }, [](double z) { return z; }},
    // Viewport y = (1 - y) / 2 from the top, and the top row comes first.
    {"Direct3D", kDirect3D, [](double y) { return (1 - y) / 2; }, [](double z) { return z; }},
    {"Metal", kMetal, [](double y) { return (1 - y) / 2; }, [](double z) { return z; }},
};

TEST(Conventions, what_each_api_draws_is_read_where_it_was_drawn) {
  for (const Api& api : kApis) {
    Case c = scene();
    c.options.clip_space = api.space;
    const ShadowPlan plan = c.plan();
    ASSERT_EQ(plan.map_count, 1) << api.name;
    const glm::dmat4& m = plan.map[0].clip_from_world;
    Random random(1);
    const auto points = visible_points(c, random, 50, 4);
    ASSERT_GT(points.size(), 50u);
    for (const glm::dvec3& p : points) {
      const glm::dvec3 drawn = ndc(m, p), read = ndc(texture_from_clip(api.space) * m, p);
      EXPECT_NEAR(read.x, (drawn.x + 1) / 2, kRounding) << api.name;
      EXPECT_NEAR(read.y, api.row(drawn.y), kRounding) << api.name;
      EXPECT_NEAR(read.z, api.depth(drawn.z), kRounding) << api.name;
    }
  }
}

TEST(Conventions, each_api_shows_the_map_upright_in_memory_from_its_first_row) {
  // OpenGL's first row is the bottom of the picture; the others' is the top.
  const auto v_of_up = [](const ClipSpace& space) {
    Case c = scene();
    c.options.clip_space = space;
    const ShadowMap map = c.plan().map[0];
    const glm::dmat4 m = texture_from_clip(space) * map.clip_from_world;
    Case gl = scene();
    const glm::dmat4 up_from = gl.plan().map[0].clip_from_world;
    const glm::dvec3 p{0, 0, -30};
    const glm::dvec3 up{up_from[0][1], up_from[1][1], up_from[2][1]};
    return ndc(m, p + 0.1 * glm::normalize(up)).y - ndc(m, p).y;
  };
  EXPECT_GT(v_of_up(kOpenGl), 0.0);
  EXPECT_GT(v_of_up(kOpenGlZeroToOne), 0.0);
  EXPECT_LT(v_of_up(kVulkan), 0.0);
  EXPECT_LT(v_of_up(kDirect3D), 0.0);
  EXPECT_LT(v_of_up(kMetal), 0.0);
}

TEST(Conventions, every_combination_keeps_receivers_inside_and_orders_depth_as_it_says) {
  const ShadowMap reference = scene().plan().map[0];
  for (const ClipSpace& space : all_clip_spaces()) {
    Case c = scene();
    c.options.clip_space = space;
    const ShadowPlan plan = c.plan();
    ASSERT_EQ(plan.map_count, 1);
    EXPECT_EQ(plan.clip_space, space);
    const ShadowMap& map = plan.map[0];
    const glm::dvec3 towards_light = -plan.light_direction;
    const double near_ndc = space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
    Random random(2);
    const auto points = visible_points(c, random, 40, 4);
    ASSERT_GT(points.size(), 40u);
    for (const glm::dvec3& p : points) {
      const glm::dvec3 gl = ndc(reference.clip_from_world, p), here = ndc(map.clip_from_world, p);
      EXPECT_NEAR(here.x, space.handedness == Handedness::left ? -gl.x : gl.x, kRounding);
      EXPECT_NEAR(here.y, space.y_down ? -gl.y : gl.y, kRounding);
      EXPECT_TRUE(here.z >= near_ndc && here.z <= 1.0 && std::abs(here.x) <= 1.0 && std::abs(here.y) <= 1.0);
      const glm::dvec3 read = ndc(texture_from_clip(space) * map.clip_from_world, p);
      const double gl_depth = (gl.z + 1) / 2;
      EXPECT_NEAR(read.z, space.reversed_z ? 1.0 - gl_depth : gl_depth, kRounding);
      const glm::dvec3 nearer = ndc(texture_from_clip(space) * map.clip_from_world, p + towards_light);
      EXPECT_EQ(nearer.z > read.z, space.reversed_z);
      EXPECT_NEAR(nearer.x, read.x, kRounding);
      EXPECT_NEAR(nearer.y, read.y, kRounding);
    }
    // Nothing but the two matrices knows of the convention.
    EXPECT_EQ(map.cull_planes, reference.cull_planes);
    EXPECT_EQ(map.texel_world, reference.texel_world);
    EXPECT_EQ(map.bias_world.slope, reference.bias_world.slope);
    EXPECT_EQ(map.depth_range_world, reference.depth_range_world);
    EXPECT_CLOSE(measure(plan, c.camera, c.bounds(), {8, 8, 8}).max,
                 measure(scene().plan(), c.camera, c.bounds(), {8, 8, 8}).max, 1e-9);
  }
}

TEST(Conventions, a_map_is_what_the_light_sees_and_no_mirror_image_in_worlds_of_either_hand) {
  for (const ClipSpace& space : all_clip_spaces()) {
    Case c = scene();
    c.options.clip_space = space;
    const ShadowPlan plan = c.plan();
    const glm::dmat4& m = plan.map[0].clip_from_world;
    const glm::dvec3 p{0, 0, -30}, o = ndc(m, p);
    // Two steps across the light that turn counter-clockwise seen against its rays, in a right-handed world;
    // the same numbers turn clockwise in a left-handed one.
    const glm::dvec3 a = any_across(plan.light_direction), b = glm::cross(-plan.light_direction, a);
    const glm::dvec3 da = ndc(m, p + 0.01 * a) - o, db = ndc(m, p + 0.01 * b) - o;
    const bool counter_clockwise_seen = space.handedness == Handedness::right;
    const double turn = da.x * db.y - da.y * db.x;
    EXPECT_EQ((space.y_down ? -turn : turn) > 0.0, counter_clockwise_seen);
  }
}

/// The same scene in a world whose z points the other way.
Case in_left_handed_world(const Case& c) {
  const auto mirrored = [](glm::dvec3 v) {
    v.z = -v.z;
    return v;
  };
  Case m = c;
  m.camera.position = mirrored(c.camera.position);
  m.camera.forward = mirrored(c.camera.forward);
  m.camera.up = mirrored(c.camera.up);
  m.camera.left = -c.camera.right;
  m.camera.right = -c.camera.left;
  m.light = mirrored(c.light);
  for (std::vector<Box>* boxes : {&m.casters, &m.receivers}) {
    for (Box& box : *boxes) {
      const Box was = box;
      box.min.z = -was.max.z;
      box.max.z = -was.min.z;
    }
  }
  m.options.clip_space.handedness = Handedness::left;
  return m;
}

TEST(Conventions, a_left_handed_world_gets_the_same_texels) {
  int compared = 0, turned = 0;
  for_all(600, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 8});
    // Warps by formula; a search walks its steps in the turning sense of the axes, which a mirror turns
    // round.
    const Warp* const warps_by_formula[] = {&warps::none, &warps::lispsm_closed, &warps::lispsm_lloyd};
    c.options.warp.warp = warps_by_formula[pick(3)];
    c.options.split.scheme = SplitScheme::practical;
    // The points that a percentile is taken of are not their own mirror image.
    if (c.options.warp.objective == Objective::p95) c.options.warp.objective = Objective::max;
    // Of two rectangles of the same least area, the mirror image may get the other one.
    if (c.options.fit == Fit::rotated) c.options.fit = Fit::tight;
    RC_LOG() << c;
    const Case mirrored = in_left_handed_world(c);
    const ShadowPlan a = c.plan(), b = mirrored.plan();
    require(a.status == b.status && a.map_count == b.map_count, "status", a.map_count, b.map_count);
    Random random(6);
    for (int i = 0; i < a.map_count; ++i) {
      const ShadowMap &m = a.map[static_cast<std::size_t>(i)], &n = b.map[static_cast<std::size_t>(i)];
      require(m.warp == n.warp && deviation(m.kappa, n.kappa) <= 1e-9, "warp", m.warp->name, m.kappa,
              n.kappa);
      // A fixed grid's axes are a matter of choice: half a turn of the whole map may lie between the two.
      double sign = 0.0;
      for (int k = 0; k < 8; ++k) {
        const glm::dvec3 p = point_at(c.camera, random.between(-1, 1), random.between(-1, 1),
                                      random.between(m.depth_begin, m.depth_end));
        const glm::dvec3 u = ndc(m.clip_from_world, p), v = ndc(n.clip_from_world, {p.x, p.y, -p.z});
        const double scale = std::max({1.0, std::abs(u.x), std::abs(u.y), std::abs(u.z)});
        const double size = 0.5 * m.width / scale;
        // Positions this far from the origin round to a share of a small map's texel.
        const double blur = 1e-13 * (glm::length(c.camera.position) + c.camera.far_depth) /
                            std::min(m.texel_world.x, m.texel_world.y);
        if (!(blur < 1e-3)) continue;
        const auto off = [&](double s) {
          return size * std::max(std::abs(u.x - s * v.x), std::abs(u.y - s * v.y));
        };
        if (sign == 0.0) sign = c.options.fit == Fit::stable && off(-1.0) < off(1.0) ? -1.0 : 1.0;
        // A stable centre exactly between two texels may snap to either.
        const double step = c.options.fit == Fit::stable && off(sign) > 0.5 ? 1.0 : 0.0;
        require(std::abs(off(sign) - step) <= kTexel + blur, "texel", u.x, u.y, v.x, v.y, "off", off(sign));
        require(std::abs(u.z - v.z) <= 1e-6 * scale, "depth", u.z, v.z);
        ++compared;
        turned += sign < 0.0;
      }
    }
  });
  EXPECT_GT(compared, 3000);
  EXPECT_GT(turned, 50);
}

TEST(Conventions, an_off_axis_camera_of_a_left_handed_world_sees_what_its_mirror_image_sees) {
  Case c = scene();
  c.camera.left = 0.2;  // looks to the right
  const Case mirrored = in_left_handed_world(c);
  Random random(7);
  for (const glm::dvec3& p : visible_points(c, random, 20, 4)) {
    const glm::dvec3 seen = ndc(clip_from_view(c.camera) * view_from_world(c.camera), p);
    const glm::dvec3 mirror = ndc(clip_from_gl_clip(mirrored.options.clip_space) *
                                      clip_from_view(mirrored.camera) * view_from_world(mirrored.camera),
                                  {p.x, p.y, -p.z});
    EXPECT_NEAR(seen.x, mirror.x, kRounding);
    EXPECT_NEAR(seen.y, mirror.y, kRounding);
    EXPECT_NEAR(seen.z, mirror.z, kRounding);
  }
}

TEST(Conventions, off_axis_and_orthographic_cameras_get_all_they_see_inside_their_maps) {
  std::vector<Camera> cameras;
  const Camera whole = scene().camera;
  for (int tile = 0; tile < 4; ++tile) {  // a picture drawn in four tiles
    Camera part = whole;
    (tile & 1 ? part.left : part.right) = 0.0;
    (tile & 2 ? part.bottom : part.top) = 0.0;
    cameras.push_back(part);
  }
  Camera eye = whole;  // one eye of a headset: edges on both sides, unequal
  eye.left = -0.7, eye.right = 0.4;
  cameras.push_back(eye);
  Camera beside = whole;  // the axis is outside of the image
  beside.left = 0.3, beside.right = 0.9;
  cameras.push_back(beside);
  cameras.push_back(
      orthographic_camera({3, 30, 10}, {0.2, -1, -1}, {0, 1, 0}, 40.0, 1.5, 0.5, 150.0, 600, 400));
  cameras.push_back(
      orthographic_camera({3, 30, 10}, {0, -1, 0}, {0, 0, -1}, 40.0, 1.5, -5.0, 150.0, 600, 400));
  for (const Camera& camera : cameras) {
    for (const Warp* warp : all_warps()) {
      Case c = scene();
      c.camera = camera;
      c.options.cascades = 3;
      c.options.warp.warp = warp;
      const ShadowPlan plan = c.plan();
      ASSERT_EQ(plan.status, PlanStatus::ok) << warp->name;
      Random random(8);
      const auto points = visible_points(c, random, 40, 4);
      ASSERT_GT(points.size(), 20u);
      for (const glm::dvec3& p : points) {
        const ShadowMap* map = map_for(plan, depth_of(camera, p));
        if (map == nullptr) continue;  // on the far plane, by rounding
        const glm::dvec3 at = ndc(map->clip_from_world, p);
        EXPECT_LE(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}), 1.0) << warp->name;
      }
      EXPECT_EQ(measure(plan, camera, c.bounds(), {8, 8, 16}).outside, 0u) << warp->name;
    }
  }
}

TEST(Conventions, an_orthographic_camera_sees_behind_its_own_position) {
  Case c = scene();
  c.camera = orthographic_camera({3, 30, 10}, {0, -1, 0}, {0, 0, -1}, 40.0, 1.5, -5.0, 150.0, 600, 400);
  c.receivers = {{{-50, -5, -50}, {50, 60, 50}}};
  c.options.cascades = 1;
  const ShadowPlan plan = c.plan();
  ASSERT_EQ(plan.map_count, 1);
  EXPECT_LE(plan.map[0].depth_begin, -5.0);
}

TEST(Conventions, a_tile_of_a_picture_never_needs_more_texels_than_the_whole) {
  Case c = scene();
  const double whole = c.plan().map[0].storage * c.camera.width * c.camera.height;
  for (int tile = 0; tile < 2; ++tile) {
    Case part = scene();
    (tile == 0 ? part.camera.left : part.camera.right) = 0.0;
    part.camera.width /= 2;
    EXPECT_LE(part.plan().map[0].storage * part.camera.width * part.camera.height, whole * (1.0 + kRounding));
  }
}

}  // namespace
}  // namespace gnomon::test
