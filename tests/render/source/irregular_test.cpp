// Are the shadows of an irregular z-buffer those that rays find, for any plan, light and caster?
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"
#include "source/pixel_lists.hpp"

namespace gnomon::render {
namespace {

class Irregular : public testing::Test {
 protected:
  void SetUp() override { (void)shared_context(); }
};

FrameOptions mask_only() {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  return options;
}

PlanOptions plan_options(const char* warp, int cascades, int size = 256) {
  PlanOptions options;
  options.resolution.max_size = size;
  options.cascades = cascades;
  options.warp.warp = find_warp(warp);
  set_margin(default_settings(filters::hard), options);
  return options;
}

/// What rays find, and how the mask differs from it.
struct Judged {
  std::size_t lit = 0, shadow = 0, undecided = 0, wrong = 0;
};

/// A scene with a view, and the truth of it.
struct Stage {
  Scene scene;
  Camera camera;
  Light light;
  Renderer renderer;
  PreparedFilter irregular;
  std::vector<Box> boxes;
  std::vector<trace::Verdict> truth;

  Stage(Scene of, const Camera& from, const Light& by)
      : scene(std::move(of)),
        camera(from),
        light(by),
        renderer(scene),
        irregular(renderer.prepare(filters::hard, Source::irregular())) {
    boxes = boxes_of(scene);
    renderer.draw(ShadowPlan{}, camera, irregular, mask_only());
    const trace::Tracer tracer(scene);
    truth = trace::hard_reference(
                tracer,
                trace::surface_points(tracer, camera, light, renderer.positions(), renderer.normals()), light)
                .pixels;
  }
  ShadowPlan plan(const PlanOptions& options) const {
    return make_plan(camera, light, {boxes, boxes}, options);
  }
  Judged judged(const ShadowPlan& plan) {
    EXPECT_TRUE(renderer.draw(plan, camera, irregular, mask_only()).irregular);
    const FloatImage mask = renderer.mask();
    Judged result;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const bool is_lit = mask.values[2 * i] > 0.5f;
      result.undecided += truth[i] == trace::Verdict::undecided;
      result.lit += truth[i] == trace::Verdict::lit;
      result.shadow += truth[i] == trace::Verdict::shadow;
      result.wrong +=
          (truth[i] == trace::Verdict::lit && !is_lit) || (truth[i] == trace::Verdict::shadow && is_lit);
    }
    return result;
  }
};

TEST(LightFrames, the_axis_of_a_warped_map_is_at_less_than_a_right_angle_to_all_of_its_rays) {
  std::mt19937 random(5);
  const auto any = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int warped = 0;
  for (int i = 0; i < 400; ++i) {
    const Camera camera = perspective_camera({any(-5, 5), 4.0, any(-5, 5)}, {any(-1, 1), any(-1, 0), 1.0},
                                             {0, 1, 0}, any(0.5, 1.5), 1.0, 0.5, 30.0, 100, 100);
    const SpotLight light{
        {any(-3, 3), any(0.5, 5), any(0, 8)}, {any(-1, 1), any(-1, 0), any(-1, 1)}, 1.047, 10.0};
    const std::array<Box, 2> boxes{{{{-10, 0, -12}, {10, 0, 12}}, {{any(-3, 0), any(1, 3), -1}, {1, 6, 1}}}};
    for (const Warp* warp : all_warps()) {
      const ShadowPlan plan =
          make_plan(camera, light, {boxes, boxes}, plan_options(std::string(warp->name).c_str(), 1));
      const LightFrames frames = light_frames(plan, camera, 30.0);
      for (std::size_t m = 0; m < plan.maps().size(); ++m) {
        warped += plan.map[m].kappa != 0.0 ? 1 : 0;
        const glm::dmat4 world_from_clip = glm::inverse(plan.map[m].clip_from_world);
        for (const glm::dvec2& corner :
             {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
          const glm::dvec4 end = world_from_clip * glm::dvec4(corner, 0.5, 1.0);
          const glm::dvec3 ray = glm::normalize(glm::dvec3(end) / end.w - light.position);
          EXPECT_GT(glm::dot(glm::dvec3(frames.row[3 * m + 2]), ray), 0.0) << i << " " << warp->name;
        }
      }
    }
  }
  EXPECT_GT(warped, 300);
}

TEST_F(Irregular, box_casts_the_shadow_that_geometry_says) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, plan_options("none", 1, 64));
  renderer.draw(plan, camera, renderer.prepare(filters::hard, Source::irregular()), mask_only());
  const Frame frame{camera, plan, renderer.mask(), renderer.positions(), renderer.normals()};
  // Points are rounded: those that a box a little smaller or larger decides differently are left out.
  const glm::dvec3 rounding(1e-4), low(kBoxMin), high(kBoxMax);
  std::size_t shadow = 0, lit = 0, wrong = 0;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || glm::dot(frame.normal(i), kSlant) > -0.1) continue;
    const glm::dvec3 from = frame.point(i) + 2.0 * rounding * frame.normal(i);
    const bool dark = hits_box(from, -kSlant, low + rounding, high - rounding);
    if (dark != hits_box(from, -kSlant, low - rounding, high + rounding)) continue;
    ++(dark ? shadow : lit);
    wrong += dark == (frame.lit(i) > 0.5f);
  }
  EXPECT_GT(shadow, 300u);
  EXPECT_GT(lit, 5000u);
  EXPECT_EQ(wrong, 0u);
}

TEST_F(Irregular, agrees_with_rays_on_all_built_in_scenes_under_all_lights) {
  constexpr int kWidth = 96, kHeight = 54;
  std::size_t shadow = 0;
  for (const BuiltinScene& builtin : builtin_scenes()) {
    Scene scene = load_builtin(builtin.name);
    const Camera camera = default_path(scene).at(0.5, kWidth, kHeight);
    const Box bounds = scene.bounds_world;
    for (const LightKind kind : {LightKind::sun, LightKind::spot, LightKind::point}) {
      Stage stage(scene, camera, default_light({.kind = kind}, bounds));
      for (const char* warp : {"none", "optimal"}) {
        for (const int cascades : {1, 4}) {
          if (kind != LightKind::sun && cascades > 1) continue;  // the faces of a cube, whatever is requested
          SCOPED_TRACE(std::string(builtin.name) + " " + std::string(to_string(kind)) + " " + warp + " " +
                       std::to_string(cascades));
          const Judged judged = stage.judged(stage.plan(plan_options(warp, cascades)));
          EXPECT_EQ(judged.wrong, 0u);
          EXPECT_GT(judged.lit + judged.shadow, 100u);
          EXPECT_LT(judged.undecided, 100u);
          shadow += judged.shadow;
        }
      }
    }
  }
  EXPECT_GT(shadow, 10'000u);
}

/// How far a mask is from the mean over facets, on pixels that an edge crosses.
struct EdgeError {
  double mean = 0.0;
  std::size_t pixels = 0, whole_wrong = 0;  ///< wholly lit or dark ones that the mask has otherwise
};
EdgeError edge_error(const trace::SoftReference& ideal, const FloatImage& mask) {
  constexpr float kWhole = 0.002f;
  EdgeError error;
  for (std::size_t i = 0; i < ideal.pixels.size(); ++i) {
    const float truth = ideal.pixels[i], drawn = mask.values[2 * i];
    if (truth < 0.0f) continue;
    if (truth <= kWhole || truth >= 1.0f - kWhole) {
      error.whole_wrong += std::abs(drawn - truth) > 0.5f;
      continue;
    }
    error.mean += std::abs(static_cast<double>(drawn) - static_cast<double>(truth));
    ++error.pixels;
  }
  error.mean /= static_cast<double>(std::max<std::size_t>(error.pixels, 1));
  return error;
}

TEST_F(Irregular, samples_over_facets_come_as_close_to_the_ideal_filter_as_they_are_many) {
  constexpr int kIdealSamples = 512;
  for (const char* name : {"fence", "trees"}) {
    Scene scene = load_builtin(name);
    const Camera camera = default_path(scene).at(0.5, 80, 45);
    const Box bounds = scene.bounds_world;
    for (const LightKind kind : {LightKind::sun, LightKind::point}) {
      SCOPED_TRACE(std::string(name) + " " + std::string(to_string(kind)));
      Stage stage(scene, camera, default_light({.kind = kind}, bounds));
      const trace::Tracer tracer(stage.scene);
      const trace::SurfacePoints points = trace::surface_points(
          tracer, camera, stage.light, stage.renderer.positions(), stage.renderer.normals());
      const trace::SoftReference ideal = trace::filtered_reference(
          tracer, points, stage.light, trace::KernelShape::box,
          [&](std::size_t pixel) { return trace::facet_axes(camera, points.pixels[pixel]); }, kIdealSamples);
      const ShadowPlan plan = stage.plan(plan_options("optimal", 1));
      double before = 1.0;
      for (const int samples : {1, 8, 16, 32}) {
        stage.renderer.draw(plan, camera, stage.renderer.prepare(filters::hard, Source::irregular(samples)),
                            mask_only());
        const EdgeError error = edge_error(ideal, stage.renderer.mask());
        ASSERT_GT(error.pixels, 30u);
        EXPECT_LT(error.mean, samples == 1 ? 0.5 : 1.0 / samples) << samples;
        EXPECT_LT(error.mean, before) << samples;
        EXPECT_LE(error.whole_wrong, 2u) << samples;
        before = error.mean;
      }
    }
  }
}

/// Ground, and triangles of all sizes over it: slivers, specks, some that reach behind the camera and past
/// the light.
Scene soup(unsigned seed) {
  Scene scene = empty_scene();
  add_quad(scene, {-40, 0, 40}, {80, 0, 0}, {0, 0, -80});
  std::mt19937 random(seed);
  const auto any = [&random](double low, double high) {
    return std::uniform_real_distribution<float>(static_cast<float>(low), static_cast<float>(high))(random);
  };
  for (int i = 0; i < 120; ++i) {
    const glm::vec3 at(any(-20, 20), any(0.2, 8), any(-20, 20));
    const float size = std::exp(any(std::log(0.02), std::log(20.0)));
    const float thin = i % 3 == 0 ? 0.001f : 1.0f;
    const glm::vec3 along(any(-1, 1), any(-0.3, 0.3), any(-1, 1)), across(any(-1, 1), any(-1, 1), any(-1, 1));
    add_mesh(scene, {at, at + size * along, at + size * thin * across});
  }
  return scene;
}

TEST_F(Irregular, slivers_specks_and_huge_triangles_are_exact_under_every_light) {
  std::size_t shadow = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Camera camera =
        perspective_camera({1.0, 1.7, 12.0}, {0.1, -0.15, -1.0}, {0, 1, 0}, 1.1, 1.0, 0.05, 200.0, 128, 128);
    const std::vector<Light> lights{DirectionalLight{kSlant}, DirectionalLight{{0.0, -1.0, 0.0}},
                                    DirectionalLight{{0.1, -0.2, -1.0}}, PointLight{{0.5, 6.0, 1.0}, 60.0},
                                    SpotLight{{-6.0, 9.0, 4.0}, {0.5, -0.8, -0.3}, 0.9, 60.0}};
    for (std::size_t l = 0; l < lights.size(); ++l) {
      Stage stage(soup(seed), camera, lights[l]);
      for (const char* warp : {"none", "optimal"}) {
        for (const int size : {16, 512}) {
          SCOPED_TRACE("seed " + std::to_string(seed) + " light " + std::to_string(l) + " " + warp + " " +
                       std::to_string(size));
          const ShadowPlan plan = stage.plan(plan_options(warp, 1, size));
          ASSERT_EQ(plan.status, PlanStatus::ok);
          const Judged judged = stage.judged(plan);
          EXPECT_EQ(judged.wrong, 0u);
          EXPECT_GT(judged.lit, 300u);
          shadow += judged.shadow;
        }
      }
    }
  }
  EXPECT_GT(shadow, 20'000u);
}

TEST_F(Irregular, a_corner_far_away_takes_no_shadow_from_what_is_near) {
  const Camera camera = camera_on_box(kSize, kSize);
  const std::vector<Light> lights{DirectionalLight{kSlant}, PointLight{{0.5, 6.0, 1.0}, 60.0}};
  std::vector<std::size_t> shadow;
  for (const float far : {0.0f, 1e6f, 1e9f}) {
    for (const Light& light : lights) {
      SCOPED_TRACE(far);
      Scene scene = box_on_ground();
      // A step that is lower than what coordinates of the far corner, in the same mesh, are rounded by.
      std::vector<glm::vec3> step = box_triangles({1.5f, 0, 1}, {2.5f, 0.02f, 3});
      if (far > 0.0f) step.insert(step.end(), {{far, 0, 0}, {far, 1, 0}, {far, 0, 1}});
      add_mesh(scene, step);
      Stage stage(std::move(scene), camera, light);
      const Judged judged = stage.judged(stage.plan(plan_options("none", 1, 128)));
      EXPECT_EQ(judged.wrong, 0u);
      shadow.push_back(judged.shadow);
    }
  }
  for (std::size_t i = 0; i < shadow.size(); ++i)
    EXPECT_NEAR(static_cast<double>(shadow[i]), static_cast<double>(shadow[i % lights.size()]), 3.0) << i;
  EXPECT_GT(shadow[0] + shadow[1], 600u);
}

TEST_F(Irregular, alpha_masks_are_cut_where_their_image_says_at_every_wrap) {
  for (const TextureWrap wrap :
       {TextureWrap::repeat, TextureWrap::mirrored_repeat, TextureWrap::clamp_to_edge}) {
    SCOPED_TRACE(static_cast<int>(wrap));
    Scene scene = empty_scene();
    // 5 x 3 texels of all opacities: no power of two, no symmetry.
    Image image{"mask", 5, 3, {}};
    for (int i = 0; i < 15; ++i)
      image.rgba.insert(image.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>((i * 97 + 30) % 256)});
    scene.images.push_back(image);
    Material material;
    material.base_color_image = 0;
    material.alpha_mode = AlphaMode::mask;
    material.alpha_cutoff = 0.4f;
    material.double_sided = true;
    material.wrap_u = material.wrap_v = wrap;
    const int masked = add_material(scene, material);
    add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
    add_quad(scene, {-3, 2.5f, 3}, {6, 0.3f, 0}, {0, 0.2f, -6}, masked);
    // Coordinates from -0.7 to 1.6, so that every kind of wrap is read.
    for (glm::vec2& uv : scene.texcoords) uv = uv * 2.3f - 0.7f;
    Stage stage(std::move(scene), camera_on_box(kSize, kSize), DirectionalLight{kSlant});
    const Judged judged = stage.judged(stage.plan(plan_options("none", 1, 128)));
    EXPECT_EQ(judged.wrong, 0u);
    EXPECT_GT(judged.shadow, 300u);
    EXPECT_GT(judged.lit, 3000u);
  }
}

TEST_F(Irregular, lists_hold_each_pixel_once_and_warps_even_them_out) {
  Scene scene = load_builtin("city");
  const Box bounds = scene.bounds_world;
  const Camera camera = default_path(scene).at(0.5, 160, 90);
  Stage stage(std::move(scene), camera, default_light({}, bounds));
  std::vector<std::uint32_t> longest;
  std::vector<std::size_t> listed;
  for (const char* warp : {"none", "optimal"}) {
    (void)stage.judged(stage.plan(plan_options(warp, 1)));
    const std::vector<std::uint32_t> lengths = stage.renderer.list_lengths();
    ASSERT_FALSE(lengths.empty());
    std::size_t sum = 0;
    for (const std::uint32_t length : lengths) sum += length;
    listed.push_back(sum);
    longest.push_back(*std::max_element(lengths.begin(), lengths.end()));
  }
  EXPECT_EQ(listed[0], listed[1]);
  const auto decided =
      static_cast<std::size_t>(std::count_if(stage.truth.begin(), stage.truth.end(), [](auto v) {
        return v == trace::Verdict::lit || v == trace::Verdict::shadow;
      }));
  EXPECT_GE(listed[0], decided);
  EXPECT_LE(listed[0], stage.truth.size());
  EXPECT_LT(4 * longest[1], longest[0]);
}

TEST_F(Irregular, frames_before_and_after_keep_their_maps) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  const ShadowPlan plan = plan_for(scene, camera, kSlant, plan_options("none", 2));
  const PreparedFilter pcf = renderer.prepare(filters::pcf),
                       exact = renderer.prepare(filters::hard, Source::irregular());
  renderer.draw(plan, camera, pcf, mask_only());
  const FloatImage before = renderer.mask();
  renderer.draw(plan, camera, exact, mask_only());
  const FloatImage between = renderer.mask();
  EXPECT_NE(between.values, before.values);
  renderer.draw(plan, camera, pcf, mask_only());
  EXPECT_EQ(renderer.mask().values, before.values);
  renderer.draw(plan, camera, exact, mask_only());
  EXPECT_EQ(renderer.mask().values, between.values);
}

TEST_F(Irregular, a_plan_without_maps_leaves_everything_lit) {
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  renderer.draw(ShadowPlan{}, camera, renderer.prepare(filters::hard, Source::irregular()), mask_only());
  for (std::size_t i = 0; i < 64u * 64u; ++i) ASSERT_EQ(renderer.mask().values[2 * i], 1.0f) << i;
  EXPECT_TRUE(renderer.list_lengths().empty());
}

TEST_F(Irregular, a_frame_beyond_the_drivers_buffers_is_known_before_it_is_drawn) {
  const PixelLists lists;
  EXPECT_TRUE(lists.fits(1920, 1080, 1));
  EXPECT_FALSE(lists.fits(1 << 16, 1 << 16, 1));  // 2^32 pixels: more than an entry can name
  EXPECT_FALSE(lists.fits(1 << 13, 1 << 13, 64));
}

}  // namespace
}  // namespace gnomon::render
