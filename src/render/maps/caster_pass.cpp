// Casters into depths: front, back, bent and peeled.
#include "maps/caster_pass.hpp"

#include <algorithm>

#include "filter/filter_block.hpp"
#include "gl/program.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {
namespace {

// Bindings and locations as the shaders state them.
constexpr GLint kBaseColorLocation = 1, kAlphaCutoffLocation = 2, kClipLocation = 3, kSheetLocation = 5,
                kShapeLocation = 7, kSizeLocation = 8, kEvenScaleLocation = 10;
constexpr GLuint kColorImageUnit = 3;

}  // namespace

void bind_material(const Batch& batch) noexcept {
  glBindTextureUnit(kColorImageUnit, batch.texture);
  glBindSampler(kColorImageUnit, batch.sampler);
  glUniform4fv(kBaseColorLocation, 1, &batch.base_color.x);
  glUniform1f(kAlphaCutoffLocation, batch.alpha_cutoff);
}

bool is_sheet(const Batch& batch) noexcept {
  return batch.double_sided || batch.masked;
}

DepthKind depth_kind(const FrameOptions& options, bool linear) noexcept {
  const bool limited = options.depth_layer == DepthLayer::dual;
  return {options.depth_layer, limited ? options.dual_limit_texels : 0.0, linear};
}

DepthDraw depth_draw(const FrameOptions& options) noexcept {
  const double limit = options.dual_limit_texels;
  return {options.prune.has(PruneRule::alpha_test), options.depth_layer, limit > 0.0 ? limit : 0.0};
}

DepthDraw DepthDraw::of(const DrawnMap& map) const noexcept {
  DepthDraw how = *this;
  how.even_scale = map.even_scale;
  return how;
}

PeeledDepth DepthDraw::peeled(const ShadowPlan& plan, const ShadowMap& map) const noexcept {
  const double texel = std::max(map.texel_world.x, map.texel_world.y), range = map.depth_range_world;
  return {layer, even_scale > 0.0f ? 0.0 : depth_curve(plan, map),
          range > 0.0 ? dual_limit_texels * texel / range : 0.0};
}

CasterPass::CasterPass(CasterScene& casters)
    : casters_(casters),
      opaque_(make_caster_program("alpha/opaque", "depth/plain")),
      masked_(make_caster_program("alpha/masked", "depth/plain")),
      even_(make_caster_program("alpha/opaque", "depth/even")),
      even_masked_(make_caster_program("alpha/masked", "depth/even")),
      no_vertices_(make_vertex_array()) {}

CasterPass::BentPrograms::BentPrograms()
    : opaque(make_program("pass/depth/depth.vert", "pass/depth/bent.geom",
                          {"pass/depth/depth.frag", {"alpha/opaque", "depth/bent"}})),
      masked(make_program("pass/depth/depth.vert", "pass/depth/bent.geom",
                          {"pass/depth/depth.frag", {"alpha/masked", "depth/bent"}})) {}

void CasterPass::begin() const noexcept {
  glBindVertexArray(casters_.buffers.vertex_array());
  casters_.buffers.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
}

void CasterPass::draw(const DrawnPart& part, const glm::mat4& clip_from_position,
                      const DepthDraw& how) noexcept {
  const bool even = how.even_scale > 0.0f;
  const CasterPrograms by{even ? even_ : opaque_, even ? even_masked_ : masked_};
  draw_layer(part, by, is_mirrored(clip_from_position), how, [&] {
    glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &clip_from_position[0][0]);
    if (even) glUniform1f(kEvenScaleLocation, how.even_scale);
  });
}

void CasterPass::draw_bent(const DrawnPart& part, const DrawnMap& map,
                           bool alpha_test_where_masked) noexcept {
  if (!bent_) {
    try {
      bent_.emplace();
    } catch (const RenderError&) {
      return;  // A lost context compiles nothing; who drew the frame finds out from the context.
    }
  }
  draw_by(part, CasterPrograms{bent_->opaque, bent_->masked}, alpha_test_where_masked, [&] {
    glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &map.clip_from_position[0][0]);
    glUniformMatrix4fv(kShapeLocation, 1, GL_FALSE, &map.shape[0][0]);
    glUniform2f(kSizeLocation, static_cast<float>(map.width), static_cast<float>(map.height));
    glUniform1f(kEvenScaleLocation, map.even_scale);
  });
}

void CasterPass::peel(const MapTargets& maps, int layer, const TexelRect& at, const DrawnPart& part,
                      const glm::mat4& clip_from_position, const DepthDraw& how,
                      const PeeledDepth& depth) noexcept {
  peel_.begin(maps, layer, at);
  draw_by(
      part, CasterPrograms{peel_.opaque(), peel_.masked(), -1, true}, how.alpha_test_where_masked,
      [&] {
        glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &clip_from_position[0][0]);
        glUniform1f(kEvenScaleLocation, how.even_scale);
      },
      [](const Batch& batch) { glUniform1i(kSheetLocation, is_sheet(batch) ? 1 : 0); });
  peel_.finish(maps, layer, at, depth, no_vertices_.name());
  glBindVertexArray(casters_.buffers.vertex_array());
}

}  // namespace gnomon::render
