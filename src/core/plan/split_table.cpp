// What one map over the body between two view depths comes to, for a search over splits.
#include "plan/split_table.hpp"

#include <utility>

#include "geometry/vector.hpp"
#include "warp/along_view.hpp"
#include "warp/registry.hpp"

namespace gnomon {

bool SplitTable::serves(const PlanContext& c) noexcept {
  return c.options.warp.focus.empty() && !(c.options.split.pseudo_near > 0.0);
}

SplitTable::SplitTable(const PlanContext& c, const ParallelScene& scene) noexcept
    : c_(c), warped_(!is_unwarped(scene.warp)), least_(c.camera.near_depth) {
  for (const Polytope::Vertex& v : scene.body.vertices()) {
    const glm::dvec3 p = scene.space.frame.turned(v.position);
    vertex_[vertices_++] = {p.x, p.y, glm::dot(c.axes.forward, v.position)};
  }
  for (std::size_t i = 0; i < vertices_; ++i) {
    for (const std::uint8_t other : scene.body.vertex[i].neighbour) {
      if (other <= i || edges_ == edge_.size()) continue;
      auto& edge = edge_[edges_++] = {static_cast<std::uint8_t>(i), other};
      if (vertex_[other].depth < vertex_[i].depth) std::swap(edge[0], edge[1]);
    }
  }
}

const SplitTable::Cut& SplitTable::cut(double depth) noexcept {
  for (std::size_t i = 0; i < cuts_; ++i) {
    if (cut_[i].depth == depth) return cut_[i];
  }
  // The oldest makes room.
  Cut& cut = cut_[next_];
  next_ = (next_ + 1) % cut_.size();
  cuts_ = cuts_ < cut_.size() ? cuts_ + 1 : cuts_;
  cut.depth = depth;
  cut.count = 0;
  for (std::size_t i = 0; i < edges_ && cut.count < cut.point.size(); ++i) {
    const Point &a = vertex_[edge_[i][0]], &b = vertex_[edge_[i][1]];
    if (!(a.depth < depth && depth < b.depth)) continue;
    const double part = (depth - a.depth) / (b.depth - a.depth);
    cut.point[cut.count++] = {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, depth};
  }
  return cut;
}

double SplitTable::cost(double begin, double end) noexcept {
  const DepthRange range = c_.seen == nullptr ? DepthRange{begin, end} : seen_between(*c_.seen, begin, end);
  if (range.empty()) return 0.0;
  AlongView view(c_.options.warp.objective, 0.0);
  std::size_t count = 0;
  const auto add = [&](const Point& p) {
    view.add(p.x, p.y, c_.camera.orthographic ? 1.0 : max_of(least_, p.depth));
    ++count;
  };
  for (std::size_t i = 0; i < vertices_; ++i) {
    if (vertex_[i].depth >= range.begin && vertex_[i].depth <= range.end) add(vertex_[i]);
  }
  // One after the other: the second may take the first one's place.
  for (const double depth : {range.begin, range.end}) {
    const Cut& at = cut(depth);
    for (std::size_t i = 0; i < at.count; ++i) add(at.point[i]);
  }
  if (count == 0) return 0.0;
  return warped_ ? view.quick().value : view.unwarped();
}

}  // namespace gnomon
