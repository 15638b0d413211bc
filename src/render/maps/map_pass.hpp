// The depth passes of a plan's maps: kept texels move, static casters come beneath, the rest is drawn over
// them.
#pragma once

#include <optional>

#include "frame/target.hpp"
#include "maps/caster_pass.hpp"
#include "maps/layered_maps.hpp"

namespace gnomon::render {

/// Draws what the scene's draw lists hold for the maps of a plan.
class MapPass {
 public:
  MapPass(CasterScene& casters, CasterPass& pass, MapTargets& maps);

  /// What the context and the options allow; compiles the programs with the first frame that needs them.
  [[nodiscard]] LayeredRule layered_rule(const FrameOptions& options) noexcept;
  /// Brings the maps up to date, once the draw lists are those of the plan.
  void draw(const ShadowPlan& plan, const DrawnMaps& drawn, const DepthDraw& how) noexcept;

 private:
  void draw_part(const DrawnPart& part, const DrawnMap& map, const DepthDraw& how) noexcept;
  /// The maps that the draw lists joined, in one pass.
  void draw_layered(const DrawnMaps& drawn, const DepthDraw& how) noexcept;
  /// Brings the maps of static casters up to date; whole copies go to the maps of all casters.
  void draw_static(int map_count, const DrawnMaps& drawn, const DepthDraw& how) noexcept;
  /// Draws static depths into the layer that is attached; the viewport is left as it is here.
  void copy_static(const DrawLists::Copies& copies, int layer, glm::ivec2 viewport) noexcept;

  CasterScene& casters_;
  CasterPass& pass_;
  MapTargets& maps_;
  std::optional<LayeredPrograms> layered_;     ///< none until a frame wants them
  bool can_layer_ = false, software_ = false;  ///< of the context
  Program copy_depth_;
  VertexArray no_vertices_;
};

}  // namespace gnomon::render
