// Is each pixel of a mask that is decided what exact geometry says?
#include "check_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <variant>
#include <vector>

#include "decided.hpp"
#include "gnomon/trace/reference.hpp"
#include "gnomon/trace/transmittance.hpp"

namespace gnomon::stress {
namespace {

// Weights of up to a few hundred texels, added in float.
constexpr float kWeights = 1e-4f;

/// Surfaces in one plane, of which one receives shadows: rounding says which of them the picture shows.
/// Points of pictures lie off their triangles by less than this, of their distance from the eye.
void leave_out_ambiguous(const trace::Tracer& tracer, const std::vector<WorldTriangle>& triangles,
                         const glm::dvec3& eye, trace::SurfacePoints& points) {
  constexpr double kOffPlane = 1e-4;
  for (trace::SurfacePoint& point : points.pixels) {
    if (point.state != trace::PixelState::facing) continue;
    const glm::dvec3 p = point.position - eye;
    const glm::dvec3 off(kOffPlane * glm::length(p));
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (tracer.receives(t) == point.receives) continue;
      const auto& [a, b, c] = triangles[t].corner;
      const bool beside = glm::any(glm::lessThan(p, glm::min(a, glm::min(b, c)) - off)) ||
                          glm::any(glm::greaterThan(p, glm::max(a, glm::max(b, c)) + off));
      if (beside) continue;
      const glm::dvec3 across = glm::cross(b - a, c - a);
      if (std::abs(glm::dot(across, p - a)) <= off.x * glm::length(across))
        point.state = trace::PixelState::undecided;
    }
  }
}

/// What a pixel is held against.
struct Truth {
  trace::Tracer tracer;
  trace::SurfacePoints points;
  trace::HardReference hard;
  std::vector<WorldTriangle> triangles;

  explicit Truth(FrameStage& stage)
      : tracer(stage.opaque(), trace::Engine::own),
        points(trace::surface_points(tracer, stage.camera(), stage.setting().input.light,
                                     stage.keeping().positions(), stage.keeping().normals())),
        triangles(world_triangles(stage.opaque(), stage.camera().position)) {
    leave_out_ambiguous(tracer, triangles, stage.camera().position, points);
    hard = trace::hard_reference(tracer, points, stage.setting().input.light);
  }
};

std::string at(const FrameStage& stage, const Truth& truth, std::size_t pixel) {
  const glm::dvec3& p = truth.points.pixels[pixel].position;
  const auto width = static_cast<std::size_t>(stage.camera().width);
  std::ostringstream text;
  text.precision(7);
  text << " at pixel " << pixel % width << ", " << pixel / width << " (" << p.x << ", " << p.y << ", " << p.z
       << ")";
  return text.str();
}

/// Whether a map's shape bends lines. A pool of many lights then counts it as none, and identifiers are drawn
/// from depths.
bool bends_lines(const FrameStage& stage) {
  if (stage.by_pages()) return false;
  const std::span<const ShadowMap> maps = stage.maps().maps();
  return std::any_of(maps.begin(), maps.end(), [](const ShadowMap& map) { return !map.shape->affine; });
}

/// How far the filter's look-ups read, texels: the kernel's box, what blurred texels reach, and the four that
/// are weighed together.
double reach_of(const FrameSetting& setting, const ShadowMap& map, bool by_identifiers) {
  const render::FilterInfo& info = setting.filter.filter->info;
  if (by_identifiers) return setting.source.test.neighbours + 0.5;
  double radius = info.has_kernel ? setting.filter.radius + 0.5 : 0.5;
  if (info.has_kernel && setting.filter.unit == render::KernelUnit::world)
    radius = std::min(setting.filter.radius / std::min(map.texel_world.x, map.texel_world.y) * 2.0,
                      render::kMaxRadiusTexels);
  return radius + info.lookup_reach_texels + 0.5;
}

/// The maps or pages of the frame in the space of which pixels are decided, made as they are needed.
class Spaces {
 public:
  Spaces(const FrameStage& stage, const Truth& truth) : stage_(stage), truth_(truth) {}
  [[nodiscard]] const ShadowMap& map(int index) { return at(index).map; }
  [[nodiscard]] Must decide(int index, const Receiver3& receiver) {
    const Entry& entry = at(index);
    const FrameSetting& setting = stage_.setting();
    const bool by_identifiers =
        setting.source.kind == render::SourceKind::identifiers && !bends_lines(stage_);
    const auto comparing = [&](bool identifiers) {
      return Comparing{reach_of(setting, entry.map, identifiers), setting.options.linear_depth, bias()};
    };
    if (by_identifiers) {
      const Must must = entry.space->decide_identifier(
          receiver, comparing(true), setting.source.test.of == render::IdentifierOf::triangle);
      if (truth_.triangles[receiver.triangle].casts) return must;
      // Surfaces that cast no shadow are in no map, and are compared by depth. Where another lies in their
      // plane, the picture may show that one.
      const Must by_depth = entry.space->decide(receiver, comparing(false));
      return by_depth == Must::lit && must != Must::lit ? Must::undecided : by_depth;
    }
    const render::Filter& filter = *setting.filter.filter;
    if (filter.info.reads != render::MapRead::depth)
      return entry.space->decide_even(receiver, comparing(false), filter.reference.contact);
    return entry.space->decide(receiver, comparing(false));
  }

 private:
  struct Entry {
    ShadowMap map;
    std::unique_ptr<MapSpace> space;
  };
  [[nodiscard]] const BiasOptions& bias() const {
    return stage_.by_pages() ? stage_.pages().bias : stage_.maps().bias;
  }
  const Entry& at(int index) {
    Entry& entry = entries_[index];
    if (entry.space != nullptr) return entry;
    const auto i = static_cast<std::size_t>(index);
    entry.map = stage_.by_pages() ? page_map(stage_.pages(), stage_.pages().pages[i]) : stage_.maps().map[i];
    const ClipSpace& clip = stage_.by_pages() ? stage_.pages().clip_space : stage_.maps().clip_space;
    entry.space = std::make_unique<MapSpace>(entry.map, clip, stage_.camera().position,
                                             stage_.setting().input.light, truth_.triangles);
    return entry;
  }

  const FrameStage& stage_;
  const Truth& truth_;
  std::map<int, Entry> entries_;
};

Receiver3 receiver_of(const FrameStage& stage, const Truth& truth, const FloatImage& normals,
                      std::size_t pixel) {
  const trace::SurfacePoint& p = truth.points.pixels[pixel];
  const glm::dvec3 seen(normals.values[4 * pixel], normals.values[4 * pixel + 1],
                        normals.values[4 * pixel + 2]);
  return {p.position - stage.camera().position, p.normal, p.triangle, glm::length(seen - p.normal),
          std::abs(p.above)};
}

/// Other maps than the one that the mask names, which a transition may have read.
std::vector<int> others_read(const FrameStage& stage, int map) {
  const ShadowPlan& plan = stage.maps();
  if (stage.setting().options.transition == render::SplitTransition::cut || stage.by_pages() ||
      plan.selection != MapSelection::view_depth)
    return {};
  std::vector<int> maps;
  if (map + 1 < plan.map_count && plan.map[static_cast<std::size_t>(map) + 1].overlap > 0.0)
    maps.push_back(map + 1);
  return maps;
}

/// What the mask must be, by all maps that may have been read.
Must must_be(const FrameStage& stage, Spaces& spaces, int map, const Receiver3& receiver) {
  const Must must = spaces.decide(map, receiver);
  for (const int other : others_read(stage, map)) {
    if (must == Must::undecided || spaces.decide(other, receiver) != must) return Must::undecided;
  }
  return must;
}

/// Which answers the source and the filter promise.
struct Promises {
  bool lit = false, dark = false;
  float tolerance = kWeights;
};
/// `warped`: the map that is read has a warp.
Promises promises_of(const FrameSetting& setting, bool by_depth, bool warped) {
  // Every layer stores the first surface or one behind it; rules that are bounded may omit casters.
  const bool front = setting.options.depth_layer == render::DepthLayer::front;
  const bool all_drawn = !setting.options.prune.has(PruneRule::small_casters);
  switch (setting.source.kind) {
    case render::SourceKind::irregular:
      return {};
    case render::SourceKind::identifiers:
      if (!by_depth) return {true, all_drawn};
      break;
    default:
      break;
  }
  if (setting.filter.contacts) return {};
  // Rays that are marched may pass between casters of different depths.
  const render::Filter& filter = *setting.filter.filter;
  // PCF of radius 0 compares four texels with one depth, off the plane by the slant that a warp gives a
  // texel, which is as much as any caster's height.
  const bool one_depth = &filter == &render::filters::pcf && setting.filter.radius == 0.0;
  const bool stored = filter.info.reads != render::MapRead::depth;
  const double off = stored ? filter.reference.tolerance : 0.0;
  return {front || !stored, front && all_drawn && &filter != &render::filters::smrt && !(one_depth && warped),
          kWeights + static_cast<float>(off)};
}

/// Casters near a local light may have been given up, which the plan says.
bool gives_up_casters(const FrameStage& stage) {
  const std::span<const Omission> omitted =
      stage.by_pages() ? stage.pages().omitted() : stage.maps().omitted();
  return std::any_of(omitted.begin(), omitted.end(), [](const Omission& o) {
    return o.kind == OmissionKind::depth_near_light || o.kind == OmissionKind::receiver_near_light;
  });
}

void check_pixel(FrameStage& stage, const Truth& truth, Spaces& spaces, const FloatImage& normals,
                 std::size_t pixel, float visibility, int map, FrameReport& report) {
  const trace::Verdict hard = truth.hard.pixels[pixel];
  if (map < 0) {
    ++report.counts().unserved;
    const bool may_be_dark =
        gives_up_casters(stage) ||
        (stage.setting().source.kind == render::SourceKind::lights && bends_lines(stage));
    if (visibility < 1.0f - kWeights || (hard == trace::Verdict::shadow && !may_be_dark))
      report.add(
          "unserved_in_shadow", 1.0,
          "no map serves the surface; the mask is " + std::to_string(visibility) + at(stage, truth, pixel));
    return;
  }
  if (!truth.points.pixels[pixel].receives) {
    ++report.counts().lit;
    if (!(visibility >= 1.0f - kWeights))
      report.add("mask_dark", 1.0 - static_cast<double>(visibility),
                 "the surface receives no shadow; the mask is " + std::to_string(visibility) +
                     at(stage, truth, pixel));
    return;
  }
  const trace::SurfacePoint& point = truth.points.pixels[pixel];
  const bool warped = !stage.by_pages() && stage.maps().map[static_cast<std::size_t>(map)].kappa != 0.0;
  const Promises promised =
      promises_of(stage.setting(), bends_lines(stage) || !truth.triangles[point.triangle].casts, warped);
  if (!promised.lit && !promised.dark) return;
  const Must must = must_be(stage, spaces, map, receiver_of(stage, truth, normals, pixel));
  if (must == Must::lit && promised.lit) {
    ++report.counts().lit;
    if (!(visibility >= 1.0f - promised.tolerance))
      report.add("mask_dark", 1.0 - static_cast<double>(visibility),
                 "nothing is before the surface; the mask is " + std::to_string(visibility) + ", map " +
                     std::to_string(map) + at(stage, truth, pixel));
  }
  if (must == Must::dark && promised.dark && !gives_up_casters(stage)) {
    ++report.counts().dark;
    if (!(visibility <= promised.tolerance))
      report.add("mask_lit", static_cast<double>(visibility),
                 "casters cover the surface; the mask is " + std::to_string(visibility) + ", map " +
                     std::to_string(map) + at(stage, truth, pixel));
  }
}

/// The rounding of lists and of the places that they are handed, world units: light_frames states it of a
/// scene's size and the distance to the light. Rays are far finer.
double list_rounding(const Truth& truth, const FrameStage& stage) {
  constexpr double kRounding = 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon());
  const Light& light = stage.setting().input.light;
  const glm::dvec3& eye = stage.camera().position;
  double size = 0.0;
  for (const WorldTriangle& t : truth.triangles)
    for (const glm::dvec3& corner : t.corner) size = std::max(size, glm::length(corner));
  double away = 0.0;
  if (const auto* spot = std::get_if<SpotLight>(&light)) away = glm::length(spot->position - eye);
  if (const auto* point = std::get_if<PointLight>(&light)) away = glm::length(point->position - eye);
  // A scene is as wide as twice its farthest corner.
  return kRounding * (3.0 * size + away);
}

/// The same points, moved by more than lists round: to six sides, and along their rays by twice of what lists
/// lift them. An answer that holds at all of them is one that lists promise.
std::vector<trace::SurfacePoints> moved_points(const Truth& truth, const FrameStage& stage) {
  const double off = 4.0 * list_rounding(truth, stage);
  std::vector<trace::SurfacePoints> all;
  for (const glm::dvec3& by :
       {glm::dvec3(off, 0, 0), {-off, 0, 0}, {0, off, 0}, {0, -off, 0}, {0, 0, off}, {0, 0, -off}}) {
    trace::SurfacePoints& moved = all.emplace_back(truth.points);
    for (trace::SurfacePoint& p : moved.pixels) p.position += by;
  }
  // Lists lift a point off its plane by no more than their rounding, however slowly its ray leaves it.
  trace::SurfacePoints& later = all.emplace_back(truth.points);
  for (trace::SurfacePoint& p : later.pixels) p.above -= 0.5 * off;
  return all;
}

/// One sample by lists: each pixel that rays decide.
void check_exact(FrameStage& stage, const Truth& truth, const FloatImage& mask,
                 const std::vector<trace::SurfacePoints>& round, FrameReport& report) {
  std::vector<trace::HardReference> beside;
  for (const trace::SurfacePoints& points : round)
    beside.push_back(trace::hard_reference(truth.tracer, points, stage.setting().input.light));
  for (std::size_t i = 0; i < truth.hard.pixels.size(); ++i) {
    const trace::Verdict hard = truth.hard.pixels[i];
    if (hard != trace::Verdict::lit && hard != trace::Verdict::shadow) continue;
    const bool sure = std::all_of(beside.begin(), beside.end(),
                                  [&](const trace::HardReference& r) { return r.pixels[i] == hard; });
    if (!sure) continue;
    ++report.counts().exact;
    const bool lit = mask.values[2 * i] > 0.5f;
    if (lit != (hard == trace::Verdict::lit))
      report.add(
          "exact_mask_wrong", 1.0,
          std::string(lit ? "lit by lists, dark" : "dark by lists, lit") + " by rays" + at(stage, truth, i));
  }
}

/// The light that panes leave. A pixel counts where the rays beside its own agree.
void check_panes(FrameStage& stage, const Truth& truth, const std::vector<trace::SurfacePoints>& round,
                 FrameReport& report) {
  constexpr double kAbsorbance = 2e-3;  // in whole steps, and exponents of them
  const trace::PaneTracer panes(stage.panes());
  const Light& light = stage.setting().input.light;
  const FloatImage found = stage.keeping().transmittance();
  const trace::PaneReference middle = trace::pane_reference(panes, truth.points, light);
  std::vector<trace::PaneReference> beside;
  for (const trace::SurfacePoints& points : round)
    beside.push_back(trace::pane_reference(panes, points, light));
  for (std::size_t i = 0; i < middle.pixels.size(); ++i) {
    if (truth.hard.pixels[i] != trace::Verdict::lit) continue;
    const bool sure = std::all_of(beside.begin(), beside.end(), [&](const trace::PaneReference& r) {
      return r.pixels[i] == middle.pixels[i];
    });
    if (!sure) continue;
    ++report.counts().panes;
    for (int c = 0; c < 3; ++c) {
      const double apart = std::abs(found.values[3 * i + static_cast<std::size_t>(c)] - middle.pixels[i][c]);
      if (!(apart <= kAbsorbance))
        report.add("pane_light_wrong", apart,
                   "panes leave " + std::to_string(middle.pixels[i][c]) + " by rays, drawn " +
                       std::to_string(found.values[3 * i + static_cast<std::size_t>(c)]) +
                       at(stage, truth, i));
    }
  }
}

}  // namespace

void check_mask(FrameStage& stage, FrameReport& report) {
  const Truth truth(stage);
  const FloatImage mask = stage.keeping().mask(), normals = stage.keeping().normals();
  const bool exact = stage.setting().source.kind == render::SourceKind::irregular;
  Spaces spaces(stage, truth);
  for (std::size_t i = 0; i < truth.points.pixels.size(); ++i) {
    const float visibility = mask.values[2 * i];
    if (!(visibility >= 0.0f && visibility <= 1.0f + kWeights))
      report.add("mask_not_in_unit", std::abs(static_cast<double>(visibility)),
                 "the mask is " + std::to_string(visibility) + at(stage, truth, i));
    if (truth.points.pixels[i].state != trace::PixelState::facing) continue;
    ++report.counts().pixels;
    if (!exact)
      check_pixel(stage, truth, spaces, normals, i, visibility, static_cast<int>(mask.values[2 * i + 1]),
                  report);
  }
  if (!exact || stage.setting().source.samples != 1) return;
  const std::vector<trace::SurfacePoints> round = moved_points(truth, stage);
  check_exact(stage, truth, mask, round, report);
  if (!stage.panes().instances.empty()) check_panes(stage, truth, round, report);
}

}  // namespace gnomon::stress
