// Which maps of a frame are drawn in one pass, and with what?
#pragma once

#include <cstdint>

#include "gl/gl_object.hpp"
#include "gnomon/render/renderer.hpp"
#include "maps/drawn_maps.hpp"

namespace gnomon::render {

/// The object index of an instance holds its map from this bit on, as layered.vert reads it.
inline constexpr unsigned kMapShift = 28;
static_assert(kMaxMaps <= (1 << (32 - kMapShift)));

/// Programs that write gl_Layer in the vertex shader: compiled with the first frame that may use them.
struct LayeredPrograms {
  Program opaque, masked;
  Framebuffer fbo;  ///< all layers at once
  LayeredPrograms();
};

/// How the frame's maps are drawn, as far as the draw lists have to know.
struct LayeredRule {
  MapPasses passes = MapPasses::each;
  bool one_winding = false;  ///< faces are culled: maps that mirror the scene need a pass of their own
  bool software = false;     ///< the driver draws on the CPU
};

/// Whether one pass is expected to be faster, by the draw commands of all maps together. `software`: the
/// driver draws on the CPU.
[[nodiscard]] bool one_pass_is_faster(std::uint32_t draws_each, std::uint32_t draws_layered,
                                      bool software) noexcept;

}  // namespace gnomon::render
