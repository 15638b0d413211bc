// Makes the images of a frame.
#include "frame/target.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "filter/stored_maps.hpp"

namespace gnomon::render {

Texture pixel_image(GLenum format, int width, int height) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, format, width, height);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

Texture depth_layers(int width, int height, int layers) {
  Texture texture = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), 1, GL_DEPTH_COMPONENT32F, width, height, layers);
  return texture;
}

Framebuffer depth_framebuffer() {
  Framebuffer fbo = make_framebuffer();
  glNamedFramebufferDrawBuffer(fbo.name(), GL_NONE);
  glNamedFramebufferReadBuffer(fbo.name(), GL_NONE);
  return fbo;
}

namespace {

Framebuffer framebuffer_of(const Texture& color) {
  Framebuffer fbo = make_framebuffer();
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT0, color.name(), 0);
  return fbo;
}

Sampler depth_sampler(GLint filter) {
  Sampler sampler = make_sampler();
  glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, filter);
  glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, filter);
  glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  constexpr std::array<float, 4> kFarthest{1.0f, 1.0f, 1.0f, 1.0f};  // outside the map everything is lit
  glSamplerParameterfv(sampler.name(), GL_TEXTURE_BORDER_COLOR, kFarthest.data());
  return sampler;
}

}  // namespace

void FrameTargets::resize(int new_width, int new_height) {
  if (width == new_width && height == new_height) return;
  width = new_width;
  height = new_height;
  position = pixel_image(GL_RGBA32F, width, height);
  normal = pixel_image(GL_RGBA32F, width, height);
  albedo = pixel_image(GL_SRGB8_ALPHA8, width, height);
  depth = pixel_image(GL_DEPTH_COMPONENT32F, width, height);
  mask = pixel_image(GL_RG32F, width, height);
  color = pixel_image(GL_SRGB8_ALPHA8, width, height);
  aliasing = pixel_image(GL_RGBA32F, width, height);
  heat = pixel_image(GL_SRGB8_ALPHA8, width, height);
  tint = pixel_image(GL_SRGB8_ALPHA8, width, height);
  surfaces_fbo = surfaces_framebuffer(nullptr);
  off_plane = {};
  identifier = {};
  mask_fbo = framebuffer_of(mask);
  color_fbo = framebuffer_of(color);
  aliasing_fbo = framebuffer_of(aliasing);
  heat_fbo = framebuffer_of(heat);
  tint_fbo = framebuffer_of(tint);
}

Framebuffer FrameTargets::surfaces_framebuffer(const Texture* fourth) const {
  Framebuffer fbo = framebuffer_of(position);
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT1, normal.name(), 0);
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT2, albedo.name(), 0);
  if (fourth != nullptr) glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT3, fourth->name(), 0);
  glNamedFramebufferTexture(fbo.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  constexpr std::array<GLenum, 4> kAll{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
                                       GL_COLOR_ATTACHMENT3};
  glNamedFramebufferDrawBuffers(fbo.name(), fourth != nullptr ? 4 : 3, kAll.data());
  return fbo;
}

void FrameTargets::add_off_plane() {
  if (off_plane) return;
  off_plane = pixel_image(GL_R32F, width, height);
  off_plane_fbo = surfaces_framebuffer(&off_plane);
}

void FrameTargets::add_identifiers() {
  if (identifier) return;
  identifier = pixel_image(GL_R32UI, width, height);
  identified_fbo = surfaces_framebuffer(&identifier);
}

MapTargets::MapTargets()
    : compare_sampler(depth_sampler(GL_LINEAR)), plain_sampler(depth_sampler(GL_NEAREST)) {
  glSamplerParameteri(compare_sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glSamplerParameteri(compare_sampler.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  fit(1, 1, 1);  // a plan without maps binds it all the same
}

std::uint64_t MapTargets::bytes() const noexcept {
  constexpr std::uint64_t kDepthBytes = 4;
  return kDepthBytes * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
         static_cast<std::uint64_t>(layers * (beneath ? 2 : 1) + (scratch ? 1 : 0));
}

bool MapTargets::fit(int new_width, int new_height, int new_layers) {
  const bool same_size = width == new_width && height == new_height;
  if (same_size && layers >= new_layers) return false;
  const int kept_layers = same_size ? layers : 0;
  width = new_width;
  height = new_height;
  layers = std::max(layers, new_layers);
  const auto grow = [&](Texture& image) {
    const Texture before = std::move(image);
    image = depth_layers(width, height, layers);
    if (kept_layers > 0 && before)
      glCopyImageSubData(before.name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, image.name(), GL_TEXTURE_2D_ARRAY, 0,
                         0, 0, 0, width, height, kept_layers);
  };
  grow(depth);
  if (!same_size) beneath = {};
  if (beneath) grow(beneath);
  scratch = {};
  fbo = depth_framebuffer();
  return !same_size;
}

void MapTargets::attach(Of which, int layer) const noexcept {
  const Texture& image = which == Of::all ? depth : beneath;
  glNamedFramebufferTextureLayer(fbo.name(), GL_DEPTH_ATTACHMENT, image.name(), 0, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo.name());
}

void MapTargets::bind() const noexcept {
  glBindTextureUnit(kCompareUnit, depth.name());
  glBindSampler(kCompareUnit, compare_sampler.name());
  glBindTextureUnit(kDepthUnit, depth.name());
  glBindSampler(kDepthUnit, plain_sampler.name());
}

void MapTargets::add_beneath() {
  if (!beneath) beneath = depth_layers(width, height, layers);
}

void MapTargets::copy(Of into_which, int layer, const TexelRect& at) const noexcept {
  const Texture &from = into_which == Of::all ? beneath : depth,
                &into = into_which == Of::all ? depth : beneath;
  glCopyImageSubData(from.name(), GL_TEXTURE_2D_ARRAY, 0, at.x, at.y, layer, into.name(), GL_TEXTURE_2D_ARRAY,
                     0, at.x, at.y, layer, at.width, at.height, 1);
}

void MapTargets::move(Of which, int layer, const TexelRect& to, int shift_x, int shift_y) noexcept {
  if (!scratch) scratch = depth_layers(width, height, 1);
  // By way of another image: within one, source and destination would overlap.
  const auto copy = [&to](GLuint from, int from_x, int from_y, int from_layer, GLuint into, int x, int y,
                          int z) {
    glCopyImageSubData(from, GL_TEXTURE_2D_ARRAY, 0, from_x, from_y, from_layer, into, GL_TEXTURE_2D_ARRAY, 0,
                       x, y, z, to.width, to.height, 1);
  };
  const GLuint image = which == Of::all ? depth.name() : beneath.name();
  copy(image, to.x - shift_x, to.y - shift_y, layer, scratch.name(), 0, 0, 0);
  copy(scratch.name(), 0, 0, 0, image, to.x, to.y, layer);
}

}  // namespace gnomon::render
