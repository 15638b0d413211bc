// The surfaces that a page plan is made for: points of a drawn frame, and the feedback on each.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// Surfaces at every few pixels of every few rows.
struct VisibleSurfaces {
  /// Pixels between two points.
  static constexpr int kStride = 3;

  Camera camera;
  std::vector<glm::dvec3> points;     ///< world space
  std::vector<glm::dvec3> normals;    ///< of the points, turned to the viewer; empty where none were read
  std::vector<std::uint32_t> pixels;  ///< of the points, row by row from the top
  std::vector<bool> depth_edges;      ///< by point: view depth jumps beside its pixel
};

/// As Renderer::positions() and normals() have them. `normals`: nullptr where none are wanted.
[[nodiscard]] VisibleSurfaces visible_surfaces(const FloatImage& positions, const FloatImage* normals,
                                               const Camera& camera);
/// Draws the camera's surfaces without a map, and reads them with their normals. Cached maps and pages stay:
/// `layer` is the depth layer that they hold. Throws RenderError.
[[nodiscard]] VisibleSurfaces draw_surfaces(render::Renderer& renderer, const Camera& camera,
                                            render::DepthLayer layer);

/// PageFeedback of each point before anything was rendered: depth edges where the policy reads them.
[[nodiscard]] std::vector<std::uint8_t> first_feedback(const VisibleSurfaces& visible,
                                                       const PagePolicy& policy);
/// PageFeedback of each point from the visibility of each pixel, now and in the frame before. `before`: empty
/// where there is none, and every point counts as changed.
[[nodiscard]] std::vector<std::uint8_t> feedback_of(const VisibleSurfaces& visible,
                                                    const std::vector<float>& lit,
                                                    const std::vector<float>& before);

}  // namespace gnomon::tool
