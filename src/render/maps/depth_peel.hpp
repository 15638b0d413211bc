// How are the first and the second surface of a map kept apart until the map's own depth is known?
#pragma once

#include <cstdint>

#include "frame/target.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/render/depth_layer.hpp"

namespace gnomon::render {

/// What a peeled map stores, beside its two surfaces.
struct PeeledDepth {
  DepthLayer layer = DepthLayer::second;
  double curve = 0.0, limit = 0.0;  ///< as depth_of_layer takes them
};

/// One depth peel: casters are drawn a second time, behind the surface that the map holds by then.
class DepthPeel {
 public:
  /// Throws RenderError.
  DepthPeel();
  /// Takes the map's texels as the first surface, and makes ready to draw casters behind it.
  void begin(const MapTargets& maps, int layer, const TexelRect& at);
  /// Writes what the layer stores over the map's texels.
  void finish(const MapTargets& maps, int layer, const TexelRect& at, const PeeledDepth& depth,
              GLuint no_vertices) noexcept;

  [[nodiscard]] const Program& opaque() const noexcept { return opaque_; }
  [[nodiscard]] const Program& masked() const noexcept { return masked_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept;

 private:
  Program opaque_, masked_, store_;
  Texture first_, second_;
  Framebuffer fbo_;
  int width_ = 0, height_ = 0;
};

}  // namespace gnomon::render
