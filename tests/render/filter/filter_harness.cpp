// A shader that reads questions from an image and writes answers to another.
#include "filter_harness.hpp"

#include <array>
#include <random>
#include <string>

#include "program.hpp"
#include "target.hpp"

namespace gnomon::render {
namespace {

constexpr const char* kHead = R"(#version 450 core
#include <filter>
layout(binding = 0) uniform sampler2D questions;
layout(binding = 1) uniform sampler2D gradients;
layout(binding = 4) uniform sampler2DArrayShadow compare_map;
layout(binding = 5) uniform sampler2DArray map;
layout(location = 0) uniform float radius_texels;
layout(location = 0) out vec4 answer;
)";
constexpr const char* kAsk = R"(
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 q = texelFetch(questions, pixel, 0);
  vec2 size = vec2(textureSize(map, 0).xy);
  ShadowLookup at = ShadowLookup(q.xy, 1.0, q.z, texelFetch(gradients, pixel, 0).xy, size);
  answer = vec4(shadow_visibility(compare_map, map, at, ShadowParameters(radius_texels)));
}
)";
constexpr const char* kStore = R"(
void main() { answer = shadow_store(texelFetch(questions, ivec2(gl_FragCoord.xy), 0).z); }
)";

Texture row_of(const std::vector<std::array<float, 4>>& values) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, GL_RGBA32F, static_cast<GLsizei>(values.size()), 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, static_cast<GLsizei>(values.size()), 1, GL_RGBA, GL_FLOAT,
                      values.data());
  return texture;
}

std::vector<float> run(const Filter& filter, const char* main_text, float radius,
                       const std::vector<Question>& questions) {
  const Program program = make_program(compose_shader("fullscreen.vert"),
                                       compose_shader_text("filter_test.frag", std::string(kHead) + main_text,
                                                           "filter/" + std::string(filter.name) + ".glsl"));
  std::vector<std::array<float, 4>> points, gradients;
  for (const Question& q : questions) {
    points.push_back({q.position.x, q.position.y, q.depth, 0.0f});
    gradients.push_back({q.depth_gradient.x, q.depth_gradient.y, 0.0f, 0.0f});
  }
  const Texture question_image = row_of(points), gradient_image = row_of(gradients), answers = row_of(points);
  const Framebuffer fbo = make_framebuffer();
  const VertexArray none = make_vertex_array();
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT0, answers.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo.name());
  glViewport(0, 0, static_cast<GLsizei>(questions.size()), 1);
  glDisable(GL_DEPTH_TEST);
  glBindTextureUnit(0, question_image.name());
  glBindTextureUnit(1, gradient_image.name());
  glBindVertexArray(none.name());
  glUseProgram(program.name());
  glUniform1f(0, radius);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<float> out(questions.size());
  glGetTextureImage(answers.name(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(out.size() * sizeof(float)),
                    out.data());
  return out;
}

}  // namespace

TestMap random_map(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  TestMap map{width, height, {}};
  for (int i = 0; i < width * height; ++i) map.depth.push_back(static_cast<float>(random() % 257) / 256.0f);
  return map;
}

std::vector<Question> random_questions(const TestMap& map, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&random](int n) { return static_cast<float>(random() % static_cast<unsigned>(n)); };
  std::vector<Question> questions;
  for (int i = 0; i < count; ++i) {
    Question q;
    // Some way outside of the map too: there everything is lit.
    q.position = {below((map.width + 8) * 16) / 16.0f - 4.0f, below((map.height + 8) * 16) / 16.0f - 4.0f};
    q.depth = below(257) / 256.0f;
    q.depth_gradient = {(below(65) - 32.0f) / 1024.0f, (below(65) - 32.0f) / 1024.0f};
    questions.push_back(q);
  }
  return questions;
}

std::vector<float> ask_shader(const Filter& filter, const FilterParameters& parameters, const TestMap& map,
                              const std::vector<Question>& questions) {
  MapTargets targets;
  targets.fit(map.width, map.height, 2);
  glTextureSubImage3D(targets.depth.name(), 0, 0, 0, 1, map.width, map.height, 1, GL_DEPTH_COMPONENT,
                      GL_FLOAT, map.depth.data());
  for (const GLuint unit : {4u, 5u}) glBindTextureUnit(unit, targets.depth.name());
  glBindSampler(4, targets.compare_sampler.name());
  glBindSampler(5, targets.plain_sampler.name());
  return run(filter, kAsk, static_cast<float>(parameters.radius_texels), questions);
}

std::vector<double> ask_reference(const Filter& filter, const FilterParameters& parameters,
                                  const TestMap& map, const std::vector<Question>& questions) {
  std::vector<double> answers;
  for (const Question& q : questions) {
    FilterLookup lookup;
    lookup.texel = [&](int x, int y) {
      const bool inside = x >= 0 && y >= 0 && x < map.width && y < map.height;
      const double depth = inside ? map.depth[static_cast<std::size_t>(y * map.width + x)] : 1.0;
      return filter.store(depth, parameters);
    };
    lookup.position = q.position;
    lookup.depth = q.depth;
    lookup.depth_gradient = q.depth_gradient;
    answers.push_back(filter.visibility(lookup, parameters));
  }
  return answers;
}

std::vector<float> stored_by_shader(const Filter& filter, const std::vector<float>& depths) {
  std::vector<Question> questions;
  for (const float depth : depths) questions.push_back({{}, depth, {}});
  return run(filter, kStore, 0.0f, questions);
}

}  // namespace gnomon::render
