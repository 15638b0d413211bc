// What a frame's shadows are read from: the steps that a source takes part in, and what they share.
#pragma once

#include "casters/caster_scene.hpp"
#include "filter/stored_maps.hpp"
#include "frame/frame_block.hpp"
#include "frame/pane_pass.hpp"
#include "frame/screen.hpp"
#include "gnomon/render/renderer.hpp"
#include "maps/caster_pass.hpp"

namespace gnomon::render {

/// One frame, from what it is drawn by to what it was.
struct FrameJob {
  const Shadows& shadows;
  const ShadowPlan& plan;  ///< of maps; else one that holds the light of pages, or nothing
  const Camera& camera;    ///< as it is drawn
  const PreparedFilter& filter;
  const FrameOptions& options;
  FilterPrograms& programs;      ///< of the filter
  PanePass* panes;               ///< nullptr: none
  double far_depth;              ///< of the camera that was given
  FrameOptionSet asked = {};     ///< options that are in use
  FrameOptionSet honoured = {};  ///< of these, what the source supports
  FrameStats stats = {};
  // Written by FrameSource::begin().
  FrameBlock block = {};
  FilterBlock filtering = {};
  bool shaped = false;  ///< a map is not linear

  /// Whether the frame asks for the option and its source honours it.
  [[nodiscard]] bool draws(FrameOption option) const noexcept { return honoured.has(option); }
};

/// How a source takes part in the sequence, besides what every source does.
struct SourceSteps {
  bool takes_depths = true;    ///< what other sources stored is lost
  bool stores_texels = false;  ///< what the filter reads is made from depths: store()
  bool casters_last = false;   ///< update() comes after the mask: casters are tested against its pixels
  bool adds_light = false;     ///< mask() adds up light, through panes too, and shade() makes the picture
};

/// A source of shadows: one file. It brings what it stores up to date, writes the mask from it, states what
/// it honours, and counts what it did.
class FrameSource {
 public:
  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  [[nodiscard]] virtual FrameOptionSet supports(const FrameJob& frame) const noexcept = 0;
  [[nodiscard]] virtual SourceSteps steps(const FrameJob& frame) const noexcept = 0;
  /// Makes room, and writes the frame's blocks.
  virtual void begin(FrameJob& frame) = 0;
  /// Brings what is stored up to date.
  virtual void update(FrameJob& frame) = 0;
  /// What the camera's surfaces are drawn by.
  [[nodiscard]] virtual SurfacePass surfaces() const noexcept = 0;
  /// With SourceSteps::stores_texels: what the filter stores and blurs.
  virtual void store(FrameJob&) {}
  /// Writes the mask into a framebuffer.
  virtual void mask(FrameJob& frame, GLuint fbo) = 0;
  /// Without SourceSteps::adds_light: what panes leave of the light.
  virtual void tint(FrameJob&) {}
  /// With SourceSteps::adds_light: the picture.
  virtual void shade(FrameJob&) {}
  /// Adds to the statistics what was drawn, and what it takes.
  virtual void count(FrameJob& frame) = 0;
  /// What is stored was overwritten, or casters moved unseen.
  virtual void lose() noexcept {}
};

/// Whether the shape of a map bends lines.
[[nodiscard]] bool bends_lines(const ShadowPlan& plan) noexcept;

/// Whether static casters have depths of their own, beneath those that move: not where maps are peeled.
[[nodiscard]] bool composes(const FrameOptions& options) noexcept;

/// What panes leave of a plan's light, from maps of their own, in a part of the image.
void tint_from_maps(const Screen& screen, PanePass& panes, const ShadowPlan& plan, const DrawnMaps& drawn,
                    const Camera& camera, const TexelRect& part, const PanePass::MapDraw& how);

/// Draws the mask from the depths and stored texels that are bound, and frees the unit that pyramids share.
void draw_mask(const Screen& screen, const Program& program, GLuint fbo) noexcept;

/// The work of the draw lists for a map; peeled maps draw them twice.
[[nodiscard]] MapStats work_of_map(const DrawLists& lists, int map, DepthLayer layer) noexcept;

/// Counts savings and the surfaces pass, which every source counts alike.
void count_lists(const DrawLists& lists, FrameStats& stats) noexcept;

}  // namespace gnomon::render
