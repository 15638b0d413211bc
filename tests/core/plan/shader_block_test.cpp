// The block of numbers for shaders: the layout that GLSL has, and one look-up whatever clip space a plan was
// made for.
#include "gnomon/shader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <glm/matrix.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon {
namespace {

Camera camera() {
  return perspective_camera({1e5, 2, 10}, {0.1, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, 600, 400);
}

const std::array<Box, 2> kBoxes{
    {{{1e5 - 9, 0, -40}, {1e5 + 9, 1, 8}}, {{1e5 - 2, 1, -20}, {1e5 + 2, 6, -10}}}};

ShadowPlan plan_in(const ClipSpace& space, const Light& light) {
  PlanOptions options;
  options.clip_space = space;
  return make_plan(camera(), light, {kBoxes, kBoxes}, options);
}

std::vector<ClipSpace> clip_spaces() {
  std::vector<ClipSpace> all;
  for (const NdcDepth depth : {NdcDepth::minus_one_to_one, NdcDepth::zero_to_one}) {
    for (const bool reversed : {false, true}) {
      for (const bool down : {false, true}) {
        for (const FirstRow row : {FirstRow::y_minus_one, FirstRow::y_plus_one}) {
          all.push_back({depth, reversed, down, Handedness::right, row});
        }
      }
    }
  }
  return all;
}

/// Text of the sample's shader with its block declared by `declaration`.
std::string sample_shader(const std::string& declaration) {
  std::ifstream in(std::string(GNOMON_SOURCE_DIR) + "/samples/engine_setup/shadow.frag");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string own = "layout(std140, binding = 0) uniform Shadows";
  const std::size_t at = text.find(own);
  if (at != std::string::npos) text.replace(at, own.size(), declaration);
  return text;
}

/// What glslangValidator says of where the block's members lie.
std::string reflection(const std::string& shader) {
  const std::string file = testing::TempDir() + "shader_block_test.frag";
  std::ofstream(file) << shader;
  const std::string command = std::string(GLSLANG_VALIDATOR) + " -l -q -I" + GNOMON_SOURCE_DIR +
                              "/shaders -I" + GNOMON_GENERATED_SHADERS + " -S frag " + file + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 256> part{};
  while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  if (pipe != nullptr) ::pclose(pipe);
  return text;
}

TEST(ShaderBlock, has_the_layout_of_the_glsl_under_std140_and_std430) {
  if (std::string(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator is not installed";
  for (const char* declaration : {"layout(std140, binding = 0) uniform Shadows",
                                  "layout(std430, binding = 0) readonly buffer Shadows"}) {
    std::istringstream lines(reflection(sample_shader(declaration)));
    std::size_t members = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("Shadows: ")) {
        EXPECT_NE(line.find("size " + std::to_string(sizeof(ShaderBlock)) + ","), std::string::npos) << line;
      }
      if (!line.starts_with("shadows.")) continue;
      const std::string name = line.substr(8, line.find(':') - 8);
      const auto* field = std::find_if(kShaderFields.begin(), kShaderFields.end(),
                                       [&](const ShaderField& each) { return each.name == name; });
      ASSERT_NE(field, kShaderFields.end()) << line;
      EXPECT_NE(line.find(": offset " + std::to_string(field->offset) + ","), std::string::npos) << line;
      if (name.starts_with("maps.")) {
        EXPECT_NE(line.find("topLevelArrayStride " + std::to_string(sizeof(ShaderMap))), std::string::npos)
            << line;
      }
      ++members;
    }
    EXPECT_EQ(members, kShaderFields.size()) << declaration;
  }
}

TEST(ShaderBlock, looks_up_the_texel_and_the_depth_that_the_plan_drew_in_every_clip_space) {
  const std::array<Light, 2> lights{
      {DirectionalLight{{0.3, -1, -0.4}}, SpotLight{{1e5, 12, -5}, {0.1, -1, -0.3}, 0.7, 60.0}}};
  for (const Light& light : lights) {
    for (const ClipSpace& space : clip_spaces()) {
      const ShadowPlan plan = plan_in(space, light);
      ASSERT_GT(plan.map_count, 0);
      const ShaderBlock block = shader_block(plan);
      EXPECT_EQ(block.layer.z, static_cast<float>(plan.map_count));
      for (std::size_t i = 0; i < plan.maps().size(); ++i) {
        const ShadowMap& map = plan.map[i];
        for (const glm::dvec3 point : {glm::dvec3(1e5, 0.5, -15), glm::dvec3(1e5 + 1, 3, -12)}) {
          const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
          const glm::dvec4 texture = texture_from_clip(space) * clip;
          const double stored = texture.z / texture.w;  // what a depth buffer would hold
          const glm::vec4 h =
              block.maps[i].clip_from_point * glm::vec4(glm::vec3(point - plan.origin_world), 1.0f);
          EXPECT_NEAR(h.x / h.w * 0.5 + 0.5, texture.x / texture.w, 1e-4);
          EXPECT_NEAR(h.y / h.w * 0.5 + 0.5, texture.y / texture.w, 1e-4);
          EXPECT_NEAR(h.z / h.w, space.reversed_z ? 1.0 - stored : stored, 1e-4);
          // Nearer to the light is less deep, whatever the plan's clip space.
          const glm::dvec3 to_light = map.light_world.w == 0.0
                                          ? glm::dvec3(map.light_world)
                                          : glm::normalize(glm::dvec3(map.light_world) - point);
          const glm::vec4 nearer = block.maps[i].clip_from_point *
                                   glm::vec4(glm::vec3(point + to_light - plan.origin_world), 1.0f);
          EXPECT_LT(nearer.z / nearer.w, h.z / h.w);
        }
      }
    }
  }
}

TEST(ShaderBlock, gives_every_clip_space_the_same_depths_and_curves) {
  const Light spot = SpotLight{{1e5, 12, -5}, {0.1, -1, -0.3}, 0.7, 60.0};
  const ShaderBlock expected = shader_block(plan_in(kOpenGl, spot));
  EXPECT_GT(expected.maps[0].kernel.w, 0.0f);  // perspective leaves depths uneven
  EXPECT_EQ(expected.light.w, 1.0f);
  EXPECT_NEAR(expected.light.y, 10.0, 1e-3);  // relative to the camera
  for (const ClipSpace& space : clip_spaces()) {
    const ShaderBlock block = shader_block(plan_in(space, spot));
    EXPECT_NEAR(block.maps[0].kernel.w, expected.maps[0].kernel.w, 1e-3 * expected.maps[0].kernel.w);
  }
  EXPECT_EQ(shader_block(plan_in(kOpenGl, DirectionalLight{{0, -1, 0.2}})).maps[0].kernel.w, 0.0f);
}

TEST(ShaderBlock, of_a_plan_without_maps_has_none) {
  const ShaderBlock block = shader_block(ShadowPlan{});
  EXPECT_EQ(block.layer, glm::vec4(0.0f));
}

}  // namespace
}  // namespace gnomon
