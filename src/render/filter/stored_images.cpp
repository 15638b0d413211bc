// Images of stored texels, and framebuffers that draw into all of them.
#include "filter/stored_images.hpp"

#include <algorithm>
#include <array>

#include "filter/stored_maps.hpp"

namespace gnomon::render {
namespace {

GLenum internal_format(TexelFormat format, int channels) noexcept {
  // By format, then 1, 2 or 4 channels: textures of three cannot be drawn into.
  constexpr GLenum kFormats[6][3] = {{GL_R32F, GL_RG32F, GL_RGBA32F},     {GL_R16F, GL_RG16F, GL_RGBA16F},
                                     {GL_R16, GL_RG16, GL_RGBA16},        {GL_R8, GL_RG8, GL_RGBA8},
                                     {GL_RG32UI, GL_RG32UI, GL_RGBA32UI}, {GL_R16, GL_RG16, GL_RGBA16}};
  return kFormats[static_cast<std::size_t>(format)][channels <= 2 ? channels - 1 : 2];
}

int bytes_of(GLenum format) noexcept {
  switch (format) {
    case GL_R8:
      return 1;
    case GL_R16F:
    case GL_R16:
    case GL_RG8:
      return 2;
    case GL_RG32F:
    case GL_RGBA16F:
    case GL_RGBA16:
    case GL_RG32UI:
      return 8;
    case GL_RGBA32F:
    case GL_RGBA32UI:
      return 16;
    default:
      return 4;
  }
}

}  // namespace

GLenum stored_format(const FilterSettings& settings) noexcept {
  return internal_format(settings.format, settings.filter->info.channels(settings));
}

Texture array_image(GLenum format, int levels, int width, int height, int layers, std::uint64_t& bytes) {
  Texture texture = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), levels, format, width, height, layers);
  for (int level = 0; level < levels; ++level) {
    bytes += static_cast<std::uint64_t>(std::max(width >> level, 1)) *
             static_cast<std::uint64_t>(std::max(height >> level, 1)) * static_cast<std::uint64_t>(layers) *
             static_cast<std::uint64_t>(bytes_of(format));
  }
  return texture;
}

void attach_images(const Framebuffer& fbo, const std::vector<Texture>& images, GLint level, GLint layer) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    glNamedFramebufferTextureLayer(fbo.name(), static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i),
                                   images[i].name(), level, layer);
  }
}

void draw_into_all(const Framebuffer& fbo, std::size_t images) {
  std::array<GLenum, kMaxChannels / 4> buffers{};
  for (std::size_t i = 0; i < images; ++i) buffers[i] = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
  glNamedFramebufferDrawBuffers(fbo.name(), static_cast<GLsizei>(images), buffers.data());
}

void bind_images(const std::vector<Texture>& images, const Sampler& sampler) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    glBindTextureUnit(static_cast<GLuint>(kStoredUnit + i), images[i].name());
    glBindSampler(static_cast<GLuint>(kStoredUnit + i), sampler.name());
  }
}

}  // namespace gnomon::render
