// A shader that reads questions from an image and writes answers to another.
#include "filter_harness.hpp"

#include <array>
#include <random>
#include <stdexcept>
#include <string>

#include "filter/stored_maps.hpp"
#include "frame/target.hpp"
#include "gl/program.hpp"

namespace gnomon::render {
namespace {

constexpr const char* kHead = R"(#version 450 core
#include "pass/common/filter.glsl"
#include <filter>
layout(binding = 0) uniform sampler2D questions;
layout(binding = 1) uniform sampler2D gradients;
layout(binding = 2) uniform sampler2D texels;
layout(binding = 4) uniform sampler2DArrayShadow compare_map;
layout(binding = 5) uniform sampler2DArray depth_map;
layout(binding = 7) uniform sampler2DArray depth_max;
layout(location = 0) uniform vec2 box;
layout(location = 0) out vec4 answer;

ShadowLookup question() {
  ivec2 pixel = ivec2(gl_FragCoord.x, 0);
  vec4 q = texelFetch(questions, pixel, 0);
  ShadowLookup at;
  at.texel = q.xy;
  at.layer = 1.0;
  at.depth_curve = 0.0;
  at.depth = q.z;
  at.rotation = q.w;
  at.depth_gradient = texelFetch(gradients, pixel, 0).xy;
  at.pixel = texelFetch(gradients, pixel, 0).zw;
  at.ends = texelFetch(gradients, pixel + ivec2(0, 1), 0);
  at.longer = texelFetch(gradients, pixel + ivec2(0, 2), 0);
  at.layer_size = vec2(textureSize(depth_map, 0).xy);
  at.box = box;
  at.disc = mat2(box.x);
  at.footprint = mat2(0.0);
  at.texels_per_world = mat2(8.0);
  at.ray = vec4(q.z, 1.0, 0.1, 0.0);
  at.light_distance = 0.0;
  return at;
}
)";
constexpr const char* kAskDepth = R"(
layout(binding = 8) uniform sampler2DArray points;
vec2 shadow_silhouette(ShadowLookup at, vec2 texel) {
  ivec2 place = ivec2(texel);
  bool inside = all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, textureSize(points, 0).xy));
  return inside ? texelFetch(points, ivec3(place, 0), 0).rg : vec2(0.5);
}
void main() { answer = vec4(shadow_visibility(compare_map, depth_map, question(), shadow_options(0))); }
)";
constexpr const char* kAskFiltered = R"(
#include "library/fetch_filtered.glsl"
layout(binding = 8) uniform sampler2DArray stored[GNOMON_SHADOW_VECTORS];
void main() {
  ShadowLookup at = question();
  answer = vec4(shadow_visibility(fetch_filtered(stored, at, 1), depth_map, depth_max, at, shadow_options(0)));
}
)";
constexpr const char* kAskJoined = R"(
#include "library/fetch_joined.glsl"
layout(binding = 8) uniform sampler2DArray stored[GNOMON_SHADOW_VECTORS];
void main() {
  ShadowLookup at = question();
  ShadowOptions options = shadow_options(0);
  answer = vec4(joined_visibility(stored, depth_map, depth_max, at, 1, options));
}
)";
constexpr const char* kAskSummed = R"(
#include "library/fetch_summed.glsl"
layout(binding = 8) uniform usampler2DArray sums;
ShadowTexel shadow_mean(ShadowLookup at) { return fetch_summed(sums, at, filtering.sums.x); }
void main() {
  ShadowLookup at = question();
  answer = vec4(shadow_visibility(shadow_mean(at), depth_map, depth_max, at, shadow_options(0)));
}
)";
constexpr const char* kAskTexels = R"(
ShadowTexel texel;
ShadowTexel shadow_mean(ShadowLookup at) { return texel; }
void main() {
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] = texelFetch(texels, ivec2(gl_FragCoord.x, i), 0);
  answer = vec4(shadow_visibility(texel, depth_map, depth_max, question(), shadow_options(0)));
}
)";
constexpr const char* kStore = R"(
ShadowTexel shadow_mean(ShadowLookup at) { return shadow_nothing(shadow_options(0)); }
layout(location = 1) uniform int vector;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  answer = shadow_store(texelFetch(questions, pixel, 0).z, texelFetch(gradients, pixel, 0).xy, shadow_options(0)).v[vector];
}
)";

const char* text_for(MapRead reads) {
  switch (reads) {
    case MapRead::depth:
      return kAskDepth;
    case MapRead::filtered:
      return kAskFiltered;
    case MapRead::joined:
      return kAskJoined;
    case MapRead::summed:
      return kAskSummed;
  }
  return "";
}

using Row = std::vector<std::array<float, 4>>;

Texture image_of(const Row& values, int height = 1) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  const auto width = static_cast<GLsizei>(values.size() / static_cast<std::size_t>(height));
  glTextureStorage2D(texture.name(), 1, GL_RGBA32F, width, height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, values.data());
  return texture;
}

/// Everything that the question shader reads but the maps.
class Asker {
 public:
  Asker(const FilterSettings& settings, const char* text, const std::vector<Question>& questions)
      : program_(link_screen_program(compose_shader_text(
            {"filter_test.frag", {filter_part(settings.filter->info.name)}}, std::string(kHead) + text,
            {shadow_vectors(settings), true, reads_of(settings) == MapRead::filtered}))),
        half_side_(static_cast<float>(settings.radius + 0.5)),
        width_(static_cast<GLsizei>(questions.size())) {
    Row points, gradients, ends, longer;
    for (const Question& q : questions) {
      points.push_back({q.position.x, q.position.y, q.depth, q.rotation});
      gradients.push_back({q.depth_gradient.x, q.depth_gradient.y, q.pixel.x, q.pixel.y});
      ends.push_back({q.ends_below.x, q.ends_below.y, q.ends_above.x, q.ends_above.y});
      longer.push_back({q.longer_below.x, q.longer_below.y, q.longer_above.x, q.longer_above.y});
    }
    gradients.insert(gradients.end(), ends.begin(), ends.end());
    gradients.insert(gradients.end(), longer.begin(), longer.end());
    questions_ = image_of(points);
    gradients_ = image_of(gradients, 3);
    answers_ = image_of(points);
  }
  Row ask(int vector = 0) {
    glNamedFramebufferTexture(fbo_.name(), GL_COLOR_ATTACHMENT0, answers_.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
    glViewport(0, 0, width_, 1);
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(0, questions_.name());
    glBindTextureUnit(1, gradients_.name());
    glBindVertexArray(none_.name());
    glUseProgram(program_.name());
    glUniform2f(0, half_side_, half_side_);
    if (vector > 0) glUniform1i(1, vector);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    Row out(static_cast<std::size_t>(width_));
    glGetTextureImage(answers_.name(), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(out.size() * sizeof(out[0])), out.data());
    return out;
  }

 private:
  Program program_;
  Framebuffer fbo_ = make_framebuffer();
  VertexArray none_ = make_vertex_array();
  Texture questions_, gradients_, answers_;
  float half_side_;
  GLsizei width_;
};

BlurSides sides_of(const FilterSettings& settings) {
  BlurSides sides{};
  const bool blurred =
      settings.filter->info.reads == MapRead::filtered || settings.filter->info.reads == MapRead::joined;
  for (double& side : sides) side = blurred ? settings.radius + 0.5 : 0.0;
  return sides;
}

/// The filter's block, bound for as long as this lives.
struct BoundBlock {
  FilterBlock block;
  Buffer buffer = make_buffer();
  explicit BoundBlock(const FilterSettings& settings) : block(filter_block(settings, sides_of(settings))) {
    glNamedBufferStorage(buffer.name(), sizeof block, &block, 0);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFilterBinding, buffer.name());
  }
};

/// One texel that says (0.5, 0.5) where the map has none.
Texture silhouettes_of(const TestMap& map) {
  Texture texture = make_texture(GL_TEXTURE_2D_ARRAY);
  const bool any = !map.silhouette.empty();
  glTextureStorage3D(texture.name(), 1, GL_RG32F, any ? map.width : 1, any ? map.height : 1, 1);
  constexpr glm::vec2 kMiddle{0.5f};
  glTextureSubImage3D(texture.name(), 0, 0, 0, 0, any ? map.width : 1, any ? map.height : 1, 1, GL_RG,
                      GL_FLOAT, any ? map.silhouette.data() : &kMiddle);
  return texture;
}

std::vector<float> first_of(const Row& row) {
  std::vector<float> out;
  for (const auto& v : row) out.push_back(v[0]);
  return out;
}

}  // namespace

double TestMap::at(int x, int y) const noexcept {
  const bool inside = x >= 0 && y >= 0 && x < width && y < height;
  return inside ? depth[static_cast<std::size_t>(y * width + x)] : 1.0;
}

glm::dvec2 TestMap::silhouette_at(int x, int y) const noexcept {
  const bool inside = x >= 0 && y >= 0 && x < width && y < height && !silhouette.empty();
  return inside ? glm::dvec2(silhouette[static_cast<std::size_t>(y * width + x)]) : glm::dvec2(0.5);
}

TestMap random_map(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  TestMap map{width, height, {}, {}};
  for (int i = 0; i < width * height; ++i) map.depth.push_back(static_cast<float>(random() % 257) / 256.0f);
  for (int i = 0; i < width * height; ++i) {
    const auto both = static_cast<unsigned>(random());
    map.silhouette.emplace_back(static_cast<float>(both % 65) / 64.0f,
                                static_cast<float>(both / 65 % 65) / 64.0f);
  }
  return map;
}

std::vector<Question> random_questions(const TestMap& map, int count, unsigned seed, int rim) {
  std::mt19937 random(seed), pieces(seed + 1);
  const auto below = [&random](int n) { return static_cast<float>(random() % static_cast<unsigned>(n)); };
  std::vector<Question> questions;
  for (int i = 0; i < count; ++i) {
    Question q;
    q.position = {below((map.width - 2 * rim) * 16) / 16.0f + static_cast<float>(rim),
                  below((map.height - 2 * rim) * 16) / 16.0f + static_cast<float>(rim)};
    q.depth = below(257) / 256.0f;
    q.depth_gradient = {(below(65) - 32.0f) / 1024.0f, (below(65) - 32.0f) / 1024.0f};
    q.rotation = below(64) / 10.0f;
    if (i % 2 == 1) {
      // Pieces whose texels are shorter or longer, in reach of a kernel.
      const auto some = [&pieces](float first) { return first + static_cast<float>(pieces() % 64) / 16.0f; };
      q.ends_below = {-some(0.0f), -some(0.0f)};
      q.ends_above = {some(0.0f), some(0.0f)};
      q.longer_below = {some(-0.875f), some(-0.875f)};
      q.longer_above = {some(-0.875f), some(-0.875f)};
    }
    questions.push_back(q);
  }
  return questions;
}

std::vector<float> ask_shader(const FilterSettings& settings, const TestMap& map,
                              const std::vector<Question>& questions) {
  MapTargets targets;
  targets.fit(map.width, map.height, 2);
  glTextureSubImage3D(targets.depth.name(), 0, 0, 0, 1, map.width, map.height, 1, GL_DEPTH_COMPONENT,
                      GL_FLOAT, map.depth.data());
  const BoundBlock block(settings);
  const FilterPrograms programs = make_filter_programs(settings);
  const std::array<glm::ivec2, 2> sizes{glm::ivec2(map.width, map.height), glm::ivec2(map.width, map.height)};
  StoredMaps stored;
  stored.build(programs, settings, block.block,
               {targets.depth.name(), map.width, map.height, sizes, settings.mipmap});
  Asker asker(settings, text_for(reads_of(settings)), questions);
  for (const GLuint unit : {kCompareUnit, kDepthUnit}) glBindTextureUnit(unit, targets.depth.name());
  glBindSampler(kCompareUnit, targets.compare_sampler.name());
  glBindSampler(kDepthUnit, targets.plain_sampler.name());
  stored.bind();
  const Texture points = silhouettes_of(map);
  if (settings.filter->info.draws_silhouettes) glBindTextureUnit(kStoredUnit, points.name());
  return first_of(asker.ask());
}

std::vector<float> ask_shader(const FilterSettings& settings, const std::vector<StoredTexel>& texels,
                              const std::vector<Question>& questions) {
  const BoundBlock block(settings);
  Asker asker(settings, kAskTexels, questions);
  const auto vectors = static_cast<std::size_t>(shadow_vectors(settings));
  Row values;
  for (std::size_t v = 0; v < vectors; ++v) {
    for (const StoredTexel& texel : texels) {
      values.push_back({static_cast<float>(texel[4 * v]), static_cast<float>(texel[4 * v + 1]),
                        static_cast<float>(texel[4 * v + 2]), static_cast<float>(texel[4 * v + 3])});
    }
  }
  const Texture image = image_of(values, static_cast<int>(vectors));
  glBindTextureUnit(2, image.name());
  MapTargets nothing_casts;
  constexpr float kFarthest = 1.0f;
  glClearTexImage(nothing_casts.depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &kFarthest);
  for (const GLuint unit : {kCompareUnit, kDepthUnit, kDepthMaxUnit}) {
    glBindTextureUnit(unit, nothing_casts.depth.name());
    glBindSampler(unit, nothing_casts.plain_sampler.name());
  }
  return first_of(asker.ask());
}

std::vector<StoredTexel> stored_by_shader(const FilterSettings& settings, const std::vector<float>& depths,
                                          const std::vector<glm::vec2>& slopes) {
  std::vector<Question> questions;
  for (std::size_t i = 0; i < depths.size(); ++i) questions.push_back({{}, depths[i], slopes[i], 0.0f});
  const BoundBlock block(settings);
  Asker asker(settings, kStore, questions);
  std::vector<StoredTexel> texels(depths.size());
  for (int v = 0; v < shadow_vectors(settings); ++v) {
    const Row row = asker.ask(v);
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) texels[i][4 * static_cast<std::size_t>(v) + c] = row[i][c];
    }
  }
  return texels;
}

FilterSettings settings_from(std::string_view text) {
  const ParsedFilter parsed = parse_filter(text);
  if (!parsed.error.empty()) throw std::runtime_error(parsed.error);
  return parsed.settings;
}

double& option_named(FilterSettings& settings, std::string_view name) {
  const auto& options = settings.filter->info.options;
  for (std::size_t i = 0; i < options.size(); ++i)
    if (options[i].name == name) return settings.option[i];
  throw std::runtime_error("no option " + std::string(name));
}

}  // namespace gnomon::render
