// Is every broken contract refused by name, and every legal extreme accepted?
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/finite.hpp"

namespace gnomon::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Input {
  Camera camera = perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 200, 640, 480);
  Light light = DirectionalLight{{0.2, -1, 0.1}};
  std::vector<Box> casters = {{{-30, 0, -30}, {30, 5, -1}}}, receivers = {{{-30, -1, -30}, {30, 0, -1}}};
  PlanOptions options;
  VisibleDepths depths;
  const VisibleDepths* visible = nullptr;
  void give_splits(const std::vector<double>& inner) {
    options.split.scheme = SplitScheme::given;
    options.split.given = SplitOptions::endless_splits();
    std::copy(inner.begin(), inner.end(), options.split.given.begin());
  }
  void see(double min, double max) {
    depths.min = min;
    depths.max = max;
    visible = &depths;
  }
  [[nodiscard]] ShadowPlan plan() const {
    return make_plan({camera, visible}, light, {casters, receivers}, options);
  }
};

using Break = std::function<void(Input&)>;

TEST(PlanInput, sound_input_is_accepted) {
  const ShadowPlan plan = Input{}.plan();
  EXPECT_EQ(plan.status, PlanStatus::ok);
  EXPECT_TRUE(plan.invalid_field.empty());
}

TEST(PlanInput, every_broken_field_is_named) {
  const std::vector<std::pair<std::string, Break>> breaks = {
      {"camera.position", [](Input& i) { i.camera.position.x = kNan; }},
      {"camera.position", [](Input& i) { i.camera.position.z = -kInfinity; }},
      {"camera.forward", [](Input& i) { i.camera.forward = glm::dvec3(0.0); }},
      {"camera.forward", [](Input& i) { i.camera.forward.y = kNan; }},
      {"camera.up", [](Input& i) { i.camera.up.y = kInfinity; }},
      {"camera.left", [](Input& i) { i.camera.left = i.camera.right; }},
      {"camera.right", [](Input& i) { i.camera.right = kNan; }},
      {"options.split.partition", [](Input& i) { i.options.split.partition = Partition{5}; }},
      {"options.split.scheme", [](Input& i) { i.options.split.scheme = SplitScheme{7}; }},
      {"options.split.range", [](Input& i) { i.options.split.range = SplitRange{3}; }},
      {"options.split.selection", [](Input& i) { i.options.split.selection = MapSelection{3}; }},
      {"options.split.selection", [](Input& i) { i.options.split.selection = MapSelection::first_holding; }},
      {"options.fit", [](Input& i) { i.options.fit = Fit{4}; }},
      {"options.warp.objective", [](Input& i) { i.options.warp.objective = Objective{4}; }},
      {"options.clip_space.ndc_depth", [](Input& i) { i.options.clip_space.ndc_depth = NdcDepth{2}; }},
      {"options.clip_space.handedness", [](Input& i) { i.options.clip_space.handedness = Handedness{2}; }},
      {"options.clip_space.first_row", [](Input& i) { i.options.clip_space.first_row = FirstRow{2}; }},
      {"fov_y_radians",
       [](Input& i) {
         i.camera = perspective_camera({}, {0, 0, -1}, {0, 1, 0}, 60.0, 1.5, 0.5, 200, 64, 48);
       }},
      {"fov_y_radians",
       [](Input& i) {
         i.camera = perspective_camera({}, {0, 0, -1}, {0, 1, 0}, 45.0, 1.5, 0.5, 200, 64, 48);
       }},
      {"fov_y_radians",
       [](Input& i) {
         i.camera = perspective_camera({}, {0, 0, -1}, {0, 1, 0}, 0.0, 1.5, 0.5, 200, 64, 48);
       }},
      {"camera.bottom", [](Input& i) { i.camera.bottom = 2.0; }},
      {"camera.top", [](Input& i) { i.camera.top = kInfinity; }},
      {"camera.near_depth", [](Input& i) { i.camera.near_depth = 0.0; }},
      {"camera.near_depth", [](Input& i) { i.camera.near_depth = -1.0; }},
      {"camera.near_depth", [](Input& i) { i.camera.near_depth = kNan; }},
      {"camera.far_depth", [](Input& i) { i.camera.far_depth = i.camera.near_depth; }},
      {"camera.far_depth", [](Input& i) { i.camera.far_depth = -kInfinity; }},
      {"camera.width", [](Input& i) { i.camera.width = 0; }},
      {"camera.height", [](Input& i) { i.camera.height = -5; }},
      {"light.direction", [](Input& i) { i.light = DirectionalLight{glm::dvec3(0.0)}; }},
      {"light.direction",
       [](Input& i) {
         i.light = DirectionalLight{{0, kNan, 0}};
       }},
      {"light.position",
       [](Input& i) {
         i.light = SpotLight{{kNan, 0, 0}, {0, -1, 0}, 0.5, 10};
       }},
      {"light.direction",
       [](Input& i) {
         i.light = SpotLight{{0, 0, 0}, {0, 0, 0}, 0.5, 10};
       }},
      {"light.outer_radians",
       [](Input& i) {
         i.light = SpotLight{{0, 0, 0}, {0, -1, 0}, 3.2, 10};
       }},
      {"light.outer_radians",
       [](Input& i) {
         i.light = SpotLight{{0, 0, 0}, {0, -1, 0}, 0.0, 10};
       }},
      {"light.range",
       [](Input& i) {
         i.light = SpotLight{{0, 0, 0}, {0, -1, 0}, 0.5, 0.0};
       }},
      {"light.position",
       [](Input& i) {
         i.light = PointLight{{0, kInfinity, 0}, 10};
       }},
      {"light.range",
       [](Input& i) {
         i.light = PointLight{{0, 0, 0}, kNan};
       }},
      {"bounds.casters", [](Input& i) { i.casters[0].min.x = kNan; }},
      {"bounds.casters", [](Input& i) { i.casters[0].max.y = kInfinity; }},
      {"bounds.receivers", [](Input& i) { i.receivers[0].max.z = kNan; }},
      {"options.resolution.max_size", [](Input& i) { i.options.resolution.max_size = 3; }},
      {"options.resolution.max_size", [](Input& i) { i.options.resolution.max_size = 16385; }},
      {"options.cascades", [](Input& i) { i.options.cascades = 0; }},
      {"options.cascades", [](Input& i) { i.options.cascades = kMaxMaps + 1; }},
      {"options.split.lambda", [](Input& i) { i.options.split.lambda = 1.5; }},
      {"options.split.lambda", [](Input& i) { i.options.split.lambda = kNan; }},
      {"options.split.pseudo_near", [](Input& i) { i.options.split.pseudo_near = -1.0; }},
      {"options.resolution.max_error", [](Input& i) { i.options.resolution.max_error = -1.0; }},
      {"options.resolution.max_error", [](Input& i) { i.options.resolution.max_error = kNan; }},
      {"options.resolution.texel_budget", [](Input& i) { i.options.resolution.texel_budget = -1; }},
      {"options.resolution.texel_budget",
       [](Input& i) { i.options.resolution.texel_budget = 4 * 16 * 16 - 1; }},
      {"options.resolution.prune_error", [](Input& i) { i.options.resolution.prune_error = 0.0; }},
      {"options.resolution.prune_error", [](Input& i) { i.options.resolution.prune_error = kNan; }},
      {"options.resolution.prune_error", [](Input& i) { i.options.resolution.prune_error = 1e-320; }},
      {"options.split.overlap", [](Input& i) { i.options.split.overlap = -0.1; }},
      {"options.split.overlap", [](Input& i) { i.options.split.overlap = kNan; }},
      {"options.split.face_slices", [](Input& i) { i.options.split.face_slices = 0; }},
      {"options.split.face_slices", [](Input& i) { i.options.split.face_slices = kMaxMaps + 1; }},
      {"options.light_near_share", [](Input& i) { i.options.light_near_share = 0.0; }},
      {"options.light_near_share", [](Input& i) { i.options.light_near_share = 0.51; }},
      {"options.light_near_share", [](Input& i) { i.options.light_near_share = kNan; }},
      {"options.split.given", [](Input& i) { i.give_splits({}); }},
      {"options.split.given",
       [](Input& i) {
         i.give_splits({1, 2});
       }},
      {"options.split.given",
       [](Input& i) {
         i.give_splits({1, kNan, 3});
       }},
      {"options.split.given",
       [](Input& i) {
         i.give_splits({1, 3, 2});
       }},
      {"view.depths", [](Input& i) { i.see(-1.0, 5.0); }},
      {"view.depths", [](Input& i) { i.see(kNan, 5.0); }},
      {"view.depths", [](Input& i) { i.see(1.0, kInfinity); }},
      {"options.filter.texels", [](Input& i) { i.options.filter.texels = -0.5; }},
      {"options.filter.texels", [](Input& i) { i.options.filter.texels = 257.0; }},
      {"options.bias", [](Input& i) { i.options.bias.slope_texels = kNan; }},
      {"options.bias", [](Input& i) { i.options.bias.constant_texels = -1.0; }},
  };
  for (const auto& [field, spoil] : breaks) {
    Input input;
    spoil(input);
    const ShadowPlan plan = input.plan();
    EXPECT_EQ(plan.status, PlanStatus::invalid_input) << field;
    EXPECT_NE(plan.invalid_field.find(field), std::string_view::npos)
        << field << " came back as " << plan.invalid_field;
    EXPECT_EQ(plan.map_count, 0) << field;
  }
}

TEST(PlanInput, legal_extremes_are_planned) {
  const std::vector<std::pair<std::string, Break>> extremes = {
      {"a far plane ten million near planes away", [](Input& i) { i.camera.near_depth = 2e-5; }},
      {"hardly any depth", [](Input& i) { i.camera.near_depth = 10, i.camera.far_depth = 10 * (1 + 1e-9); }},
      {"a field of view near 180 degrees",
       [](Input& i) { i.camera.left = i.camera.bottom = -60, i.camera.right = i.camera.top = 60; }},
      {"no up", [](Input& i) { i.camera.up = glm::dvec3(0.0); }},
      {"up along the view", [](Input& i) { i.camera.up = i.camera.forward; }},
      {"one pixel", [](Input& i) { i.camera.width = i.camera.height = 1; }},
      {"the smallest map", [](Input& i) { i.options.resolution.max_size = 4, i.options.filter.texels = 1; }},
      {"the largest map", [](Input& i) { i.options.resolution.max_size = kMaxMapSize; }},
      {"the widest filter", [](Input& i) { i.options.filter.texels = 256; }},
      {"a hint beyond the far plane", [](Input& i) { i.options.split.pseudo_near = 1e6; }},
      {"a tiny light direction",
       [](Input& i) {
         i.light = DirectionalLight{{1e-200, -1e-200, 0}};
       }},
      {"empty boxes among the others", [](Input& i) { i.casters.push_back({}), i.receivers.push_back({}); }},
      {"the least budget", [](Input& i) { i.options.resolution.texel_budget = 4 * 16 * 16; }},
      {"a budget beyond the largest maps",
       [](Input& i) { i.options.resolution.texel_budget = std::int64_t{1} << 62; }},
      {"a target out of reach", [](Input& i) { i.options.resolution.max_error = 1e-300; }},
      {"the same split thrice",
       [](Input& i) {
         i.give_splits({7, 7, 7});
       }},
      {"splits beyond the camera's range",
       [](Input& i) {
         i.give_splits({-1e20, 1e20, 1e21});
       }},
      {"one visible depth", [](Input& i) { i.depths = visible_between(20, 20), i.see(20, 20); }},
      {"visible depths where no receiver is",
       [](Input& i) { i.depths = visible_between(1e7, 1e9), i.see(1e7, 1e9); }},
      {"the most cascades", [](Input& i) { i.options.cascades = kMaxMaps; }},
  };
  for (const auto& [name, change] : extremes) {
    for (const Fit fit : {Fit::tight, Fit::stable}) {
      Input input;
      input.options.fit = fit;
      change(input);
      const ShadowPlan plan = input.plan();
      EXPECT_EQ(plan.status, PlanStatus::ok) << name << ": " << plan.invalid_field;
      for (const ShadowMap& map : plan.maps()) {
        EXPECT_TRUE(std::isfinite(map.storage) && std::isfinite(map.texel_world.x) && map.texel_world.x > 0.0)
            << name;
        EXPECT_TRUE(all_finite(map.clip_from_world)) << name;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
