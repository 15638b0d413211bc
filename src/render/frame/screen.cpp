// The surfaces that the camera sees, and passes over all of their pixels.
#include "frame/screen.hpp"

#include <array>
#include <vector>

#include "filter/stored_maps.hpp"
#include "frame/blue_noise.hpp"
#include "gl/program.hpp"
#include "maps/caster_pass.hpp"

namespace gnomon::render {
namespace {

// Bindings as the shaders state them.
constexpr GLuint kFrameBinding = 0, kPositionUnit = 0, kNormalUnit = 1, kAlbedoUnit = 2, kNoiseUnit = 3,
                 kMaskUnit = 6;
constexpr GLint kSurfaceLocation = 11;
constexpr float kReceives = 1.0f, kAlwaysLit = 0.5f;  // as shaders/pass/common/surface.glsl reads them

}  // namespace

Screen::Screen(const CasterScene& casters)
    : casters_(casters),
      surfaces_(make_program("pass/gbuffer/gbuffer.vert", {"pass/gbuffer/gbuffer.frag", {"extra/none"}})),
      frame_buffer_(make_buffer()),
      filter_buffer_(make_buffer()),
      no_vertices_(make_vertex_array()) {
  glNamedBufferStorage(frame_buffer_.name(), sizeof(FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferStorage(filter_buffer_.name(), sizeof(FilterBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
  targets.resize(1, 1);
}

void Screen::upload(const FrameBlock& frame, const FilterBlock& filtering) noexcept {
  glNamedBufferSubData(frame_buffer_.name(), 0, sizeof frame, &frame);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBinding, frame_buffer_.name());
  upload(filtering);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFilterBinding, filter_buffer_.name());
}

void Screen::upload(const FilterBlock& filtering) noexcept {
  glNamedBufferSubData(filter_buffer_.name(), 0, sizeof filtering, &filtering);
}

SurfacePass Screen::surfaces() const noexcept {
  return {targets.surfaces_fbo.name(), &surfaces_};
}

bool Screen::draw_surfaces(const SurfacePass& by, const glm::dvec3& camera_world,
                           const FrameBlock& frame) noexcept {
  const Seen now{by.fbo,        by.program->name(),
                 by.choice,     {targets.width, targets.height},
                 camera_world,  frame.clip_from_camera_relative,
                 frame.forward, casters_.buffers.changes()};
  if (now == seen_) return false;
  seen_ = now;
  glBindFramebuffer(GL_FRAMEBUFFER, by.fbo);
  glViewport(0, 0, targets.width, targets.height);
  constexpr std::array<float, 4> kNothing{};
  for (GLint i = 0; i < 3; ++i) glClearNamedFramebufferfv(by.fbo, GL_COLOR, i, kNothing.data());
  constexpr float kFarthestReversed = 0.0f;
  glClearNamedFramebufferfv(by.fbo, GL_DEPTH, 0, &kFarthestReversed);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glBindVertexArray(casters_.buffers.vertex_array());
  casters_.buffers.use(SceneBuffers::Placed::for_camera);
  glUseProgram(by.program->name());
  const std::span<const Batch> batches = casters_.buffers.batches();
  for (const BatchRange& range : casters_.lists.camera()) {
    const Batch& batch = batches[range.batch];
    batch.double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    glFrontFace(batch.mirrored ? GL_CW : GL_CCW);
    bind_material(batch);
    glUniform1f(kSurfaceLocation, batch.receives ? kReceives : kAlwaysLit);
    casters_.lists.draw(range.begin, range.end);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  return true;
}

void Screen::bind_surfaces() const noexcept {
  glBindTextureUnit(kPositionUnit, targets.position.name());
  glBindTextureUnit(kNormalUnit, targets.normal.name());
  glBindTextureUnit(kAlbedoUnit, targets.albedo.name());
}

void Screen::fullscreen(GLuint fbo, const Program& program) const noexcept {
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  glViewport(0, 0, targets.width, targets.height);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(no_vertices_.name());
  bind_surfaces();
  glUseProgram(program.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Screen::bind_mask() const noexcept {
  glBindTextureUnit(kMaskUnit, targets.mask.name());
}

void Screen::bind_noise(SampleNoise noise) {
  if (noise != SampleNoise::blue) return;
  if (!noise_tile_) {
    const std::vector<float> values = blue_noise();
    noise_tile_ = pixel_image(GL_R32F, kBlueNoiseSide, kBlueNoiseSide);
    glTextureSubImage2D(noise_tile_.name(), 0, 0, 0, kBlueNoiseSide, kBlueNoiseSide, GL_RED, GL_FLOAT,
                        values.data());
  }
  glBindTextureUnit(kNoiseUnit, noise_tile_.name());
  glBindSampler(kNoiseUnit, 0);
}

}  // namespace gnomon::render
