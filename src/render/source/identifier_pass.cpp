// Programs and images of identifiers.
#include "source/identifier_pass.hpp"

#include <array>
#include <vector>

#include "gl/program.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {
namespace {

// Bindings and locations as the shaders state them.
constexpr GLuint kFirstTriangleBinding = 5, kSeenByLightUnit = 8, kSeenByCameraUnit = 9;
constexpr GLint kByTriangleLocation = 9, kNeighboursLocation = 1;

constexpr std::uint32_t kNoCaster = 0xffff'ffff;  // pass/common/identifier.glsl

Buffer first_triangles(const SceneBuffers& scene) {
  std::vector<std::uint32_t> first;
  std::uint64_t count = 0;
  for (std::uint32_t i = 0; i < scene.boxes().size(); ++i) {
    first.push_back(scene.casts(i) ? static_cast<std::uint32_t>(count) : kNoCaster);
    count += scene.triangles_of(i);
  }
  constexpr std::uint64_t kMost = 0xffff'fffe;  // 0 is none
  if (count > kMost)
    throw RenderError("identifiers: the instances have " + std::to_string(count) +
                      " triangles, more than 32 bits can number");
  first.push_back(static_cast<std::uint32_t>(count));
  return filled_buffer(first);
}

}  // namespace

IdentifierPass::IdentifierPass(const SceneBuffers& scene) {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
  if (blocks < 1)
    throw RenderError("identifiers need a storage buffer in fragment shaders; this driver has none");
  first_triangle_ = first_triangles(scene);
  opaque_ = make_caster_program("alpha/opaque", "depth/identified");
  masked_ = make_caster_program("alpha/masked", "depth/identified");
  surfaces_ = make_program("pass/gbuffer/gbuffer.vert", {"pass/gbuffer/gbuffer.frag", {"extra/identifiers"}});
  mask_ =
      make_screen_program({"pass/mask/mask.frag", {"source/maps", "read/identifiers", filter_part("hard")}});
}

std::uint64_t IdentifierPass::bytes() const noexcept {
  constexpr std::uint64_t kBytes = 4;
  return kBytes * static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_) *
         static_cast<std::uint64_t>(layers_);
}

bool IdentifierPass::fit(const MapTargets& maps) {
  if (width_ == maps.width && height_ == maps.height && layers_ == maps.layers) return false;
  width_ = maps.width;
  height_ = maps.height;
  layers_ = maps.layers;
  maps_ = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(maps_.name(), 1, GL_R32UI, width_, height_, layers_);
  glTextureParameteri(maps_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(maps_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  fbo_ = make_framebuffer();
  return true;
}

void IdentifierPass::use(IdentifierOf of) const noexcept {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFirstTriangleBinding, first_triangle_.name());
  const std::array<GLuint, 3> programs{opaque_.name(), masked_.name(), surfaces_.name()};
  for (const GLuint program : programs)
    glProgramUniform1i(program, kByTriangleLocation, of == IdentifierOf::triangle ? 1 : 0);
}

void IdentifierPass::attach(const MapTargets& maps, int layer) const noexcept {
  glNamedFramebufferTextureLayer(fbo_.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0, layer);
  glNamedFramebufferTextureLayer(fbo_.name(), GL_COLOR_ATTACHMENT0, maps_.name(), 0, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
}

void IdentifierPass::clear() const noexcept {
  constexpr float kFarthest = 1.0f;
  constexpr std::array<GLuint, 4> kNone{};
  glClearNamedFramebufferfv(fbo_.name(), GL_DEPTH, 0, &kFarthest);
  glClearNamedFramebufferuiv(fbo_.name(), GL_COLOR, 0, kNone.data());
}

void IdentifierPass::bind(GLuint seen_by_camera, int neighbours) const noexcept {
  glBindTextureUnit(kSeenByLightUnit, maps_.name());
  glBindSampler(kSeenByLightUnit, 0);
  glBindTextureUnit(kSeenByCameraUnit, seen_by_camera);
  glBindSampler(kSeenByCameraUnit, 0);
  glProgramUniform1i(mask_.name(), kNeighboursLocation, neighbours);
}

}  // namespace gnomon::render
