// A picture on the GPU that is put together from the renderer's pictures, images and lines.
#include "canvas.hpp"

#include <glad/gl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "gl/gl_object.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/picture.hpp"

namespace gnomon::tool::view {
namespace {

using render::RenderError;

constexpr const char* kVertexShader = R"(#version 450
layout(location = 0) in vec2 ndc;
layout(location = 1) in vec4 color;
out vec4 line_color;
void main() {
  line_color = color;
  gl_Position = vec4(ndc, 0.5, 1.0);
})";
constexpr const char* kFragmentShader = R"(#version 450
in vec4 line_color;
layout(location = 0) out vec4 picture;
void main() { picture = line_color; })";

/// As the vertex shader reads it.
struct Vertex {
  glm::vec2 ndc;
  glm::u8vec4 color;
};

render::Shader compiled(GLenum type, const char* text) {
  render::Shader shader(glCreateShader(type));
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint ok = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok == GL_FALSE) throw RenderError("the viewer's line shader does not compile");
  return shader;
}

render::Program line_program() {
  const render::Shader vertex = compiled(GL_VERTEX_SHADER, kVertexShader),
                       fragment = compiled(GL_FRAGMENT_SHADER, kFragmentShader);
  render::Program program(glCreateProgram());
  glAttachShader(program.name(), vertex.name());
  glAttachShader(program.name(), fragment.name());
  glLinkProgram(program.name());
  GLint ok = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (ok == GL_FALSE) throw RenderError("the viewer's line program does not link");
  return program;
}

void flip_rows(std::vector<std::uint8_t>& bytes, int width, int height) {
  const auto row = static_cast<std::ptrdiff_t>(width) * 4;
  for (int y = 0; y < height / 2; ++y)
    std::swap_ranges(bytes.begin() + row * y, bytes.begin() + row * (y + 1),
                     bytes.begin() + row * (height - 1 - y));
}

}  // namespace

struct Canvas::Impl {
  int width = 0, height = 0;
  render::Texture texture;
  render::Framebuffer fbo;
  render::Program lines = line_program();
  render::Buffer vertices = render::make_buffer();
  render::VertexArray layout = render::make_vertex_array();
};

Canvas::Canvas() : impl_(std::make_unique<Impl>()) {
  const GLuint layout = impl_->layout.name();
  glVertexArrayVertexBuffer(layout, 0, impl_->vertices.name(), 0, sizeof(Vertex));
  for (const GLuint attribute : {0u, 1u}) {
    glEnableVertexArrayAttrib(layout, attribute);
    glVertexArrayAttribBinding(layout, attribute, 0);
  }
  glVertexArrayAttribFormat(layout, 0, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, ndc));
  glVertexArrayAttribFormat(layout, 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, color));
  resize(1, 1);
}

Canvas::~Canvas() = default;

void Canvas::resize(int width, int height) {
  if (impl_->width == width && impl_->height == height) return;
  impl_->width = width;
  impl_->height = height;
  impl_->texture = render::make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(impl_->texture.name(), 1, GL_RGBA8, width, height);
  impl_->fbo = render::make_framebuffer();
  glNamedFramebufferTexture(impl_->fbo.name(), GL_COLOR_ATTACHMENT0, impl_->texture.name(), 0);
}

int Canvas::width() const noexcept {
  return impl_->width;
}
int Canvas::height() const noexcept {
  return impl_->height;
}
std::uint32_t Canvas::framebuffer() const noexcept {
  return impl_->fbo.name();
}

void Canvas::put(const Image& image, int x, int y) {
  const int left = std::max(x, 0), top = std::max(y, 0);
  const int right = std::min(x + image.width, impl_->width),
            bottom = std::min(y + image.height, impl_->height);
  if (left >= right || top >= bottom) return;
  const auto row = static_cast<std::size_t>(right - left) * 4;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(row * static_cast<std::size_t>(bottom - top));
  for (int line = bottom - 1; line >= top; --line) {  // OpenGL's rows run bottom to top
    const std::size_t at = 4 * (static_cast<std::size_t>(line - y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(left - x));
    const auto first = image.rgba.begin() + static_cast<std::ptrdiff_t>(at);
    bytes.insert(bytes.end(), first, first + static_cast<std::ptrdiff_t>(row));
  }
  glTextureSubImage2D(impl_->texture.name(), 0, left, impl_->height - bottom, right - left, bottom - top,
                      GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
}

void Canvas::take(const Canvas& from, int begin, int end) {
  if (begin >= end) return;
  glBlitNamedFramebuffer(from.framebuffer(), framebuffer(), begin, 0, end, impl_->height, begin, 0, end,
                         impl_->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Canvas::draw(std::span<const ScreenLine> lines) {
  if (lines.empty()) return;
  std::vector<Vertex> vertices;
  vertices.reserve(lines.size() * 6);
  const glm::dvec2 scale(2.0 / impl_->width, -2.0 / impl_->height);
  for (const ScreenLine& line : lines) {
    const glm::dvec2 along = line.to - line.from;
    const double length = glm::length(along);
    const glm::dvec2 unit = length > 0.0 ? along / length : glm::dvec2(1.0, 0.0);
    const glm::dvec2 aside = glm::dvec2(-unit.y, unit.x) * (0.5 * line.width);
    const auto corner = [&](const glm::dvec2& p) {
      return Vertex{glm::vec2(p * scale + glm::dvec2(-1.0, 1.0)), line.color};
    };
    const Vertex a = corner(line.from + aside), b = corner(line.from - aside), c = corner(line.to - aside),
                 d = corner(line.to + aside);
    vertices.insert(vertices.end(), {a, b, c, a, c, d});
  }
  glNamedBufferData(impl_->vertices.name(), static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                    vertices.data(), GL_STREAM_DRAW);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glViewport(0, 0, impl_->width, impl_->height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(impl_->lines.name());
  glBindVertexArray(impl_->layout.name());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  glDisable(GL_BLEND);
}

Image Canvas::image() const {
  Image image = render::blank_image(impl_->width, impl_->height, {0, 0, 0});
  glGetTextureImage(impl_->texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                    static_cast<GLsizei>(image.rgba.size()), image.rgba.data());
  flip_rows(image.rgba, impl_->width, impl_->height);
  return image;
}

void Canvas::show(int x, int y, int window_height) const {
  const int bottom = window_height - y - impl_->height;
  glBlitNamedFramebuffer(framebuffer(), 0, 0, 0, impl_->width, impl_->height, x, bottom, x + impl_->width,
                         bottom + impl_->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image window_image(int width, int height) {
  Image image = render::blank_image(width, height, {0, 0, 0});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  flip_rows(image.rgba, width, height);
  return image;
}

void clear_window(int width, int height) {
  constexpr std::array<float, 4> kGround{0.1f, 0.1f, 0.115f, 1.0f};
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glClearBufferfv(GL_COLOR, 0, kGround.data());
}

void finish_gl() {
  glFinish();
}

unsigned last_gl_error() {
  return glGetError();
}

}  // namespace gnomon::tool::view
