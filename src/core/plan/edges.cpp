// Which view depths a plan covers, and where it divides them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "geometry/body.hpp"
#include "geometry/first_hits.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/study/formulas.hpp"
#include "lanes/elementary.hpp"
#include "lanes/point_pair.hpp"
#include "map/context.hpp"
#include "map/gain.hpp"
#include "plan/cascades.hpp"
#include "split/optimal.hpp"
#include "split/seen_splits.hpp"
#include "warp/along_view.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

/// The body's vertices and edges across a parallel light, and where they cross the depths that were asked
/// about.
class SplitTable {
 public:
  /// False where only cut bodies tell: a focus, or a pseudo-near depth.
  [[nodiscard]] static bool serves(const PlanContext& c) noexcept;
  SplitTable(const PlanContext& c, const ParallelScene& scene) noexcept;
  /// Error of one map over the part of the body between two depths, with LiSPSM at its best strength as the
  /// measure: every warp of this toolkit comes near it or betters it by about the same factor everywhere.
  [[nodiscard]] double cost(double begin, double end) noexcept;

 private:
  struct Point {
    double x, y, depth;
  };
  struct Cut {
    double depth = 0.0;
    std::array<Point, kMaxVertices> point;
    std::size_t count = 0;
  };
  [[nodiscard]] const Cut& cut(double depth) noexcept;

  const PlanContext& c_;
  bool warped_;
  double least_;  // depth that error counts from
  std::array<Point, kMaxVertices> vertex_;
  std::size_t vertices_ = 0;
  std::array<std::array<std::uint8_t, 2>, kMaxVertices * 3 / 2> edge_;  // nearer end first
  std::size_t edges_ = 0;
  std::array<Cut, 24> cut_;  // of the latest depths
  std::size_t cuts_ = 0, next_ = 0;
};

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
  const DepthRange range =
      c_.visible_depths == nullptr ? DepthRange{begin, end} : visible_range(*c_.visible_depths, begin, end);
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

/// The end of the depths that any receiver may have, whatever the cameras look at.
double end_in_reach(const PlanContext& c) noexcept {
  double aside = 0.0;
  for (const SharedView& view : c.views) aside = max_of(aside, glm::length(view.eye));
  return clamp_to(depth_in_reach(c.camera, c.bounds.receivers, aside), c.camera.near_depth,
                  c.camera.far_depth);
}

/// Depths that hold receivers in view, or that may hold any, or all of the camera's. `body`: of the receivers
/// in view.
DepthRange received_depths(const PlanContext& c, const DepthRange& body) noexcept {
  const double n = c.camera.near_depth, f = c.camera.far_depth;
  if (c.options.split.range == SplitRange::camera) return {n, f};
  if (c.how.divides_reach) return {n, end_in_reach(c)};
  const double low = min_of(body.begin, f), high = max_of(body.end, n);
  // A flat scene's depth must not fall outside its own range by rounding: of the depth itself, and of the
  // frustum's far corners that it was cut from.
  constexpr double kRounding = 1e-12, kCutting = 4e-16;
  const double cutting = kCutting * std::abs(f);
  const double begin = clamp_to(low - kRounding * std::abs(low) - cutting, n, f);
  return {begin, clamp_to(high + kRounding * std::abs(high) + cutting, begin, f)};
}

void report_depths(CascadeEdges& edges, OmissionKind kind, double begin, double end) noexcept {
  // Saving less than this share of the depths is not worth a line.
  constexpr double kWorthReporting = 0.01;
  if (end > begin * (1.0 + kWorthReporting))
    edges.omission[static_cast<std::size_t>(edges.omission_count++)] = {kind, -1, begin, end, 0};
}

/// The body between two depths, less what is not visible at the ends.
Polytope between(const PlanContext& c, const Polytope& body, double from, double to) noexcept {
  const DepthRange range =
      c.visible_depths == nullptr ? DepthRange{from, to} : visible_range(*c.visible_depths, from, to);
  Polytope part = body;
  if (range.empty()) {
    part.vertex_count = 0;
    return part;
  }
  clip_to_slab(part, c.axes.forward, range.begin, range.end);
  return part;
}

/// Of two maps side by side.
double joined(Objective objective, double a, double b) noexcept {
  return counts_texels(objective) ? a + b : max_of(a, b);
}

/// Error of one map over the part of the body between two depths, with LiSPSM at its best strength as the
/// measure: every warp of this toolkit comes near it or betters it by about the same factor everywhere.
double simple_error(const PlanContext& c, const ParallelScene& scene, double begin, double end) noexcept {
  const Polytope part = between(c, scene.body, begin, end);
  if (part.empty()) return 0.0;
  Polytope focus;
  const LightBody points = judged_body(c, request_for(scene, part, begin, end), focus);
  WarpInput in{};
  in.body = points.points();
  in.y_min = in.y_max = points.point[0].y;
  for (const WarpInput::Point& p : in.body) {
    in.y_min = min_of(in.y_min, p.y);
    in.y_max = max_of(in.y_max, p.y);
  }
  in.orthographic = c.camera.orthographic;
  in.objective = c.options.warp.objective;
  const bool warped = !is_unwarped(scene.warp);
  return warp_error(in, warped ? warps::lispsm.choose(in).kappa : 0.0).value(in.objective);
}

/// What all maps together come to.
struct JointObjective {
  double value = 0.0;
  double unwarped = 0.0;  // without any warp
};

/// The objective of all maps together by the error itself, with LiSPSM in the place of a warp that takes a
/// longer search.
JointObjective exact_objective(const PlanContext& c, const ParallelScene& asked,
                               std::span<const double> edges) noexcept {
  const bool searched = is_searched(asked.warp);
  const ParallelScene scene{asked.body, asked.depths, asked.space, searched ? warps::lispsm : asked.warp};
  JointObjective total;
  for (std::size_t m = 0; m + 1 < edges.size(); ++m) {
    Polytope part = between(c, scene.body, edges[m], edges[m + 1]);
    clip_part(part, c.bounds.receivers, c.camera.position);
    if (part.empty()) continue;
    const FocusedObjective one = focused_objective(c, request_for(scene, part, edges[m], edges[m + 1]));
    total = {joined(c.options.warp.objective, total.value, one.value),
             joined(c.options.warp.objective, total.unwarped, one.unwarped)};
  }
  return total;
}

// Frames from one search to the next. Edges move by a hundredth in a frame: they follow what is found for
// many frames.
constexpr std::int64_t kSearchEdgesEvery = 4;

/// Edges, and what the maps between them come to.
struct JudgedEdges {
  std::array<double, kMaxMaps + 1> depth;
  JointObjective objective;
};

/// Moves the edges to the best ones by the simplified error. Out of line: the exact one need not make room
/// for the table.
[[gnu::noinline]] void search_edges(const PlanContext& c, const ParallelScene& scene,
                                    std::span<double> depths) noexcept {
  SplitTable table(c, scene);
  const bool by_table = SplitTable::serves(c);
  const auto cost = [&](double begin, double end) {
    return by_table ? table.cost(begin, end) : simple_error(c, scene, begin, end);
  };
  const auto both = [&](double a, double b) { return joined(c.options.warp.objective, a, b); };
  search_splits(depths, cost, both);
  refine_splits(depths, cost, both);
}

/// The best edges by the simplified error, from those that `edges` gives.
JudgedEdges searched_edges(const PlanContext& c, const ParallelScene& scene,
                           std::span<const double> edges) noexcept {
  JudgedEdges result{};
  std::copy(edges.begin(), edges.end(), result.depth.begin());
  const std::span<double> depths{result.depth.data(), edges.size()};
  search_edges(c, scene, depths);
  result.objective = exact_objective(c, scene, depths);
  return result;
}

/// Sets the inner edges to the best ones of an earlier frame. False where they are too old, or of other
/// depths.
bool reuse_searched(const PlanHistory::SearchedEdges& searched, std::int64_t frame,
                    std::span<double> edges) noexcept {
  constexpr double kAlike = 1.05;
  const auto count = static_cast<std::size_t>(searched.count);
  if (frame >= searched.until || count != edges.size()) return false;
  const std::span<const double> depth(searched.depth.data(), count);
  const auto alike = [](double a, double b) { return a <= b * kAlike && b <= a * kAlike; };
  const bool inside = edges.front() < depth[1] && depth[count - 2] < edges.back();
  if (!inside || !alike(edges.front(), depth.front()) || !alike(edges.back(), depth.back())) return false;
  std::copy(depth.begin() + 1, depth.end() - 1, edges.begin() + 1);
  return true;
}

void optimise(const PlanContext& c, const ParallelScene& scene, std::span<double> edges) noexcept {
  if (edges.size() < 3 || !(edges.front() > 0.0 && edges.back() > edges.front())) return;
  JudgedEdges best = searched_edges(c, scene, edges);
  // The search goes by a simplified error; what counts is the exact one.
  JointObjective least = exact_objective(c, scene, edges);
  const auto keep_better = [&] {
    if (!(best.objective.value < least.value)) return;
    least = best.objective;
    std::copy_n(best.depth.begin(), edges.size(), edges.begin());
  };
  keep_better();
  // Edges searched for a warp that gains little may be worse than edges searched without one. A warp that is
  // searched for gains more than the one that stands for it.
  const double gains_enough = is_searched(scene.warp) ? 0.99 : 0.7;
  if (is_unwarped(scene.warp) || least.value < gains_enough * least.unwarped) return;
  const ParallelScene plain{scene.body, scene.depths, scene.space, warps::none};
  best = searched_edges(c, plain, edges);
  keep_better();
}

/// Moves the edges between cascades at most a small step from those of the last frame, `last` (empty: there
/// is none); the first and the last edge only give way slowly.
void steady_edges(std::span<const double> last, std::span<double> edges) noexcept {
  // Largest change from frame to frame, of the logarithm.
  constexpr double kEdgeStep = 0.01;
  const auto count = edges.size();
  if (last.size() != count) return;
  const double slower = elementary::exp(-kEdgeStep), faster = elementary::exp(kEdgeStep);
  const auto near = [&](double to, double from) { return clamp_to(to, from * slower, from * faster); };
  // What comes into view is covered at once.
  edges[0] = min_of(edges[0], near(edges[0], last[0]));
  edges[count - 1] = max_of(edges[count - 1], near(edges[count - 1], last[count - 1]));
  for (std::size_t i = 1; i + 1 < count; ++i)
    edges[i] = clamp_to(near(edges[i], last[i]), edges[i - 1], edges[count - 1]);
}

}  // namespace

DepthRange depths_of(const Polytope& body, const glm::dvec3& forward) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const DotPair along_view(forward);
  Pair low(kInfinity), high(-kInfinity);
  for_each_two<VertexPair>(body.vertices(), [&](std::size_t, const VertexPair& two) {
    const Pair depth = along_view(two);
    low = min_of(low, depth);
    high = max_of(high, depth);
  });
  return {min_of(low.low(), low.high()), max_of(high.low(), high.high())};
}

const VisibleDepths* usable_depths(const PlanContext& c, const DepthRange& body,
                                   const VisibleDepths* visible) noexcept {
  if (visible == nullptr) return nullptr;
  // Surfaces that are all no receivers, or a histogram of another scene, are as good as unknown.
  const DepthRange received = received_depths(c, body);
  return visible_range(*visible, received.begin, received.end).empty() ? nullptr : visible;
}

CascadeEdges cascade_edges(const PlanContext& c, const ParallelScene& scene, int cascades,
                           PlanHistory* history) noexcept {
  CascadeEdges result;
  result.count = cascades + 1;
  const std::span<double> edges{result.depth.data(), static_cast<std::size_t>(result.count)};
  const DepthRange received = received_depths(c, scene.depths);
  if (c.options.split.range != SplitRange::camera) {
    report_depths(result, OmissionKind::depth_without_receiver, c.camera.near_depth, received.begin);
    report_depths(result, OmissionKind::depth_without_receiver, received.end, c.camera.far_depth);
  }
  const DepthRange cover =
      c.visible_depths == nullptr ? received : visible_range(*c.visible_depths, received.begin, received.end);
  report_depths(result, OmissionKind::depth_not_visible, received.begin, cover.begin);
  report_depths(result, OmissionKind::depth_not_visible, cover.end, received.end);
  const SplitOptions& split = c.options.split;
  split_depths(cover.begin, cover.end, split, edges);
  const bool automatic = split.scheme == SplitScheme::automatic,
             optimal = split.scheme == SplitScheme::optimal;
  const bool logarithmic = automatic || optimal || split.scheme == SplitScheme::logarithmic;
  if (logarithmic && c.visible_depths != nullptr) split_visible(*c.visible_depths, cover, edges);
  if (automatic && c.visible_depths == nullptr && !c.seen.empty()) {
    std::array<double, SeenPoints::kMost> depths;
    std::size_t count = 0;
    for (const glm::dvec3& p : c.seen) depths[count++] = glm::dot(c.axes.forward, p);
    split_seen({depths.data(), count}, !c.visible_points.empty(), edges);
  }
  if (optimal && !(history != nullptr && reuse_searched(history->searched_edges, history->frame, edges))) {
    optimise(c, scene, edges);
    if (history != nullptr)
      history->searched_edges = {history->frame + kSearchEdgesEvery, result.depth, result.count};
  }
  // One visible depth is one slice: more of them would divide the safety round it. Over frames the number of
  // maps must not come and go with one pixel.
  const bool single =
      c.visible_depths != nullptr && c.visible_depths->min == c.visible_depths->max && !c.how.has_history;
  if (single && split.scheme != SplitScheme::given) {
    for (double& edge : edges.subspan(1)) edge = cover.end;
  }
  if (history != nullptr && history->frame > 0 && !c.how.stable)
    steady_edges({history->edge.data(), static_cast<std::size_t>(history->edge_count)}, edges);
  return result;
}

}  // namespace gnomon
