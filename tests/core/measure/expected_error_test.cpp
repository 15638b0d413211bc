// Are the pixels that a plan is expected to get wrong those that its texels do get wrong?
#include "gnomon/study/expected_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::test {
namespace {

constexpr int kWidth = 400, kHeight = 400;

/// A floor under the camera, half in the shadow of an edge through its middle, and the sun straight above.
struct Floor {
  Camera camera;
  std::vector<float> mask, depths, occluder_distances;
  Light sun = DirectionalLight{{0.0, -1.0, 0.0}};
  std::vector<Box> boxes = {{{-50, -0.5, -50}, {50, 0, 50}}};
  PlanOptions options;

  /// `turned`: the angle of the edge with the image's rows, radians.
  explicit Floor(Camera from, double turned) : camera(from) {
    options.cascades = 1;
    options.warp.warp = &warps::none;
    options.resolution.max_size = 64;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec3 point = hit(x, y);
        const double depth = glm::dot(camera_axes(camera).forward, point - camera.position);
        const bool floor = depth > 0.0 && std::abs(point.x) < 50.0 && std::abs(point.z) < 50.0;
        depths.push_back(floor ? static_cast<float>(depth) : 0.0f);
        mask.push_back(is_lit(point, turned) ? 1.0f : 0.0f);
      }
    }
  }
  /// Distance from the edge, below 0 in the shadow.
  [[nodiscard]] static double from_edge(const glm::dvec3& point, double turned) {
    return std::sin(turned) * (point.x - 0.017) - std::cos(turned) * (point.z + 0.023);
  }
  [[nodiscard]] static bool is_lit(const glm::dvec3& point, double turned) {
    return from_edge(point, turned) > 0.0;
  }
  /// Where the pixel's ray meets the floor's plane.
  [[nodiscard]] glm::dvec3 hit(int x, int y) const {
    const CameraAxes axes = camera_axes(camera);
    const double right = camera.left + (camera.right - camera.left) * (x + 0.5) / kWidth,
                 up = camera.top + (camera.bottom - camera.top) * (y + 0.5) / kHeight;
    const glm::dvec3 aside = axes.right * right + axes.up * up;
    const glm::dvec3 ray = axes.forward + (camera.orthographic ? glm::dvec3(0.0) : aside);
    const glm::dvec3 from = camera.position + (camera.orthographic ? aside : glm::dvec3(0.0));
    return from - ray * (from.y / ray.y);
  }
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, sun, {boxes, boxes}, options); }
  [[nodiscard]] ShadowPicture picture() const { return {camera, mask, depths, occluder_distances}; }
};

/// The camera looks down, its image turned by half a radian against the map.
Camera from_above() {
  return orthographic_camera({0, 10, 0}, {0, -1, 0}, {std::sin(0.5), 0.0, -std::cos(0.5)}, 10.0, 1.6, 1.0,
                             20.0, kWidth, kHeight);
}

TEST(ExpectedError, is_a_texels_mean_distance_from_its_middle_times_the_length_of_the_edge) {
  for (const double turned : {0.2, 0.9, 1.5, 2.4}) {
    const Floor floor(from_above(), turned);
    const ShadowPlan plan = floor.plan();
    ASSERT_EQ(plan.maps().size(), 1u);
    const PointAliasing at = measure_point(plan.maps()[0], floor.camera, glm::dvec3(0.0), {0, 1, 0});
    ASSERT_EQ(at.status, PointAliasing::Status::ok);
    ASSERT_GT(at.m_max, 3.0);
    ASSERT_NEAR(at.m_max, at.m_min, 0.02 * at.m_max);  // square texels
    // The edge meets the image's border; its length is counted by the rows and columns that it crosses.
    double across_rows = 0.0, across_columns = 0.0;
    for (int y = 0; y + 1 < kHeight; ++y) {
      for (int x = 0; x + 1 < kWidth; ++x) {
        const auto i = static_cast<std::size_t>(y * kWidth + x);
        across_rows += floor.mask[i] != floor.mask[i + 1] ? 1.0 : 0.0;
        across_columns += floor.mask[i] != floor.mask[i + kWidth] ? 1.0 : 0.0;
      }
    }
    const double length = std::hypot(across_rows, across_columns);
    const ExpectedError expected = expected_error(plan, floor.picture());
    EXPECT_EQ(expected.counted_pixels, kWidth * kHeight);
    // 0.25 along the map's axes, 0.236 along its diagonals.
    EXPECT_NEAR(expected.wrong_pixels, 0.243 * length * at.m_max, 0.15 * 0.243 * length * at.m_max) << turned;
  }
}

/// Whether the floor is lit where the light through a place in the map meets it. What lies less than this
/// behind the edge is.
bool lit_under(const glm::dmat4& world_from_clip, double ndc_x, double ndc_y, double turned,
               double lit_behind_edge) {
  glm::dvec3 ends[2];
  for (int end = 0; end < 2; ++end) {
    const glm::dvec4 at = world_from_clip * glm::dvec4(ndc_x, ndc_y, end - 0.5, 1.0);
    ends[end] = glm::dvec3(at) / at.w;
  }
  const glm::dvec3 point = ends[0] + (ends[1] - ends[0]) * (-ends[0].y / (ends[1].y - ends[0].y));
  return Floor::from_edge(point, turned) > -lit_behind_edge;
}

/// Pixels whose exact shadow is another in the middle of their texel, in double precision. With a kernel, on
/// the other side of one half of the mean over a box of texels. `map_of`: the map that serves a point.
template <class MapOf>
double wrong_by(const Floor& floor, const MapOf& map_of, double turned, double kernel_texels = 0.0,
                double lit_behind_edge = 0.0) {
  double wrong = 0.0;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    if (floor.depths[pixel] == 0.0f || floor.mask[pixel] < 0.0f) continue;
    const glm::dvec3 point = floor.hit(i % kWidth, i / kWidth);
    const ShadowMap map = map_of(point);
    const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
    const double x = (clip.x / clip.w + 1.0) * 0.5 * map.width,
                 y = (clip.y / clip.w + 1.0) * 0.5 * map.height;
    const auto part = [&](double texel, double at) {
      const double low = at - kernel_texels, high = at + kernel_texels;
      return kernel_texels > 0.0 ? std::min(high, texel + 1.0) - std::max(low, texel) : 1.0;
    };
    double mean = 0.0, weights = 0.0;
    for (double row = std::floor(y - kernel_texels); row <= y + kernel_texels; row += 1.0) {
      for (double column = std::floor(x - kernel_texels); column <= x + kernel_texels; column += 1.0) {
        const double weight = part(column, x) * part(row, y);
        const bool lit = lit_under(world_from_clip, (column + 0.5) * 2.0 / map.width - 1.0,
                                   (row + 0.5) * 2.0 / map.height - 1.0, turned, lit_behind_edge);
        mean += lit ? weight : 0.0;
        weights += weight;
      }
    }
    wrong += (mean > 0.5 * weights) != (floor.mask[pixel] > 0.5f) ? 1.0 : 0.0;
  }
  return wrong;
}

double wrong_by_texels(const Floor& floor, const ShadowMap& map, double turned, double kernel_texels = 0.0,
                       double lit_behind_edge = 0.0) {
  return wrong_by(
      floor, [&](const glm::dvec3&) -> const ShadowMap& { return map; }, turned, kernel_texels,
      lit_behind_edge);
}

TEST(ExpectedError, counts_the_pixels_that_texels_of_the_exact_shadow_get_wrong) {
  const Camera camera =
      perspective_camera({0, 3, 12}, {0, -0.4, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 100.0, kWidth, kHeight);
  for (const Warp* warp : {&warps::none, &warps::lispsm}) {
    for (const int size : {64, 256}) {
      double wrong = 0.0, expected = 0.0;
      for (const double turned : {0.15, 0.6, 1.1, 1.9, 2.7}) {
        Floor floor(camera, turned);
        floor.options.warp.warp = warp;
        floor.options.resolution.max_size = size;
        const ShadowPlan plan = floor.plan();
        ASSERT_EQ(plan.maps().size(), 1u);
        wrong += wrong_by_texels(floor, plan.maps()[0], turned);
        expected += expected_error(plan, floor.picture()).wrong_pixels;
      }
      EXPECT_GT(wrong, 300.0);
      EXPECT_NEAR(expected, wrong, 0.15 * wrong) << warp->name << ' ' << size;
    }
  }
}

/// A page plan of all that a floor's picture shows, and its memory.
struct FloorPages {
  std::vector<glm::dvec3> points;
  std::vector<std::byte> memory;
  PagePlan plan;

  FloorPages(const Floor& floor, double target_m, Fit fit) {
    PageOptions pages;
    pages.plan = floor.options;
    pages.plan.fit = fit;
    pages.target_m = target_m;
    pages.page_texels = 64;
    pages.fallback = true;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      if (floor.depths[static_cast<std::size_t>(i)] > 0.0f)
        points.push_back(floor.hit(i % kWidth, i / kWidth));
    }
    memory.resize(page_memory(pages.capacity, points.size()));
    plan = plan_pages({.camera = floor.camera, .points_world = points}, floor.sun, {floor.boxes, floor.boxes},
                      pages, memory);
  }
};

/// The same floor, and a roof that stops the light above all that is dark.
struct Roofed : Floor {
  double turned;

  Roofed(Camera from, double edge) : Floor(from, edge), turned(edge) {}
  [[nodiscard]] OccluderSearch search() const noexcept {
    return {[](const void* scene, const glm::dvec3& point) noexcept {
              return (is_lit(point, static_cast<const Roofed*>(scene)->turned) ? 0.0 : 5.0) - point.y;
            },
            this};
  }
  [[nodiscard]] ShadowPicture traced() const {
    ShadowPicture shadow = picture();
    shadow.occluders = search();
    return shadow;
  }
};

TEST(ExpectedError, with_what_a_search_finds_is_what_the_texels_get_wrong_to_the_pixel) {
  const Camera camera =
      perspective_camera({0, 3, 12}, {0, -0.4, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 100.0, kWidth, kHeight);
  for (const Warp* warp : {&warps::none, &warps::lispsm}) {
    const double turned = warp == &warps::none ? 0.15 : 1.1;
    Roofed floor(camera, turned);
    floor.options.warp.warp = warp;
    const ShadowPlan plan = floor.plan();
    for (const double kernel : {0.0, 1.5}) {
      const double wrong = wrong_by_texels(floor, plan.maps()[0], turned, kernel);
      EXPECT_GT(wrong, 50.0);
      // Places on an edge round either way.
      const ExpectedError expected = expected_error(plan, floor.traced(), kernel);
      EXPECT_NEAR(expected.wrong_pixels, wrong, 3.0) << warp->name << ' ' << kernel;
      EXPECT_EQ(expected.counted_pixels, expected_error(plan, floor.picture()).counted_pixels);
      const std::vector<glm::vec3> up(floor.mask.size(), glm::vec3(0, 1, 0)), none(up.size());
      ShadowPicture given = floor.traced();
      given.normals_world = up;
      EXPECT_NEAR(expected_error(plan, given, kernel).wrong_pixels, wrong, 3.0);
      given.normals_world = none;
      EXPECT_EQ(expected_error(plan, given, kernel).wrong_pixels, expected.wrong_pixels);
    }
  }
}

TEST(ExpectedError, with_a_search_sees_what_the_picture_does_not) {
  // The picture shows none of the shadow: a caster narrower than a pixel, or middles that are hidden.
  Roofed floor(from_above(), 0.9);
  const ShadowPlan plan = floor.plan();
  double dark = 0.0;
  for (float& lit : floor.mask) {
    dark += lit < 0.5f ? 1.0 : 0.0;
    lit = 1.0f;
  }
  EXPECT_LT(expected_error(plan, floor.picture()).wrong_pixels, 1e-9);
  EXPECT_NEAR(expected_error(plan, floor.traced()).wrong_pixels, dark, 0.05 * dark);
  ShadowPicture broken = floor.traced();
  const std::vector<glm::vec3> few(floor.mask.size() - 1, glm::vec3(0, 1, 0));
  broken.normals_world = few;
  EXPECT_EQ(expected_error(plan, broken).counted_pixels, 0.0);
}

TEST(ExpectedError, counts_the_pixels_that_texels_of_pages_get_wrong) {
  const Camera camera =
      perspective_camera({0, 3, 12}, {0, -0.4, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 100.0, kWidth, kHeight);
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    double last = 0.0;
    for (const double target_m : {2.0, 6.0}) {
      double wrong = 0.0, expected = 0.0;
      for (const double turned : {0.15, 1.1}) {
        const Floor floor(camera, turned);
        const FloorPages pages(floor, target_m, fit);
        ASSERT_EQ(pages.plan.status, PlanStatus::ok);
        ASSERT_GT(pages.plan.levels.size(), 2u);
        wrong += wrong_by(
            floor,
            [&](const glm::dvec3& point) {
              const int page = page_serving(pages.plan, point);
              EXPECT_GE(page, 0);
              return page_map(pages.plan, pages.plan.pages[static_cast<std::size_t>(std::max(page, 0))]);
            },
            turned);
        expected += expected_error(pages.plan, floor.picture()).wrong_pixels;
      }
      EXPECT_GT(wrong, 100.0);
      EXPECT_NEAR(expected, wrong, 0.15 * wrong) << target_m;
      EXPECT_GT(expected, 1.8 * last) << "a target three times as coarse";
      last = expected;
    }
  }
}

TEST(ExpectedError, pages_of_one_level_err_as_one_map_of_its_texels) {
  const Floor floor(from_above(), 0.6);
  const FloorPages pages(floor, 1e6, Fit::tight);
  ASSERT_EQ(pages.plan.levels.size(), 1u);
  ShadowPlan whole = floor.plan();
  ASSERT_EQ(whole.map_count, 1);
  whole.map[0] = pages.plan.levels[0];
  for (const double kernel : {0.0, 1.5}) {
    const double wrong = expected_error(pages.plan, floor.picture(), kernel).wrong_pixels;
    EXPECT_GT(wrong, 10.0);
    EXPECT_EQ(wrong, expected_error(whole, floor.picture(), kernel).wrong_pixels);
  }
}

TEST(ExpectedError, some_pixels_stand_for_all_evenly) {
  // Edges along rows, along columns and aslant: other pixels of each cell, so that none is missed.
  for (const double turned : {0.0, 0.7, 1.5707963}) {
    const Camera upright =
        orthographic_camera({0.4, 10, 0.4}, {0, -1, 0}, {0, 0, -1}, 10.0, 1.6, 1.0, 20.0, kWidth, kHeight);
    const Floor floor(upright, turned);
    const ShadowPlan plan = floor.plan();
    for (const double kernel : {0.0, 1.5}) {
      const ExpectedError all = expected_error(plan, floor.picture(), kernel);
      ASSERT_GT(all.wrong_pixels, 50.0);
      for (const int every : {2, 3, 4}) {
        const ExpectedError some = expected_error(plan, floor.picture(), kernel, every);
        EXPECT_NEAR(some.counted_pixels, all.counted_pixels, 0.02 * all.counted_pixels) << every;
        EXPECT_NEAR(some.wrong_pixels, all.wrong_pixels, 0.25 * all.wrong_pixels) << every << ' ' << turned;
        EXPECT_NE(some.wrong_pixels, all.wrong_pixels);
      }
      EXPECT_EQ(expected_error(plan, floor.picture(), kernel, 0).wrong_pixels, all.wrong_pixels);
      EXPECT_EQ(expected_error(plan, floor.picture(), kernel, -7).wrong_pixels, all.wrong_pixels);
      EXPECT_LE(expected_error(plan, floor.picture(), kernel, 1 << 30).counted_pixels, 4096.0 * 4096.0);
    }
  }
}

TEST(ExpectedError, points_without_a_page_are_lit) {
  const Floor floor(from_above(), 0.6);
  const double dark = static_cast<double>(std::count(floor.mask.begin(), floor.mask.end(), 0.0f));
  EXPECT_EQ(expected_error(PagePlan{}, floor.picture()).wrong_pixels, dark);
}

TEST(ExpectedError, averages_over_texels_are_right_more_often_along_an_edge) {
  const Camera camera =
      perspective_camera({0, 3, 12}, {0, -0.4, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 100.0, kWidth, kHeight);
  for (const double kernel : {0.5, 1.5}) {
    double hard = 0.0, wrong = 0.0, expected_hard = 0.0, expected = 0.0;
    for (const double turned : {0.15, 1.1}) {
      Floor floor(camera, turned);
      floor.options.resolution.max_size = 128;
      const ShadowPlan plan = floor.plan();
      ASSERT_EQ(plan.maps().size(), 1u);
      hard += wrong_by_texels(floor, plan.maps()[0], turned);
      wrong += wrong_by_texels(floor, plan.maps()[0], turned, kernel);
      expected_hard += expected_error(plan, floor.picture()).wrong_pixels;
      expected += expected_error(plan, floor.picture(), kernel).wrong_pixels;
    }
    // Half of what hard comparison gets wrong counts.
    EXPECT_LT(wrong, 0.8 * hard) << kernel;
    EXPECT_NEAR(expected, 0.5 * (hard + wrong), 0.15 * hard) << kernel;
  }
}

/// An endless wall stands on the edge, and the sun comes over it from the lit side at 45 degrees. The
/// occluder of a dark point is the wall.
struct WallsFoot : Floor {
  explicit WallsFoot(double turned) : Floor(from_above(), turned) {
    options.resolution.max_size = 128;
    options.bias.slope_texels = 2.0;
    sun = DirectionalLight{{-std::sin(turned), -1.0, std::cos(turned)}};
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const double behind = -from_edge(hit(i % kWidth, i / kWidth), turned);
      occluder_distances.push_back(behind >= 0.0 ? static_cast<float>(behind * std::sqrt(2.0)) : -1.0f);
    }
  }
  /// Way behind the edge up to which the bias is longer than the way along the light to the wall.
  [[nodiscard]] double lit_behind_edge(const ShadowPlan& plan) const {
    const ShadowMap& map = plan.maps()[0];
    const glm::dvec3 light = glm::normalize(std::get<DirectionalLight>(sun).direction);
    const Receiver receiver{map.clip_from_world, map.texels(), light, glm::dvec3(0.0), {0, 1, 0}};
    const glm::dvec2 texel = texel_extent_world(map.clip_from_world, map.texels(), light, glm::dvec3(0.0));
    // At 45 degrees an offset along the normal is as long along the light as it has texels.
    return (plane_bias_world(plan.bias, receiver, 0.0) +
            plan.bias.normal_offset_texels * std::max(texel.x, texel.y)) /
           std::sqrt(2.0);
  }
};

TEST(ExpectedError, counts_the_light_that_the_bias_lets_in_at_a_walls_foot) {
  for (const double kernel : {0.0, 1.5}) {
    double by_texels = 0.0, wrong = 0.0, expected = 0.0, without = 0.0;
    for (const double turned : {0.15, 1.1}) {
      WallsFoot foot(turned);
      const ShadowPlan plan = foot.plan();
      ASSERT_EQ(plan.maps().size(), 1u);
      const double strip = foot.lit_behind_edge(plan);
      by_texels += wrong_by_texels(foot, plan.maps()[0], turned, 0.0, strip);
      wrong += wrong_by_texels(foot, plan.maps()[0], turned, kernel, strip);
      expected += expected_error(plan, foot.picture(), kernel).wrong_pixels;
      foot.occluder_distances.clear();
      without += expected_error(plan, foot.picture(), kernel).wrong_pixels;
    }
    EXPECT_GT(wrong, 500.0);
    EXPECT_NEAR(expected, 0.5 * (by_texels + wrong), 0.1 * wrong) << kernel;
    EXPECT_LT(without, 0.8 * expected) << kernel;
  }
}

TEST(ExpectedError, a_middle_that_the_wall_hides_is_lit_where_its_pixel_is) {
  double wrong = 0.0, expected = 0.0;
  for (const double turned : {0.15, 0.6, 1.1, 1.9, 2.7}) {
    WallsFoot foot(turned);
    const ShadowPlan plan = foot.plan();
    const double strip = foot.lit_behind_edge(plan);
    // The lit side is behind the wall, which shows its dark side in its place.
    for (std::size_t i = 0; i < foot.mask.size(); ++i) {
      if (foot.mask[i] < 0.5f) continue;
      foot.mask[i] = -1.0f;
      foot.depths[i] *= 0.5f;
    }
    wrong += wrong_by_texels(foot, plan.maps()[0], turned, 0.0, strip);
    expected += expected_error(plan, foot.picture()).wrong_pixels;
  }
  EXPECT_GT(wrong, 1000.0);
  EXPECT_NEAR(expected, wrong, 0.1 * wrong);
}

TEST(ExpectedError, a_plate_closer_than_the_bias_casts_no_shadow) {
  Floor floor(from_above(), 0.9);
  const ShadowPlan plan = floor.plan();
  const double dark = static_cast<double>(std::count(floor.mask.begin(), floor.mask.end(), 0.0f));
  const double edges = expected_error(plan, floor.picture()).wrong_pixels;
  const ShadowMap& map = plan.maps()[0];
  // Light straight down on a level floor: the constant part is all there is.
  const glm::dvec2 texel = texel_extent_world(map.clip_from_world, map.texels(), {0, -1, 0}, glm::dvec3(0.0));
  const double bias = plan.bias.constant_texels * std::max(texel.x, texel.y);
  const auto wrong_at = [&](double distance) {
    floor.occluder_distances.assign(floor.mask.size(), static_cast<float>(distance));
    for (std::size_t i = 0; i < floor.mask.size(); ++i)
      if (floor.mask[i] > 0.5f) floor.occluder_distances[i] = -1.0f;
    return expected_error(plan, floor.picture()).wrong_pixels;
  };
  EXPECT_NEAR(wrong_at(0.99 * bias), dark, 1e-3 * dark);
  EXPECT_NEAR(wrong_at(0.0), dark, 1e-3 * dark);
  EXPECT_EQ(wrong_at(1.01 * bias), edges);
  // Not known anywhere is as not given.
  EXPECT_EQ(wrong_at(-1.0), edges);
  EXPECT_EQ(wrong_at(std::numeric_limits<double>::quiet_NaN()), edges);
  floor.occluder_distances.pop_back();
  EXPECT_EQ(expected_error(plan, floor.picture()).counted_pixels, 0.0);
}

TEST(ExpectedError, without_a_shadow_a_surface_or_a_map_nothing_or_all_of_the_shadow_is_wrong) {
  Floor floor(from_above(), 0.9);
  const ShadowPlan plan = floor.plan();
  std::size_t dark = 0;
  for (const float lit : floor.mask) dark += lit < 0.5f ? 1 : 0;
  EXPECT_EQ(expected_error(ShadowPlan{}, floor.picture()).wrong_pixels, static_cast<double>(dark));
  Floor lit = floor, empty = floor, uncounted = floor, broken = floor;
  for (float& value : lit.mask) value = 1.0f;
  EXPECT_LT(expected_error(plan, lit.picture()).wrong_pixels, 1e-9);
  for (float& depth : empty.depths) depth = 0.0f;
  EXPECT_EQ(expected_error(plan, empty.picture()).counted_pixels, 0.0);
  EXPECT_EQ(expected_error(plan, empty.picture()).share(), 0.0);
  for (float& value : uncounted.mask) value = -1.0f;
  EXPECT_EQ(expected_error(plan, uncounted.picture()).counted_pixels, 0.0);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < broken.mask.size(); i += 3) {
    broken.mask[i] = kNan;
    broken.depths[i + 1 < broken.mask.size() ? i + 1 : i] =
        i % 2 == 0 ? kNan : std::numeric_limits<float>::infinity();
  }
  const ExpectedError of_broken = expected_error(plan, broken.picture());
  EXPECT_TRUE(std::isfinite(of_broken.wrong_pixels));
  EXPECT_LE(of_broken.wrong_pixels, of_broken.counted_pixels);
  // Sizes that are not the image's, and images without a pixel.
  Floor cut = floor;
  cut.mask.pop_back();
  EXPECT_EQ(expected_error(plan, cut.picture()).counted_pixels, 0.0);
  cut.camera.width = cut.camera.height = 0;
  EXPECT_EQ(expected_error(plan, cut.picture()).counted_pixels, 0.0);
}

TEST(ExpectedError, edge_points_lie_on_the_edge_and_lower_the_expected_error_of_their_plan) {
  const Camera camera =
      perspective_camera({0, 3, 12}, {0, -0.4, -1}, {0, 1, 0}, 0.9, 1.0, 0.5, 100.0, kWidth, kHeight);
  // All of the edge is twelve units away: texels elsewhere serve nobody.
  Floor floor(camera, 0.3);
  floor.options.warp.warp = &warps::optimal;
  floor.options.resolution.max_size = 128;
  std::vector<glm::dvec3> points(4000);
  points.resize(shadow_edge_points(floor.picture(), points));
  ASSERT_GT(points.size(), 100u);
  const double pixel_world = (camera.right - camera.left) / kWidth * 60.0;
  for (const glm::dvec3& point : points) {
    EXPECT_NEAR(point.y, 0.0, 1e-4);
    EXPECT_LT(std::abs(std::sin(0.3) * (point.x - 0.017) - std::cos(0.3) * (point.z + 0.023)), pixel_world);
  }
  std::vector<glm::dvec3> few(10);
  EXPECT_EQ(shadow_edge_points(floor.picture(), few), 10u);
  EXPECT_EQ(few.front(), points.front());
  EXPECT_EQ(few[5], points[(5 * points.size() + 9) / 10]);  // evenly
  const ShadowPlan by_boxes = floor.plan();
  const ShadowPlan by_edges = make_plan({.camera = camera, .points_world = points}, floor.sun,
                                        {floor.boxes, floor.boxes}, floor.options);
  EXPECT_LT(expected_error(by_edges, floor.picture()).wrong_pixels,
            0.9 * expected_error(by_boxes, floor.picture()).wrong_pixels);
  EXPECT_EQ(shadow_edge_points(floor.picture(), {}), 0u);
}

}  // namespace
}  // namespace gnomon::test
