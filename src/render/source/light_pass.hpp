// The sum of many lights, and the pool that their maps lie in.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gl/gl_object.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/render/renderer.hpp"
#include "source/light_lists.hpp"
#include "source/page_pool.hpp"
#include "frame/pane_pass.hpp"

namespace gnomon::render {

struct LightPass {
  LightPass();
  /// Makes the image of the sum anew where the size differs.
  void resize(int new_width, int new_height);

  Program add, finish;
  Texture sum;
  Framebuffer sum_fbo;
  Framebuffer mask_and_sum_fbo;
  int width = 0, height = 0;
  // Contents of the pool.
  bool holds = false;
  DepthLayer layer = DepthLayer::front;
  double limit_texels = 0.0;
  // For one frame.
  std::vector<DrawnPage> maps;        ///< to draw
  std::vector<std::size_t> light_of;  ///< by map to draw
  std::vector<std::uint8_t> tinted;   ///< by light: panes tint it, and it is added by itself
  PaneRoom pane_room;                 ///< for the pane maps of any of these
  std::uint64_t pane_texels = 0;      ///< FrameStats::pane_texels
  LightLists lists;
};

/// The pixels that a light can light, from the lower left corner; all of them for a sun.
[[nodiscard]] TexelRect lit_pixels(const Light& light, const Camera& camera) noexcept;

}  // namespace gnomon::render
