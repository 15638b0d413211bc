// The surfaces that a page plan is made for: points of a drawn frame, and the feedback on each.
#include "visible_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::tool {
namespace {

// A shadow edge: the mask differs by this from a pixel within reach of the next point.
constexpr float kEdge = 0.25f;

/// Whether the view depth of a pixel is off a neighbour's by more than a tenth of the nearer one.
bool is_depth_edge(const FloatImage& positions, int x, int y) {
  constexpr float kJump = 1.1f;
  const auto depth = [&](int column, int row) {
    const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(positions.width) +
                       static_cast<std::size_t>(column);
    return positions.values[4 * pixel + 3];
  };
  const float own = depth(x, y);
  for (const auto& [column, row] :
       {std::pair(x - 1, y), std::pair(x + 1, y), std::pair(x, y - 1), std::pair(x, y + 1)}) {
    if (column < 0 || row < 0 || column >= positions.width || row >= positions.height) continue;
    const float other = depth(column, row);
    if (own > kJump * other || other > kJump * own) return true;
  }
  return false;
}

/// Least and largest value in the square round a pixel that ends half way to the next point.
std::pair<float, float> range_round(const std::vector<float>& values, int width, int height, int pixel) {
  constexpr int kReach = VisibleSurfaces::kStride / 2 + 1;
  const int x = pixel % width, y = pixel / width;
  float least = values[static_cast<std::size_t>(pixel)], most = least;
  for (int row = std::max(y - kReach, 0); row <= std::min(y + kReach, height - 1); ++row) {
    for (int column = std::max(x - kReach, 0); column <= std::min(x + kReach, width - 1); ++column) {
      const float value = values[static_cast<std::size_t>(row * width + column)];
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  return {least, most};
}

}  // namespace

VisibleSurfaces visible_surfaces(const FloatImage& positions, const FloatImage* normals,
                                 const Camera& camera) {
  VisibleSurfaces visible;
  visible.camera = camera;
  for (int y = 0; y < positions.height; y += VisibleSurfaces::kStride) {
    for (int x = 0; x < positions.width; x += VisibleSurfaces::kStride) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(positions.width) +
                         static_cast<std::size_t>(x);
      const float* const at = positions.values.data() + 4 * pixel;
      if (!(at[3] > 0.0f) || !std::isfinite(at[3])) continue;
      visible.points.push_back(camera.position + glm::dvec3(at[0], at[1], at[2]));
      visible.pixels.push_back(static_cast<std::uint32_t>(pixel));
      visible.depth_edges.push_back(is_depth_edge(positions, x, y));
      if (normals == nullptr) continue;
      const float* const facing = normals->values.data() + 4 * pixel;
      visible.normals.emplace_back(facing[0], facing[1], facing[2]);
    }
  }
  return visible;
}

VisibleSurfaces draw_surfaces(render::Renderer& renderer, const Camera& camera, render::DepthLayer layer) {
  render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  surfaces.depth_layer = layer;
  renderer.draw(ShadowPlan{}, camera, renderer.prepare(render::filters::hard), surfaces);
  const FloatImage normals = renderer.normals();
  return visible_surfaces(renderer.positions(), &normals, camera);
}

std::vector<std::uint8_t> first_feedback(const VisibleSurfaces& visible, const PagePolicy& policy) {
  std::vector<std::uint8_t> feedback(visible.points.size(), 0);
  if ((policy.feedback & kDepthEdge) == 0) return feedback;
  for (std::size_t i = 0; i < feedback.size(); ++i) feedback[i] = visible.depth_edges[i] ? kDepthEdge : 0;
  return feedback;
}

std::vector<std::uint8_t> feedback_of(const VisibleSurfaces& visible, const std::vector<float>& lit,
                                      const std::vector<float>& before) {
  std::vector<std::uint8_t> feedback(visible.points.size(), 0);
  for (std::size_t i = 0; i < feedback.size(); ++i) {
    const std::uint32_t pixel = visible.pixels[i];
    const auto [least, most] =
        range_round(lit, visible.camera.width, visible.camera.height, static_cast<int>(pixel));
    feedback[i] = most - least > kEdge ? kShadowEdge : 0;
    if (before.empty() || std::abs(lit[pixel] - before[pixel]) > kEdge) feedback[i] |= kShadowChanged;
  }
  return feedback;
}

}  // namespace gnomon::tool
