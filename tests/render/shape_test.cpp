// Does each shape's GLSL give the places that its C++ gives?
#include "gnomon/shape.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "program.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = 33;  // places tried along either axis

/// `value`, four floats of a shaped point, at kSide x kSide places over the square.
std::vector<std::array<float, 4>> drawn(const std::string& value, float index, const glm::dvec2& size) {
  const std::string text =
      "#version 450 core\n#include \"library/shape.glsl\"\nlayout(location = 0) uniform vec4 shape;\n"
      "layout(location = 1) uniform vec2 size;\nlayout(location = 0) out vec4 answer;\nvoid main() {\n"
      "  vec2 ndc = (gl_FragCoord.xy - 0.5) / " +
      std::to_string(kSide - 1) +
      ".0 * 2.0 - 1.0;\n  ShapedPoint p = shaped_point(shape, size, ndc);\n  answer = " + value + ";\n}\n";
  const Program program =
      make_program(compose_shader("fullscreen.vert"), compose_shader_text("shape_test.frag", text));
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
  glProgramUniform4f(program.name(), 0, index, 0.0f, 0.0f, 0.0f);
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

TEST(ShapeLaw, shaders_place_texels_where_the_core_does) {
  const std::array<int, 2> size{640, 384};
  constexpr double kRounding = 1e-3;  // texels: floats of some hundred texels, a few operations
  for (std::size_t s = 0; s < all_shapes().size(); ++s) {
    const TexelGrid grid{size[0], size[1], all_shapes()[s], {}};
    const auto places = drawn("vec4(p.texel, p.texel)", static_cast<float>(s), grid.size());
    const auto slopes =
        drawn("vec4(p.texel_from_ndc[0], p.texel_from_ndc[1])", static_cast<float>(s), grid.size());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec2 ndc = glm::dvec2(x, y) / (kSide - 1.0) * 2.0 - 1.0;
        const ShapedPoint p = grid.place(ndc);
        const auto at = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
        for (int i = 0; i < 2; ++i) {
          ASSERT_NEAR(places[at][static_cast<std::size_t>(i)], p.texel[i], kRounding) << grid.shape->name;
          for (int j = 0; j < 2; ++j) {
            ASSERT_NEAR(slopes[at][static_cast<std::size_t>(2 * i + j)], p.texel_from_ndc[i][j], kRounding)
                << grid.shape->name;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::render
