// Is a map the last frame's, but for rounding? The steady way to the best map computes it anew in each frame.
#include <cmath>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "map/history.hpp"

namespace gnomon {

void keep_last_bits(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept {
  // Of half a side: 8e-6 texels of the largest map, and what a matrix loses 1e6 sides from the origin.
  constexpr double kSame = 0x1p-30;
  ShadowMap& map = result.map;
  if (map.filter_margin_texels != request.last->filter_margin_texels) return;
  const glm::dmat4& last = request.last->gl_from_world;
  const glm::dmat4 now = counted_from(result.gl_from_world, c.camera.position),
                   change = counted_from(result.gl_from_world - last, c.camera.position);
  double least_w = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (const Polytope::Vertex& v : request.body.vertices()) {
    least_w = min_of(least_w, w_at(now, v.position));
    farthest = max_of(farthest, largest_component(v.position));
  }
  const double reach = farthest + map.depth_range_world;  // of what the map shows, casters included
  for (int row = 0; row < 4; ++row) {
    const double turned = std::abs(change[0][row]) + std::abs(change[1][row]) + std::abs(change[2][row]);
    if (!(std::abs(change[3][row]) + reach * turned <= kSame * least_w)) return;
  }
  result.gl_from_world = last;
  map.clip_from_world = clip_from_gl_clip(c.options.clip_space) * last;
}

}  // namespace gnomon
