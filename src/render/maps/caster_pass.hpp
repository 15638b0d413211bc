// How do casters become depths? The programs that draw them, and what differs from layer to layer.
#pragma once

#include <optional>
#include <span>

#include "casters/caster_scene.hpp"
#include "frame/target.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/render/frame_options.hpp"
#include "maps/depth_peel.hpp"
#include "maps/drawn_maps.hpp"

namespace gnomon::render {

/// Binds what the fragment shaders of casters and surfaces read of a batch.
void bind_material(const Batch& batch) noexcept;
/// A caster without thickness: see DepthLayer.
[[nodiscard]] bool is_sheet(const Batch& batch) noexcept;

/// Programs that draw casters, and where they take what differs from batch to batch.
struct CasterPrograms {
  const Program& opaque;
  const Program& masked;
  GLint wrap_location = -1;  ///< of the mask's image; -1: its sampler says it
  bool apart = false;        ///< sheets, solids and mirrored ones in draws of their own
};

/// Which depths maps hold: those of another kind cannot be kept.
struct DepthKind {
  DepthLayer layer = DepthLayer::front;
  double limit_texels = 0.0;  ///< of DepthLayer::dual, else 0
  bool linear = false;        ///< even along the light
  bool operator==(const DepthKind&) const = default;
};
[[nodiscard]] DepthKind depth_kind(const FrameOptions& options, bool linear) noexcept;

/// How the casters of a frame become the depths of its maps.
struct DepthDraw {
  bool alpha_test_where_masked = true;
  DepthLayer layer = DepthLayer::front;
  double dual_limit_texels = 0.0;
  float even_scale = 0.0f;  ///< DrawnMap::even_scale of the map that is drawn
  /// The same for one map.
  [[nodiscard]] DepthDraw of(const DrawnMap& map) const noexcept;
  /// What a peeled map of the plan stores.
  [[nodiscard]] PeeledDepth peeled(const ShadowPlan& plan, const ShadowMap& map) const noexcept;
};
[[nodiscard]] DepthDraw depth_draw(const FrameOptions& options) noexcept;

class CasterPass {
 public:
  explicit CasterPass(CasterScene& casters);

  /// Sets the state that drawing into depths begins with.
  void begin() const noexcept;
  /// Draws what the layer stores before it is peeled, into what is attached.
  void draw(const DrawnPart& part, const glm::mat4& clip_from_position, const DepthDraw& how) noexcept;
  /// Into a map whose shape bends lines: the first surface, whatever the layer.
  void draw_bent(const DrawnPart& part, const DrawnMap& map, bool alpha_test_where_masked) noexcept;
  /// From the first surface, which the texels of a layer hold, to what the layer stores.
  void peel(const MapTargets& maps, int layer, const TexelRect& at, const DrawnPart& part,
            const glm::mat4& clip_from_position, const DepthDraw& how, const PeeledDepth& depth) noexcept;
  /// Culls the faces that the layer does not store; `mirrored`: is_mirrored() of what `set_place` sets.
  template <class SetPlace>
  void draw_layer(const DrawnPart& part, const CasterPrograms& by, bool mirrored, const DepthDraw& how,
                  SetPlace&& set_place) const noexcept;
  /// `set_place` sets the uniforms that say where casters go, of the program that is in use; `set_batch`,
  /// with CasterPrograms::apart, what differs between sheets, solids and mirrored ones.
  template <class SetPlace, class SetBatch>
  void draw_by(const DrawnPart& part, const CasterPrograms& by, bool alpha_test_where_masked,
               SetPlace&& set_place, SetBatch&& set_batch) const noexcept;
  template <class SetPlace>
  void draw_by(const DrawnPart& part, const CasterPrograms& by, bool alpha_test_where_masked,
               SetPlace&& set_place) const noexcept {
    draw_by(part, by, alpha_test_where_masked, set_place, [](const Batch&) {});
  }
  [[nodiscard]] std::uint64_t scratch_bytes() const noexcept { return peel_.bytes(); }

 private:
  /// Programs for maps whose shape bends lines: compiled with the first such map.
  struct BentPrograms {
    BentPrograms();
    Program opaque, masked;
  };

  CasterScene& casters_;
  Program opaque_, masked_, even_, even_masked_;
  std::optional<BentPrograms> bent_;  ///< none until a map needs them, and where the context was lost by then
  DepthPeel peel_;
  VertexArray no_vertices_;
};

template <class SetPlace, class SetBatch>
void CasterPass::draw_by(const DrawnPart& part, const CasterPrograms& by, bool alpha_test_where_masked,
                         SetPlace&& set_place, SetBatch&& set_batch) const noexcept {
  const std::span<const Batch> batches = casters_.buffers.batches();
  const DrawLists& lists = casters_.lists;
  // Opaque batches come first in the order of batches, and their commands follow each other: one call draws
  // them.
  const std::span<const BatchRange> ranges = lists.ranges(part);
  std::size_t opaque = 0;
  while (alpha_test_where_masked && opaque < ranges.size() && !batches[ranges[opaque].batch].masked) ++opaque;
  if (opaque > 0) {
    glUseProgram(by.opaque.name());
    set_place();
    const auto alike = [&](std::size_t a, std::size_t b) {
      const Batch &one = batches[ranges[a].batch], &other = batches[ranges[b].batch];
      return !by.apart || (is_sheet(one) == is_sheet(other) && one.mirrored == other.mirrored);
    };
    for (std::size_t begin = 0, end = 0; begin < opaque; begin = end) {
      while (end < opaque && alike(begin, end)) ++end;
      set_batch(batches[ranges[begin].batch]);
      lists.draw(ranges[begin].begin, ranges[end - 1].end);
    }
  }
  if (opaque == ranges.size()) return;
  glUseProgram(by.masked.name());
  set_place();
  for (const BatchRange& range : ranges.subspan(opaque)) {
    const Batch& batch = batches[range.batch];
    bind_material(batch);
    set_batch(batch);
    glUniform2i(by.wrap_location, static_cast<GLint>(batch.wrap_u), static_cast<GLint>(batch.wrap_v));
    lists.draw(range.begin, range.end);
  }
}

template <class SetPlace>
void CasterPass::draw_layer(const DrawnPart& part, const CasterPrograms& by, bool mirrored,
                            const DepthDraw& how, SetPlace&& set_place) const noexcept {
  // Both sides cast: open and thin things have one side only, and the truth knows no sides.
  if (how.layer != DepthLayer::back) {
    draw_by(part, by, how.alpha_test_where_masked, set_place);
    return;
  }
  glCullFace(GL_FRONT);
  draw_by(part, CasterPrograms{by.opaque, by.masked, -1, true}, how.alpha_test_where_masked, set_place,
          [mirrored](const Batch& batch) {
            is_sheet(batch) ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
            glFrontFace(batch.mirrored != mirrored ? GL_CW : GL_CCW);
          });
  glCullFace(GL_BACK);
  glDisable(GL_CULL_FACE);
}

}  // namespace gnomon::render
