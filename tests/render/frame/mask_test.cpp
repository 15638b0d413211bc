// Is a pixel lit where it should be? The drawn mask against shadows that are known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"
#include "mask_frame.hpp"

namespace gnomon::render {
namespace {

// Degenerate.

TEST(Mask, is_lit_everywhere_for_a_plan_without_maps) {
  const Scene scene = box_on_ground();
  Renderer renderer(scene);
  const Frame frame = draw(renderer, camera_on_box(kSize, kSize), ShadowPlan{}, filters::pcf);
  std::size_t surfaces = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    ASSERT_EQ(frame.lit(i), 1.0f);
    ASSERT_EQ(frame.map(i), -1);
    surfaces += frame.surface(i) ? 1 : 0;
  }
  EXPECT_GT(surfaces, frame.pixels() / 2);
}

TEST(Mask, is_lit_and_without_map_in_an_empty_scene) {
  const Scene scene = empty_scene();
  Renderer renderer(scene);
  const Camera camera = camera_on_box(kSize, kSize);
  const Frame frame = draw(renderer, camera, plan_for(scene, camera, kSlant, {}), filters::hard);
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    ASSERT_EQ(frame.lit(i), 1.0f);
    ASSERT_FALSE(frame.surface(i));
  }
}

// By hand.

TEST(Mask, is_dark_on_faces_turned_from_the_light) {
  const Frame frame = draw_scene(box_on_ground(), camera_on_box(kSize, kSize), glm::dvec3(-0.2, -1.0, -1.0));
  std::size_t away = 0;
  const glm::dvec3 light = frame.plan.light_direction;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || glm::dot(frame.normal(i), light) < 1e-3) continue;
    ASSERT_EQ(frame.lit(i), 0.0f);
    ++away;
  }
  EXPECT_EQ(away, 0u) << "the light comes from behind the camera: nothing in view is turned from it";
  const Frame back = draw_scene(box_on_ground(), camera_on_box(kSize, kSize), glm::dvec3(0.2, -1.0, 1.0));
  for (std::size_t i = 0; i < back.pixels(); ++i) {
    if (!back.surface(i) || glm::dot(back.normal(i), back.plan.light_direction) < 1e-3) continue;
    ASSERT_EQ(back.lit(i), 0.0f);
    ++away;
  }
  EXPECT_GT(away, 500u);
}

TEST(Mask, a_pixel_takes_the_finest_map_that_holds_its_point) {
  PlanOptions options;
  options.split.selection = MapSelection::finest;
  for (const Warp* const warp : {&warps::none, &warps::optimal}) {
    options.warp.warp = warp;
    const Frame frame =
        draw_scene(box_on_ground(), camera_on_box(kSize, kSize), {0.2, -0.4, -1.0}, filters::hard, options);
    std::size_t same = 0, other = 0, nearer = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (!frame.surface(i)) continue;
      const glm::dvec3 point = frame.point(i);
      const double depth = glm::dot(point - frame.camera.position, camera_axes(frame.camera).forward);
      const int expected = map_serving(frame.plan, point, depth);
      ++(frame.map(i) == expected ? same : other);
      if (expected >= 0 && depth > frame.plan.map[static_cast<std::size_t>(expected)].depth_end) ++nearer;
    }
    // At a map's border rounding decides.
    EXPECT_LT(other, same / 200) << warp->name;
    if (warp == &warps::none) {
      EXPECT_GT(nearer, same / 20);
    }
  }
}

TEST(Mask, lets_light_through_what_the_alpha_mask_cuts_out) {
  Scene scene = box_on_ground();
  Image leaf{"leaf", 2, 2, std::vector<std::uint8_t>(16, 255)};
  leaf.rgba[3] = leaf.rgba[11] = 0;  // the left column is not there
  scene.images.push_back(leaf);
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_image = 0;
  material.double_sided = true;
  material.wrap_u = material.wrap_v = TextureWrap::clamp_to_edge;
  // A leaf 2 x 2 over the ground beside the box, under a sun overhead.
  add_quad(scene, {3.0f, 1.0f, 3.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f}, add_material(scene, material));
  Camera camera = camera_on_box(kSize, kSize);
  camera.position = {4.0, 0.8, 6.0};
  camera.forward = {0.0, -0.25, -1.0};
  const Frame frame = draw_scene(scene, camera, {0.0, -1.0, 0.0});
  std::size_t through = 0, blocked = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    const glm::dvec3 p = frame.point(i);
    if (!frame.surface(i) || p.y > 0.01 || p.z < 1.2 || p.z > 2.8) continue;
    if (p.x > 3.1 && p.x < 3.8) {
      ASSERT_EQ(frame.lit(i), 1.0f) << p.x << " " << p.z;
      ++through;
    }
    if (p.x > 4.2 && p.x < 4.9) {
      ASSERT_EQ(frame.lit(i), 0.0f) << p.x << " " << p.z;
      ++blocked;
    }
  }
  EXPECT_GT(through, 50u);
  EXPECT_GT(blocked, 50u);
}

TEST(Mask, of_a_mirrored_instance_is_that_of_mirrored_vertices) {
  // A wedge, so that left and right differ.
  std::vector<glm::vec3> wedge = box_triangles({-1, 0, -1}, {1, 2, 1});
  for (glm::vec3& p : wedge) {
    if (p.x > 0.0f) p.y *= 0.25f;
  }
  std::vector<glm::vec3> other = wedge;
  for (glm::vec3& p : other) p.x = -p.x;
  for (std::size_t t = 0; t < other.size(); t += 3) std::swap(other[t + 1], other[t + 2]);

  Material one_sided;
  Scene mirrored = empty_scene(), rebuilt = empty_scene(), plain = empty_scene();
  for (Scene* scene : {&mirrored, &rebuilt, &plain}) {
    add_quad(*scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
    add_material(*scene, one_sided);
  }
  glm::dmat4 flip(1.0);
  flip[0][0] = -1.0;
  add_mesh(mirrored, wedge, flip, 1, true);
  add_mesh(rebuilt, other, glm::dmat4(1.0), 1);
  add_mesh(plain, wedge, glm::dmat4(1.0), 1);
  const Camera camera = camera_on_box(kSize, kSize);
  const Frame a = draw_scene(mirrored, camera, kSlant), b = draw_scene(rebuilt, camera, kSlant),
              c = draw_scene(plain, camera, kSlant);
  EXPECT_EQ(a.mask.values, b.mask.values);
  EXPECT_NE(a.mask.values, c.mask.values);
}

// Over many lights and every warp.

struct Verdict {
  std::size_t lit = 0, dark = 0;  ///< pixels that were judged
  std::size_t acne = 0, gap = 0;  ///< of those, wrong ones
  glm::dvec3 first_wrong{0.0};
};

/// Near an edge of the box whose wall lies along the light: such a wall is a sliver in the map, thinner than
/// what vertices are rounded to, and its depth there may be off by a texel's worth of its slope.
bool near_sliver(const glm::dvec3& p, const glm::dvec3& light, double margin) {
  constexpr double kAlongTheLight = 0.01;
  for (int c = 0; c < 3; ++c) {
    const bool at_wall = p[c] - kBoxMin[c] < margin || kBoxMax[c] - p[c] < margin;
    if (at_wall && std::abs(light[c]) < kAlongTheLight) return true;
  }
  return false;
}

/// From a point whose ray towards the light meets the box, to where that ray leaves it.
double distance_out_of_box(const glm::dvec3& point, const glm::dvec3& to_light) {
  double out = 1e9;
  for (int c = 0; c < 3; ++c) {
    if (to_light[c] == 0.0) continue;
    out = std::min(out, ((to_light[c] > 0.0 ? kBoxMax[c] : kBoxMin[c]) - point[c]) / to_light[c]);
  }
  return out;
}

/// Judges every pixel that is further from a shadow's edge than the filter can reach.
Verdict judge(const Frame& frame, double reach_texels, const Filter& filter = filters::hard) {
  Verdict verdict;
  const double tolerance = std::max(double{kWeightRounding}, filter.reference.tolerance);
  const glm::dvec3 light = frame.plan.light_direction;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || frame.map(i) < 0) continue;
    const glm::dvec3 p = frame.point(i), n = frame.normal(i);
    const double cosine = -glm::dot(n, light);
    // Beyond BiasOptions::max_slope the bias is capped, and acne is the lesser evil.
    if (cosine < 1.0 / std::sqrt(1.0 + 8.0 * 8.0)) continue;
    const ShadowMap& map = frame.plan.map[static_cast<std::size_t>(frame.map(i))];
    const glm::dvec2 texel = texel_extent_world(map.clip_from_world, map.texels(), light, p);
    // The kernel, half a texel of sampling and the normal offset, all stretched along the surface.
    const double margin = std::max(texel.x, texel.y) * (reach_texels + 1.5) / cosine;
    const bool on_ground = n.y > 0.99 && p.y < 0.01;
    if (!on_ground && p.y < margin) continue;  // the corner between wall and ground
    if (!on_ground && near_sliver(p, light, margin)) continue;
    const glm::dvec3 grow(margin, margin, margin), thin(margin, 0.0, margin);
    const bool near_box =
        on_ground && hits_box(p, -light, glm::dvec3(kBoxMin) - grow, glm::dvec3(kBoxMax) + grow);
    const bool in_box_shadow =
        on_ground && hits_box(p, -light, glm::dvec3(kBoxMin) + thin,
                              glm::dvec3(kBoxMax) - thin - glm::dvec3(0.0, margin, 0.0));
    const float expected = in_box_shadow ? 0.0f : 1.0f;
    if (near_box && !in_box_shadow) continue;
    // Filters that compare averages promise darkness only so far behind what casts it.
    if (in_box_shadow && distance_out_of_box(p, -light) < filter.reference.contact * map.depth_range_world)
      continue;
    ++(in_box_shadow ? verdict.dark : verdict.lit);
    if (std::abs(frame.lit(i) - expected) <= tolerance) continue;
    if (verdict.acne + verdict.gap == 0) verdict.first_wrong = p;
    ++(in_box_shadow ? verdict.gap : verdict.acne);
  }
  return verdict;
}

void expect_clean(const Filter& filter, Fit fit) {
  // Wide kernels leave too few pixels that are far enough from every edge to be judged.
  FilterSettings settings = default_settings(filter);
  settings.radius = std::min(settings.radius, 2.0);
  Renderer renderer(box_on_ground());
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Verdict sum;
  std::size_t frames = 0;
  // Every elevation with every azimuth where all texels are compared; each of both once, in the other order
  // for every warp, where they are blurred first, which takes ten times as long, and under the sanitizers,
  // which see no more in the other pictures.
  bool thorough = filter.info.reads == MapRead::depth;
#ifdef __SANITIZE_ADDRESS__
  thorough = thorough && fit == Fit::stable;
#endif
  constexpr std::array kElevations{0.25, 0.5, 0.9, 1.3, 1.57}, kAzimuths{0.1, 1.3, 2.6, 3.7, 5.2};
  for (std::size_t w = 0; w < all_warps().size(); ++w) {
    const Warp* warp = all_warps()[w];
    if (fit == Fit::stable && warp != &warps::none) continue;
    for (std::size_t e = 0; e < kElevations.size(); ++e) {
      for (std::size_t a = 0; a < kAzimuths.size(); ++a) {
        if (!thorough && (e + a + w) % kAzimuths.size() != 0) continue;
        const double elevation = kElevations[e], azimuth = kAzimuths[a];
        ++frames;
        const glm::dvec3 light{std::cos(elevation) * std::cos(azimuth), -std::sin(elevation),
                               std::cos(elevation) * std::sin(azimuth)};
        PlanOptions options;
        options.resolution.max_size =
            fit == Fit::stable ? 1536 : 256;  // a stable map is wider than its slice
        options.cascades = 2;
        options.warp.warp = warp;
        options.fit = fit;
        set_margin(settings, options);
        const ShadowPlan plan = plan_for(scene, camera, light, options);
        ASSERT_GT(plan.map_count, 0) << elevation << " " << azimuth;
        const Verdict v = judge(draw(renderer, camera, plan, settings), options.filter.texels, filter);
        EXPECT_EQ(v.acne, 0u) << warp->name << " elevation " << elevation << " azimuth " << azimuth << " at "
                              << v.first_wrong.x << " " << v.first_wrong.y << " " << v.first_wrong.z;
        EXPECT_EQ(v.gap, 0u) << warp->name << " elevation " << elevation << " azimuth " << azimuth << " at "
                             << v.first_wrong.x << " " << v.first_wrong.y << " " << v.first_wrong.z;
        sum.lit += v.lit;
        sum.dark += v.dark;
      }
    }
  }
  EXPECT_GT(sum.lit, 2000u * frames);
  EXPECT_GT(sum.dark, 10u * frames);
}

TEST(Mask, has_neither_acne_nor_gap_for_any_filter_under_any_warp_in_tight_fit) {
  for (const Filter* filter : all_filters()) {
    SCOPED_TRACE(filter->info.name);
    expect_clean(*filter, Fit::tight);
  }
}

TEST(Mask, has_neither_acne_nor_gap_for_any_filter_in_stable_fit) {
  for (const Filter* filter : all_filters()) {
    SCOPED_TRACE(filter->info.name);
    expect_clean(*filter, Fit::stable);
  }
}

TEST(Mask, leaves_a_plane_lit_that_the_light_grazes) {
  // Up to kSteepestPlane, whatever caps the bias: each comparison follows the plane to its texel's centre.
  Scene scene = empty_scene();
  add_quad(scene, {-20.0f, 0.0f, 20.0f}, {40.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -40.0f});
  Renderer renderer(scene);
  const Camera camera = camera_on_box(kSize, kSize);
  for (const double slope : {3.0, 30.0, 0.95 * kSteepestPlane}) {
    for (const Filter* filter : {&filters::hard, &filters::pcf, &filters::pcf_tent, &filters::pcss}) {
      for (const Warp* warp : {&warps::none, &warps::optimal}) {
        PlanOptions options;
        options.resolution.max_size = 256;
        options.cascades = 1;
        options.warp.warp = warp;
        options.prune = kPruneNothing;
        set_margin(default_settings(*filter), options);
        const glm::dvec3 light = glm::normalize(glm::dvec3(slope, -1.0, 0.3 * slope));
        const Frame frame = draw(renderer, camera, plan_for(scene, camera, light, options), *filter);
        std::size_t judged = 0, dark = 0;
        for (std::size_t i = 0; i < frame.pixels(); ++i) {
          if (!frame.surface(i) || frame.map(i) < 0) continue;
          ++judged;
          dark += frame.lit(i) < 1.0f - kWeightRounding;
        }
        EXPECT_GT(judged, 5000u);
        EXPECT_EQ(dark, 0u) << filter->info.name << " " << warp->name << " tan " << slope;
      }
    }
  }
}

TEST(Mask, shows_acne_without_bias_and_gaps_with_far_too_much) {
  const Scene scene = box_on_ground();
  Renderer renderer(scene);
  const Camera camera = camera_on_box(kSize, kSize);
  PlanOptions options;
  options.resolution.max_size = 256;
  options.cascades = 2;
  ShadowPlan none = plan_for(scene, camera, kSlant, options), much = none;
  none.bias = {-0.05, 0.0, 0.0, 0.0};
  much.bias = {100.0, 0.0, 0.0, 8.0};
  EXPECT_GT(judge(draw(renderer, camera, none, filters::hard), 0.5).acne, 100u);
  EXPECT_GT(judge(draw(renderer, camera, much, filters::hard), 0.5).gap, 100u);
}

TEST(Mask, is_unchanged_in_stable_fit_while_the_camera_moves) {
  const Scene scene = box_on_ground();
  Renderer renderer(scene);
  PlanOptions options;
  options.resolution.max_size = 512;
  options.cascades = 1;
  const auto edges_in = [&](Fit fit, double step) {
    options.fit = fit;
    options.warp.warp = &warps::none;
    Camera camera = camera_on_box(kSize, kSize);
    // A parallel camera that moves along its own view sees the same picture: only the grid could move.
    camera =
        orthographic_camera(camera.position, camera.forward, camera.up, 8.0, 1.0, 0.5, 60.0, kSize, kSize);
    camera.position += glm::normalize(camera.forward) * step;
    return draw(renderer, camera, plan_for(scene, camera, kSlant, options), filters::hard).mask.values;
  };
  const auto different = [](const std::vector<float>& a, const std::vector<float>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 2) count += a[i] != b[i] ? 1 : 0;
    return count;
  };
  const std::vector<float> still = edges_in(Fit::stable, 0.0);
  std::size_t moved = 0, moved_tight = 0;
  for (const double step : {0.011, 0.37, 0.9}) {
    moved += different(still, edges_in(Fit::stable, step));
    moved_tight += different(edges_in(Fit::tight, 0.0), edges_in(Fit::tight, step));
  }
  // Pixels whose position is rounded to the other side of a texel's border.
  EXPECT_LE(moved, 3u * kSize * kSize / 1000);
  EXPECT_GT(moved_tight, 3 * moved);
}

/// Masks of a scene and of the same elsewhere, beside an object that stays at the origin if `left_behind`.
std::size_t pixels_that_differ(const glm::dvec3& far_away, bool left_behind) {
  const Scene near_scene = box_on_ground();
  Scene far_scene = shifted(near_scene, far_away);
  if (left_behind) add_quad(far_scene, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  const Camera near_camera = camera_on_box(kSize, kSize);
  Camera far_camera = near_camera;
  far_camera.position += far_away;
  const Frame a = draw_scene(near_scene, near_camera, kSlant), b = draw_scene(far_scene, far_camera, kSlant);
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) different += a.lit(i) != b.lit(i) ? 1 : 0;
  return different;
}

// Powers of two: the moved scene rounds nothing. Matrices differ in their last float bits; only pixels on a
// texel's border may change sides.
constexpr std::size_t kAtBorders = kSize * kSize / 500;

TEST(Mask, does_not_change_a_thousand_kilometres_from_the_origin) {
  EXPECT_LE(pixels_that_differ({1'048'576.0, 0.0, -1'048'576.0}, false), kAtBorders);
}

TEST(Mask, does_not_change_where_one_object_of_a_far_scene_was_left_at_the_origin) {
  EXPECT_LE(pixels_that_differ({9'437'184.0, 0.0, -9'437'184.0}, true), kAtBorders);
}

}  // namespace
}  // namespace gnomon::render
