// The pictures of a frame, from its surfaces and its mask: lit, the error, the error as colours, tinted.
#pragma once

#include <glm/vec3.hpp>

#include "frame/pane_pass.hpp"
#include "frame/screen.hpp"

namespace gnomon::render {

class PicturePass {
 public:
  explicit PicturePass(Screen& screen);

  /// The lit picture; with panes, in the light that they leave, and behind them. `panes`: nullptr: none.
  void shade(const FrameBlock& block, const glm::dvec3& camera_world, PanePass* panes);
  void aliasing() const noexcept;
  void heat_map() const noexcept;      ///< from aliasing()
  void cascade_tint() const noexcept;  ///< from shade()

 private:
  Screen& screen_;
  Program shade_, aliasing_, heat_, tint_;
};

}  // namespace gnomon::render
