// One depth peel of a map, and the pass that joins both surfaces.
// Based on: Everitt, "Interactive order-independent transparency", 2001, for one layer, seen from the light.
#include "maps/depth_peel.hpp"

#include "gl/program.hpp"

namespace gnomon::render {
namespace {

// Bindings and locations as the shaders state them.
constexpr GLuint kFirstUnit = 5, kSecondUnit = 6;
constexpr GLint kLayerLocation = 0, kCurveLocation = 1;

void scissor(const TexelRect& at) noexcept {
  glEnable(GL_SCISSOR_TEST);
  glScissor(at.x, at.y, at.width, at.height);
}

}  // namespace

DepthPeel::DepthPeel()
    : opaque_(make_caster_program("alpha/opaque", "depth/peeled")),
      masked_(make_caster_program("alpha/masked", "depth/peeled")),
      store_(make_screen_program("pass/depth/layer.frag")) {}

std::uint64_t DepthPeel::bytes() const noexcept {
  constexpr std::uint64_t kDepthBytes = 4, kImages = 2;
  return kImages * kDepthBytes * static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
}

void DepthPeel::begin(const MapTargets& maps, int layer, const TexelRect& at) {
  if (width_ != maps.width || height_ != maps.height) {
    width_ = maps.width;
    height_ = maps.height;
    first_ = depth_layers(width_, height_, 1);
    second_ = depth_layers(width_, height_, 1);
    fbo_ = depth_framebuffer();
    glNamedFramebufferTextureLayer(fbo_.name(), GL_DEPTH_ATTACHMENT, second_.name(), 0, 0);
  }
  glCopyImageSubData(maps.depth.name(), GL_TEXTURE_2D_ARRAY, 0, at.x, at.y, layer, first_.name(),
                     GL_TEXTURE_2D_ARRAY, 0, at.x, at.y, 0, at.width, at.height, 1);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
  scissor(at);
  constexpr float kFarthest = 1.0f;
  glClearNamedFramebufferfv(fbo_.name(), GL_DEPTH, 0, &kFarthest);
  glBindTextureUnit(kFirstUnit, first_.name());
  glBindSampler(kFirstUnit, maps.plain_sampler.name());
}

void DepthPeel::finish(const MapTargets& maps, int layer, const TexelRect& at, const PeeledDepth& depth,
                       GLuint no_vertices) noexcept {
  glNamedFramebufferTextureLayer(maps.fbo.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
  scissor(at);
  glBindTextureUnit(kSecondUnit, second_.name());
  glBindSampler(kSecondUnit, maps.plain_sampler.name());
  glUseProgram(store_.name());
  glUniform1i(kLayerLocation, static_cast<GLint>(depth.layer));
  glUniform2f(kCurveLocation, static_cast<GLfloat>(depth.curve), static_cast<GLfloat>(depth.limit));
  glBindVertexArray(no_vertices);
  glDepthFunc(GL_ALWAYS);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthFunc(GL_LESS);
  glBindSampler(kSecondUnit, 0);  // shared with the mask
}

}  // namespace gnomon::render
