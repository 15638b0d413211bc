// Does each shape's GLSL give the places that its C++ gives?
#include "gnomon/extend/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "gl/program.hpp"
#include "shared_context.hpp"
#include "support/fitted_shapes.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = 33;  // places tried along either axis

/// `value`, four floats of a shaped point, at kSide x kSide places over the square.
std::vector<std::array<float, 4>> drawn(const std::string& value, float index, const TexelGrid& grid) {
  const glm::dvec2 size = grid.size();
  const std::string text =
      "#version 450 core\n#include \"library/shape.glsl\"\nlayout(location = 0) uniform mat4 shape;\n"
      "layout(location = 1) uniform vec2 size;\nlayout(location = 0) out vec4 answer;\nvoid main() {\n"
      "  vec2 ndc = (gl_FragCoord.xy - 0.5) / " +
      std::to_string(kSide - 1) +
      ".0 * 2.0 - 1.0;\n  ShapedPoint p = shaped_point(shape, size, ndc);\n  answer = " + value + ";\n}\n";
  const Program program = link_screen_program(compose_shader_text("shape_test.frag", text));
  GLuint image = 0, fbo = 0, vertices = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &image);
  glTextureStorage2D(image, 1, GL_RGBA32F, kSide, kSide);
  glCreateFramebuffers(1, &fbo);
  glNamedFramebufferTexture(fbo, GL_COLOR_ATTACHMENT0, image, 0);
  glCreateVertexArrays(1, &vertices);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  glViewport(0, 0, kSide, kSide);
  glDisable(GL_DEPTH_TEST);
  glUseProgram(program.name());
  std::array<float, 16> shape{index};
  std::transform(grid.parameters.begin(), grid.parameters.end(), shape.begin() + 1,
                 [](double parameter) { return static_cast<float>(parameter); });
  glProgramUniformMatrix4fv(program.name(), 0, 1, GL_FALSE, shape.data());
  glProgramUniform2f(program.name(), 1, static_cast<float>(size.x), static_cast<float>(size.y));
  glBindVertexArray(vertices);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<std::array<float, 4>> answer(static_cast<std::size_t>(kSide) * kSide);
  glGetTextureImage(image, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(answer.size() * 16), answer.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteVertexArrays(1, &vertices);
  glDeleteFramebuffers(1, &fbo);
  glDeleteTextures(1, &image);
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  return answer;
}

/// Growths of w that shapes undo: none, little, much either way, more than they can.
constexpr std::array kGrowths{0.0, 0.004, 0.02, 1.0, 6.0, -6.0, 20.0};

/// Every shape by its place in the registry, with the parameters of each growth and of what is seen.
std::vector<std::pair<std::size_t, ShapeParameters>> tried() {
  std::vector<std::pair<std::size_t, ShapeParameters>> all;
  for (std::size_t s = 0; s < all_shapes().size(); ++s) {
    const Shape& shape = *all_shapes()[s];
    for (const double growth : kGrowths) all.emplace_back(s, shape.undoing(growth));
    for (const ShapeParameters& parameters : test::fitted_parameters(shape, {640.0, 384.0}))
      all.emplace_back(s, parameters);
  }
  return all;
}

/// Floats of some hundred texels after a few operations, near the end where the shape draws them apart, and a
/// logarithm's rounding over a growth that is little.
double rounding(const ShapedPoint& p, const TexelGrid& grid) {
  constexpr double kTexels = 1e-3, kNdc = 2e-7, kLogarithm = 2e-7, kLeastGrowth = 1.0 / 128.0;
  return kTexels + kNdc * std::max(p.texel_from_ndc[1][1], grid.size().y) +
         kLogarithm * grid.size().y / std::max(std::abs(grid.parameters[0]), kLeastGrowth);
}

TEST(ShapeLaw, shaders_place_texels_where_the_core_does) {
  for (auto [s, q] : tried()) {
    // What the shader is given.
    for (double& value : q) value = static_cast<double>(static_cast<float>(value));
    const TexelGrid grid{640, 384, all_shapes()[s], q};
    const auto places = drawn("vec4(p.texel, ndc_of_texel(shape, size, size * (ndc * 0.5 + 0.5)))",
                              static_cast<float>(s), grid);
    const auto slopes = drawn("vec4(p.texel_from_ndc[0], p.texel_from_ndc[1])", static_cast<float>(s), grid);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec2 ndc = glm::dvec2(x, y) / (kSide - 1.0) * 2.0 - 1.0;
        const ShapedPoint p = grid.place(ndc);
        const glm::dvec2 back = grid.ndc_of(grid.size() * (ndc * 0.5 + 0.5));
        const auto at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
        // exp and log of single precision.
        constexpr double kRelative = 1e-5;
        const double inverse = 1e-6 + 2.5e-7 / std::max(std::abs(q[0]), 1.0 / 128.0);
        for (int i = 0; i < 2; ++i) {
          ASSERT_NEAR(places[at][static_cast<std::size_t>(i)], p.texel[i], rounding(p, grid))
              << grid.shape->name << " " << q[0];
          ASSERT_NEAR(places[at][static_cast<std::size_t>(2 + i)], back[i],
                      inverse * std::max(1.0, back[i] * back[i]))
              << grid.shape->name << " " << q[0];
          for (int j = 0; j < 2; ++j) {
            const double slope = p.texel_from_ndc[i][j];
            ASSERT_NEAR(slopes[at][static_cast<std::size_t>(2 * i + j)], slope,
                        1e-3 + kRelative * std::abs(slope))
                << grid.shape->name << " " << q[0];
          }
        }
      }
    }
  }
}

TEST(ShapeLaw, shaders_know_how_long_texels_are_beyond_a_piece_of_the_map) {
  constexpr double kReach = 40.0;  // texels: less than a piece has, so that a way crosses at most one end
  int longer = 0;
  for (auto [s, q] : tried()) {
    for (double& value : q) value = static_cast<double>(static_cast<float>(value));
    const TexelGrid grid{640, 384, all_shapes()[s], q};
    const bool pieces = grid.shape == &shapes::rectilinear;
    const auto ends = drawn("p.ends", static_cast<float>(s), grid);
    const auto lengths = drawn("p.longer", static_cast<float>(s), grid);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
        const glm::dvec2 ndc = glm::dvec2(x, y) / (kSide - 1.0) * 2.0 - 1.0;
        const ShapedPoint p = grid.place(ndc);
        for (std::size_t i = 0; i < 4; ++i) {
          const int axis = i % 2 == 0 ? 0 : 1;
          const double beyond = lengths[at][i];
          if (!pieces) {
            ASSERT_EQ(beyond, 0.0) << grid.shape->name;
            continue;
          }
          for (const double steps : {0.25, 1.0, kReach}) {
            const double way = i < 2 ? -steps : steps, end = ends[at][i];
            const double past = i < 2 ? std::min(way - end, 0.0) : std::max(way - end, 0.0);
            glm::dvec2 there = p.texel;
            there[axis] += way;
            const double own_texels = (grid.ndc_of(there)[axis] - ndc[axis]) * p.texel_from_ndc[axis][axis];
            ASSERT_NEAR(way + beyond * past, own_texels, 1e-3 * (1.0 + std::abs(beyond)))
                << "place " << ndc[axis] << " axis " << axis << " end " << end;
            longer += past != 0.0 && beyond > 1.0 ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(longer, 500);
}

}  // namespace
}  // namespace gnomon::render
