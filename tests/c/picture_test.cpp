// The pixels that a plan is expected to get wrong, and the shadow's edges: the same from C as from C++, and
// refusals by name.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "gnomon/pages.hpp"
#include "gnomon/study/expected_error.hpp"
#include "in_c.hpp"

namespace gnomon::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 240, kHeight = 160;

/// A street's floor with stripes of shadow, on both sides. Not to be copied: it points into itself.
struct Street {
  std::vector<Box> boxes{{{-40, -1, -200}, {40, 0, 20}}, {{-4, 0, -30}, {4, 6, -26}}};
  Camera camera =
      perspective_camera({0, 3, 10}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 250.0, kWidth, kHeight);
  DirectionalLight sun{{0.4, -1, 0.3}};
  std::vector<glm::dvec3> points;  ///< of the floor, as the pixels show them; beyond the horizon the eye
  std::vector<float> mask, depths, distances;
  gnomon_camera camera_in_c = in_c(camera);
  gnomon_shadow_picture picture{};
  PlanInC found;

  Street() {
    const CameraAxes axes = camera_axes(camera);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec3 ray =
            axes.forward + axes.right * (camera.left + (camera.right - camera.left) * (x + 0.5) / kWidth) +
            axes.up * (camera.top + (camera.bottom - camera.top) * (y + 0.5) / kHeight);
        const double depth = ray.y < 0.0 ? -camera.position.y / ray.y : 0.0;
        const glm::dvec3 at = camera.position + ray * depth;
        points.push_back(at);
        depths.push_back(static_cast<float>(depth));
        mask.push_back(std::sin(at.x + 0.4 * at.z) > 0.3 ? 1.0f : 0.0f);
        distances.push_back(static_cast<float>(0.5 + 0.5 * std::sin(at.z)));
      }
    }
    gnomon_shadow_picture_default(&picture, sizeof picture);
    picture.camera = &camera_in_c;
    picture.mask = mask.data();
    picture.view_depths = depths.data();
    picture.pixel_count = kWidth * kHeight;
  }
  Street(const Street&) = delete;
  Street& operator=(const Street&) = delete;

  [[nodiscard]] ShadowPicture shadow() const {
    return {camera, mask, depths,
            picture.occluder_distances == nullptr ? std::span<const float>() : distances};
  }
  /// The plan on both sides.
  ShadowPlan plan(const PlanOptions& options) {
    const InputInC in(camera, sun, boxes, boxes, options);
    EXPECT_EQ(gnomon_make_plan(&in.view, &in.light, &in.scene, &in.options, nullptr, &found.plan, nullptr),
              GNOMON_OK);
    return make_plan(camera, sun, {boxes, boxes}, options);
  }
};

void expect_same(const Street& street, const ShadowPlan& plan) {
  gnomon_wrong_pixels pixels;
  ASSERT_EQ(gnomon_expected_error(&street.found.plan, &street.picture, &pixels, nullptr), GNOMON_OK);
  const ExpectedError expected = expected_error(plan, street.shadow(), street.picture.kernel_texels);
  EXPECT_EQ(std::memcmp(&pixels.wrong, &expected.wrong_pixels, sizeof(double)), 0);
  EXPECT_EQ(pixels.counted, expected.counted_pixels);
  EXPECT_EQ(pixels.share, expected.share());
  EXPECT_GT(pixels.wrong, 0.0);
}

TEST(PictureInC, plans_are_expected_to_get_the_pixels_of_cpp_wrong) {
  Street street;
  for (const Fit fit : {Fit::tight, Fit::stable, Fit::warped_stable}) {
    for (const MapSelection selection : {MapSelection::view_depth, MapSelection::finest}) {
      PlanOptions options;
      options.fit = fit;
      options.split.selection = selection;
      options.resolution.max_size = 128;
      options.clip_space = kVulkan;
      expect_same(street, street.plan(options));
    }
  }
  // Kernels.
  const ShadowPlan plan = street.plan({});
  const double hard = expected_error(plan, street.shadow()).wrong_pixels;
  for (const double kernel : {1.5, 4.0}) {
    street.picture.kernel_texels = kernel;
    expect_same(street, plan);
    EXPECT_NE(expected_error(plan, street.shadow(), kernel).wrong_pixels, hard) << kernel;
  }
  for (const double kernel : {-1.0, std::numeric_limits<double>::quiet_NaN(), 0.0}) {
    street.picture.kernel_texels = kernel;
    expect_same(street, plan);
    EXPECT_EQ(expected_error(plan, street.shadow(), kernel).wrong_pixels, hard) << kernel;
  }
  // Errors of the bias.
  street.picture.occluder_distances = street.distances.data();
  for (const double kernel : {0.0, 1.5}) {
    street.picture.kernel_texels = kernel;
    expect_same(street, plan);
  }
  EXPECT_GT(expected_error(plan, street.shadow()).wrong_pixels, 1.01 * hard);
  // Pixels of all kinds, drawn by lot.
  std::mt19937_64 random(4);
  for (int i = 0; i < 4000; ++i) {
    const float odd[] = {-1.0f, kNan, 0.5f, 7.0f, 0.0f, 1.0f, std::numeric_limits<float>::infinity()};
    street.mask[random() % street.mask.size()] = odd[random() % 7];
    street.depths[random() % street.depths.size()] = odd[random() % 7];
    street.distances[random() % street.distances.size()] = odd[random() % 7];
  }
  expect_same(street, street.plan({}));
}

/// A roof of slats, as each side searches it.
struct Slats {
  glm::dvec3 way = glm::normalize(glm::dvec3(0.4, -1, 0.3));
  mutable int searches = 0;

  [[nodiscard]] double distance(const glm::dvec3& point) const {
    ++searches;
    const double up = (6.0 - point.y) / -way.y;
    const glm::dvec3 at = point - way * up;
    return std::sin(at.x + 0.4 * at.z) > 0.3 ? -std::numeric_limits<double>::infinity() : up;
  }
  static double from_c(const void* slats, const double point[3]) {
    return static_cast<const Slats*>(slats)->distance({point[0], point[1], point[2]});
  }
  [[nodiscard]] OccluderSearch from_cpp() const {
    return {[](const void* slats, const glm::dvec3& point) noexcept {
              return static_cast<const Slats*>(slats)->distance(point);
            },
            this};
  }
};

/// The street in the shadow of the slats, and a plan of it.
struct SlattedStreet : Street {
  Slats slats;
  ShadowPlan own;

  SlattedStreet() {
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = slats.distance(points[i]) > 0.0 ? 0.0f : 1.0f;
    picture.occluder_search = Slats::from_c;
    picture.occluder_scene = &slats;
    PlanOptions options;
    options.resolution.max_size = 256;
    own = plan(options);
  }
  /// Of the plan in C.
  [[nodiscard]] gnomon_wrong_pixels expected() const {
    gnomon_wrong_pixels pixels{};
    EXPECT_EQ(gnomon_expected_error(&found.plan, &picture, &pixels, nullptr), GNOMON_OK);
    return pixels;
  }
};

TEST(PictureInC, a_search_gives_the_pixels_of_cpp) {
  SlattedStreet street;
  // Leaning, as the floor does not; a third of them not known, some broken.
  std::vector<glm::vec3> normals(street.mask.size(), glm::vec3(0.0f, 0.8f, 0.6f));
  for (std::size_t i = 0; i < normals.size(); i += 3) normals[i] = glm::vec3(i % 2 == 0 ? 0.0f : kNan);
  double last = -1.0;
  for (const double kernel : {0.0, 1.5, 4.0}) {
    for (const bool facing : {false, true}) {
      street.picture.kernel_texels = kernel;
      street.picture.normals = facing ? &normals[0].x : nullptr;
      ShadowPicture shadow = street.shadow();
      shadow.occluders = street.slats.from_cpp();
      if (facing) shadow.normals_world = normals;
      const ExpectedError expected = expected_error(street.own, shadow, kernel);
      street.slats.searches = 0;
      const gnomon_wrong_pixels pixels = street.expected();
      EXPECT_GT(street.slats.searches, 1000);
      EXPECT_EQ(std::memcmp(&pixels.wrong, &expected.wrong_pixels, sizeof(double)), 0) << kernel;
      EXPECT_EQ(pixels.counted, expected.counted_pixels);
      EXPECT_GT(pixels.wrong, 0.0);
      EXPECT_NE(pixels.wrong, last) << "the kernel or the normals are not passed";
      last = pixels.wrong;
    }
  }
  // What the picture alone shows is something else, and distances change nothing beside a search.
  street.picture.kernel_texels = 0.0;
  street.picture.normals = nullptr;
  const gnomon_wrong_pixels searched = street.expected();
  street.picture.occluder_distances = street.distances.data();
  const gnomon_wrong_pixels beside = street.expected();
  EXPECT_EQ(std::memcmp(&searched, &beside, sizeof beside), 0);
  street.picture.occluder_search = nullptr;
  EXPECT_NE(street.expected().wrong, searched.wrong);
}

TEST(PictureInC, a_search_takes_the_light_of_foreign_maps_from_their_matrices) {
  SlattedStreet street;
  const double own = street.expected().wrong;
  for (gnomon_map& map : street.found.maps) {
    gnomon_map other;
    gnomon_map_default(&other, sizeof other);
    std::memcpy(map.light_world, other.light_world, sizeof other.light_world);
  }
  EXPECT_GT(own, 100.0);
  EXPECT_NEAR(street.expected().wrong, own, 0.01 * own);
}

TEST(PictureInC, a_search_that_finds_nonsense_gives_a_share) {
  SlattedStreet street;
  std::mt19937_64 random(12);
  street.picture.occluder_scene = &random;
  street.picture.occluder_search = [](const void* scene, const double*) {
    auto& bits = *static_cast<std::mt19937_64*>(const_cast<void*>(scene));
    return std::bit_cast<double>(bits());
  };
  for (const double kernel : {0.0, 2.0}) {
    street.picture.kernel_texels = kernel;
    const double share = street.expected().share;
    EXPECT_TRUE(share > 0.1 && share < 1.0) << share;
  }
}

TEST(PictureInC, pages_are_expected_to_get_the_pixels_of_cpp_wrong) {
  SlattedStreet street;
  PageOptions options;
  options.capacity = 64;
  options.target_m = 8.0;
  // Of what receives light or shadow: beyond the horizon there is nothing.
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < street.points.size(); i += 7)
    if (street.depths[i] > 0.0f) points.push_back(street.points[i]);
  std::vector<std::byte> memory(page_memory(options.capacity, points.size()));
  const View view{.camera = street.camera, .points_world = points};
  const PagePlan plan = plan_pages(view, street.sun, {street.boxes, street.boxes}, options, memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);

  InputInC in(street.camera, street.sun, street.boxes, street.boxes, options.plan);
  in.view.points = &points[0].x;
  in.view.point_count = static_cast<int64_t>(points.size());
  gnomon_page_options in_c_options;
  gnomon_page_options_default(&in_c_options, sizeof in_c_options);
  in_c_options.plan = &in.options;
  in_c_options.capacity = options.capacity;
  in_c_options.target_m = options.target_m;
  const int64_t bytes = gnomon_page_memory(options.capacity, in.view.point_count);
  std::vector<std::byte> in_c_memory(static_cast<std::size_t>(bytes));
  gnomon_page_plan pages;
  gnomon_page_plan_default(&pages, sizeof pages);
  ASSERT_EQ(gnomon_plan_pages(&in.view, &in.light, &in.scene, &in_c_options, nullptr, in_c_memory.data(),
                              bytes, &pages, nullptr),
            GNOMON_OK);

  gnomon_wrong_pixels pixels{};
  ASSERT_EQ(gnomon_expected_page_error(&pages, &street.picture, &pixels, nullptr), GNOMON_OK);
  ShadowPicture shadow = street.shadow();
  shadow.occluders = street.slats.from_cpp();
  const ExpectedError expected = expected_error(plan, shadow);
  EXPECT_EQ(std::memcmp(&pixels.wrong, &expected.wrong_pixels, sizeof(double)), 0);
  EXPECT_EQ(pixels.counted, expected.counted_pixels);
  EXPECT_TRUE(pixels.share > 0.0 && pixels.share < 1.0) << pixels.share;

  const char* field = nullptr;
  EXPECT_EQ(gnomon_expected_page_error(&pages, nullptr, &pixels, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "shadow_picture");
  EXPECT_EQ(gnomon_expected_page_error(nullptr, &street.picture, &pixels, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "page_plan");
  EXPECT_EQ(gnomon_expected_page_error(&pages, &street.picture, nullptr, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "pixels");
}

TEST(PictureInC, a_plan_without_maps_gets_all_that_is_dark_wrong) {
  const Street street;
  gnomon_plan none;
  gnomon_plan_default(&none, sizeof none);
  gnomon_wrong_pixels pixels;
  ASSERT_EQ(gnomon_expected_error(&none, &street.picture, &pixels, nullptr), GNOMON_OK);
  double dark = 0.0;
  for (std::size_t i = 0; i < street.mask.size(); ++i)
    dark += street.mask[i] == 0.0f && street.depths[i] > 0.0f ? 1.0 : 0.0;
  EXPECT_EQ(pixels.wrong, dark);
  EXPECT_GT(dark, 1000.0);
}

TEST(PictureInC, edges_are_those_of_cpp) {
  const Street street;
  for (const std::size_t room : {std::size_t{0}, std::size_t{10}, std::size_t{5000}}) {
    std::vector<glm::dvec3> points(room), expected(room);
    int64_t written = -1;
    ASSERT_EQ(gnomon_shadow_edge_points(&street.picture, reinterpret_cast<double*>(points.data()),
                                        static_cast<int64_t>(room), &written, nullptr),
              GNOMON_OK);
    EXPECT_EQ(written, static_cast<int64_t>(shadow_edge_points(street.shadow(), expected)));
    EXPECT_EQ(points, expected);
    EXPECT_GE(written, static_cast<int64_t>(std::min(room, std::size_t{1000})));
  }
}

TEST(PictureInC, what_is_refused_is_named) {
  Street street;
  street.plan({});
  gnomon_wrong_pixels pixels{-7.0, -7.0, -7.0};
  double points[3];
  int64_t written = -7;
  const auto refuses = [&](const char* expected, auto change, auto restore) {
    change();
    const char* field = nullptr;
    EXPECT_EQ(gnomon_expected_error(&street.found.plan, &street.picture, &pixels, &field),
              GNOMON_INVALID_INPUT)
        << expected;
    EXPECT_STREQ(field, expected);
    field = nullptr;
    EXPECT_EQ(gnomon_shadow_edge_points(&street.picture, points, 1, &written, &field), GNOMON_INVALID_INPUT)
        << expected;
    EXPECT_STREQ(field, expected);
    restore();
  };
  gnomon_shadow_picture& picture = street.picture;
  gnomon_camera& camera = street.camera_in_c;
  refuses(
      "shadow_picture.size", [&] { picture.size += 8; }, [&] { picture.size -= 8; });
  refuses(
      "shadow_picture.size", [&] { picture.size = 0; }, [&] { picture.size = sizeof picture; });
  refuses(
      "camera", [&] { picture.camera = nullptr; }, [&] { picture.camera = &camera; });
  refuses(
      "camera.size", [&] { camera.size = 3; }, [&] { camera.size = sizeof camera; });
  refuses(
      "camera.position", [&] { camera.position[0] = static_cast<double>(kNan); },
      [&] { camera.position[0] = 0.0; });
  refuses(
      "camera.width, camera.height", [&] { camera.width = -1; }, [&] { camera.width = kWidth; });
  refuses(
      "shadow_picture.mask", [&] { picture.mask = nullptr; }, [&] { picture.mask = street.mask.data(); });
  refuses(
      "shadow_picture.view_depths", [&] { picture.view_depths = nullptr; },
      [&] { picture.view_depths = street.depths.data(); });
  for (const int64_t count : {int64_t{0}, int64_t{-1}, int64_t{kWidth}, int64_t{kWidth * kHeight + 1},
                              std::numeric_limits<int64_t>::max()})
    refuses(
        "shadow_picture.pixel_count", [&] { picture.pixel_count = count; },
        [&] { picture.pixel_count = kWidth * kHeight; });
  // As large as a camera may be: refused before a pixel is read.
  refuses(
      "shadow_picture.pixel_count", [&] { camera.width = camera.height = 1 << 20; },
      [&] { camera.width = kWidth, camera.height = kHeight; });
  EXPECT_EQ(pixels.wrong, -7.0);
  EXPECT_EQ(written, -7);

  const char* field = nullptr;
  const auto named = [&](int32_t status, const char* expected) {
    EXPECT_EQ(status, GNOMON_INVALID_INPUT) << expected;
    EXPECT_STREQ(field, expected);
  };
  gnomon_plan* const plan = &street.found.plan;
  named(gnomon_expected_error(nullptr, &picture, &pixels, &field), "plan");
  named(gnomon_expected_error(plan, nullptr, &pixels, &field), "shadow_picture");
  named(gnomon_expected_error(plan, &picture, nullptr, &field), "pixels");
  named(gnomon_shadow_edge_points(nullptr, points, 1, &written, &field), "shadow_picture");
  named(gnomon_shadow_edge_points(&picture, nullptr, 1, &written, &field), "points");
  named(gnomon_shadow_edge_points(&picture, points, -1, &written, &field), "room");
  named(gnomon_shadow_edge_points(&picture, points, 1, nullptr, &field), "written");
  street.found.maps[0].clip_from_world[3] = static_cast<double>(kNan);
  named(gnomon_expected_error(plan, &picture, &pixels, &field), "map.clip_from_world");
}

TEST(PictureInC, random_maps_and_pixels_give_a_share) {
  Street street;
  street.picture.occluder_distances = street.distances.data();
  std::mt19937_64 random(11);
  for (int i = 0; i < 300; ++i) {
    street.plan({});
    auto* const matrix = street.found.maps[0].clip_from_world;
    for (int k = 0; k < 3; ++k) {
      const double odd[] = {0.0, 1e100, -1e-300, 1.0, 1e30, 3e-5};
      matrix[random() % 16] = odd[random() % 6];
    }
    for (int k = 0; k < 200; ++k) {
      const auto bits = static_cast<std::uint32_t>(random());
      street.depths[random() % street.depths.size()] = std::bit_cast<float>(bits);
      street.distances[random() % street.distances.size()] = std::bit_cast<float>(~bits);
    }
    gnomon_wrong_pixels pixels;
    ASSERT_EQ(gnomon_expected_error(&street.found.plan, &street.picture, &pixels, nullptr), GNOMON_OK);
    ASSERT_TRUE(std::isfinite(pixels.wrong) && pixels.wrong >= 0.0) << i;
    ASSERT_LE(pixels.share, 1.0) << i;
  }
}

}  // namespace
}  // namespace gnomon::test
