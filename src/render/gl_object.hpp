// OpenGL names that free themselves. The context they were made in must be current when they go.
#pragma once

#include <glad/gl.h>

#include <utility>

namespace gnomon::render {

template <void (*kDestroy)(GLuint)>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint name) : name_(name) {}
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (name_ != 0) kDestroy(name_);
  }
  [[nodiscard]] GLuint name() const noexcept { return name_; }
  explicit operator bool() const noexcept { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

namespace detail {
inline void delete_texture(GLuint name) {
  glDeleteTextures(1, &name);
}
inline void delete_buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
inline void delete_framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
inline void delete_vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}
inline void delete_sampler(GLuint name) {
  glDeleteSamplers(1, &name);
}
inline void delete_shader(GLuint name) {
  glDeleteShader(name);
}
inline void delete_program(GLuint name) {
  glDeleteProgram(name);
}
}  // namespace detail

using Texture = GlObject<detail::delete_texture>;
using Buffer = GlObject<detail::delete_buffer>;
using Framebuffer = GlObject<detail::delete_framebuffer>;
using VertexArray = GlObject<detail::delete_vertex_array>;
using Sampler = GlObject<detail::delete_sampler>;
using Shader = GlObject<detail::delete_shader>;
using Program = GlObject<detail::delete_program>;

[[nodiscard]] inline Buffer make_buffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return Buffer(name);
}
[[nodiscard]] inline Texture make_texture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return Texture(name);
}
[[nodiscard]] inline Framebuffer make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return Framebuffer(name);
}
[[nodiscard]] inline VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}
[[nodiscard]] inline Sampler make_sampler() {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  return Sampler(name);
}

}  // namespace gnomon::render
