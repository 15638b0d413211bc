// Shadows of many lights: their maps in one pool, and the sum of their light.
#pragma once

#include <cstdint>
#include <vector>

#include "source/frame_source.hpp"
#include "source/light_lists.hpp"
#include "source/page_runs.hpp"

namespace gnomon::render {

/// The light of all lights, pixel by pixel, and what adds to it.
struct LightSum {
  LightSum();
  /// Reallocates the image where the size differs.
  void resize(int new_width, int new_height);

  Program add, finish;
  Texture image;
  Framebuffer fbo, mask_and_sum_fbo;
  int width = 0, height = 0;  ///< 0: no frame yet
};

class PoolSource final : public FrameSource {
 public:
  /// Throws RenderError.
  PoolSource(CasterScene& casters, CasterPass& pass, MapTargets& maps, Screen& screen);

  static const SourceSupport kSupport;

  [[nodiscard]] FrameOptionSet supports(const FrameJob& frame) const noexcept override;
  [[nodiscard]] SourceSteps steps(const FrameJob& frame) const noexcept override;
  void begin(FrameJob& frame) override;
  void update(FrameJob& frame) override;
  [[nodiscard]] SurfacePass surfaces() const noexcept override;
  void mask(FrameJob& frame, GLuint fbo) override;
  void shade(FrameJob& frame) override;
  void count(FrameJob& frame) override;
  void lose() noexcept override;

  [[nodiscard]] const LightSum& sum() const noexcept { return sum_; }

 private:
  /// Lists the maps of lights that are due, or all where the pool lost them.
  void list_maps(FrameJob& frame);
  /// Adds all lights that panes do not tint, by clusters. False, with nothing drawn, where lists cannot be
  /// made or are not wanted.
  [[nodiscard]] bool add_clustered(FrameJob& frame, GLuint mask);
  /// Adds one light, through a mask of its own in `fbo`, and through panes where they tint it.
  void add_light(FrameJob& frame, std::size_t index, GLuint fbo);
  /// Finds the lights that panes tint.
  void mark_tinted(const FrameJob& frame);

  CasterScene& casters_;
  CasterPass& pass_;
  MapTargets& maps_;
  Screen& screen_;
  LightSum sum_;
  LightLists lists_;
  // What the pool holds.
  bool holds_ = false;
  DepthKind kind_;
  // One frame's.
  std::vector<DrawnPage> due_;         ///< maps to draw
  std::vector<std::size_t> light_of_;  ///< by map to draw
  std::vector<std::uint8_t> tinted_;   ///< by light: panes tint it, and it is added by itself
  PaneRoom pane_room_;                 ///< for the pane maps of any of these
};

}  // namespace gnomon::render
