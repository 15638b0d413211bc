// OpenGL names that free themselves. The context they were made in must be current when they go.
#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

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
/// A buffer that holds `parts` one behind the other. Parts of it can be sent again.
[[nodiscard]] inline Buffer filled_buffer(std::initializer_list<std::span<const std::byte>> parts) {
  std::size_t bytes = 0;
  for (const std::span<const std::byte>& part : parts) bytes += part.size();
  Buffer buffer = make_buffer();
  // A buffer of no bytes is an error; what is empty still has its buffers.
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 16)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  GLintptr at = 0;
  for (const std::span<const std::byte>& part : parts) {
    const auto size = static_cast<GLsizeiptr>(part.size());
    glNamedBufferSubData(buffer.name(), at, size, part.data());
    at += size;
  }
  return buffer;
}
template <class T>
[[nodiscard]] Buffer filled_buffer(const std::vector<T>& values) {
  return filled_buffer({std::as_bytes(std::span(values))});
}
/// Sends `values`, growing the buffer by halves so that a flight soon stops allocating.
template <class T>
void send_growing(Buffer& buffer, std::size_t& capacity, const std::vector<T>& values) {
  if (values.size() > capacity || !buffer) {
    capacity = std::max<std::size_t>(values.size() + values.size() / 2, 64);
    buffer = make_buffer();
    glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(capacity * sizeof(T)), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
  }
  glNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data());
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
