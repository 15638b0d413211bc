// What is wrong with an engine's shadow maps, how much, where, and what would mend it?
#include "judge/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

constexpr std::array<std::string_view, kFindingKinds> kNames{
    "transposed",       "light_direction",   "depth_reversed",   "mirrored",        "texture_space",
    "depth_convention", "receivers_outside", "receivers_cut",    "casters_cut",     "selection_disagrees",
    "gap_between_maps", "density_step",      "map_unseen",       "texels_unseen",   "atlas_overlap",
    "atlas_outside",    "filter_leaves_map", "matrix_precision", "depth_precision", "bias_small",
    "bias_large",       "swimming",          "density_jump"};

Box bounds_of(const std::vector<glm::dvec3>& points) {
  Box box;
  for (const glm::dvec3& point : points) box.extend(point);
  return box;
}

/// One frame as the next one needs it.
struct JudgedFrame {
  SeenSurfaces seen;
  std::vector<LightLooks> looks;  // by light
  std::vector<BrokenMaps> broken;
};

std::unique_ptr<JudgedFrame> judge_frame(const Capture& capture, const CapturedFrame& frame,
                                         const JudgedFrame* before, FindingList& out) {
  const CapturedScene& scene = capture.scenes[frame.scene];
  auto judged = std::make_unique<JudgedFrame>();
  judged->seen = seen_surfaces(frame, scene);
  for (std::size_t light = 0; light < frame.lights.size(); ++light) {
    judged->looks.push_back(looks_of(capture, frame, scene, judged->seen, static_cast<int>(light)));
    const LightLooks& looks = judged->looks.back();
    BrokenMaps& broken = judged->broken.emplace_back(looks.map.size(), false);
    check_matrices(capture, looks, broken, out);
    check_cover(capture, looks, broken, out);
    check_neighbours(capture, looks, broken, out);
    check_precision(capture, looks, broken, out);
    check_bias(capture, looks, broken, out);
    if (before != nullptr && light < before->looks.size())
      check_motion(capture, before->looks[light], looks, broken, out);
  }
  return judged;
}

double error_at(const ShadowPlan& plan, const Camera& camera, const glm::dvec3& point, double depth) {
  const int map = map_serving(plan, point, depth);
  if (map < 0) return std::numeric_limits<double>::infinity();
  const PointAliasing m = measure_perspective(plan.map[static_cast<std::size_t>(map)], camera, point);
  if (m.status == PointAliasing::Status::outside) return std::numeric_limits<double>::infinity();
  return m.status == PointAliasing::Status::ok ? m.perspective_max : -1.0;
}

/// The points that the light may light, and that maps are to serve.
SeenSurfaces lit_part(const SeenSurfaces& seen, const LightLooks& looks) {
  SeenSurfaces lit;
  lit.guessed = seen.guessed;
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    lit.points.push_back(seen.points[p]);
    lit.depths.push_back(seen.depths[p]);
    lit.pixels.push_back(seen.pixels[p]);
    if (!seen.normals.empty()) lit.normals.push_back(seen.normals[p]);
  }
  return lit;
}

LightFigures figures_of(const Capture& capture, const CapturedFrame& frame, const SeenSurfaces& seen,
                        int light) {
  LightFigures figures;
  figures.light = light;
  const ShadowPlan plan = plan_of(capture, frame, light);
  figures.maps = plan.map_count;
  for (const ShadowMap& map : plan.maps()) figures.texels += std::int64_t{map.width} * map.height;
  const CapturedScene& scene = capture.scenes[frame.scene];
  const View view{.camera = frame.camera, .points_world = seen.points};
  figures.error = measure(plan, view, {});
  for (int i = 0; i < plan.map_count; ++i) {
    MeasureOptions one;
    one.map = i;
    figures.of_map.push_back(measure(plan, view, {}, one));
  }
  const ShadowPlan beside = plan_beside(capture, frame, scene, seen, light, Fit::tight);
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    SeenError& at = figures.seen.emplace_back();
    at.pixel = seen.pixels[p];
    at.m = error_at(plan, frame.camera, seen.points[p], seen.depths[p]);
    if (beside.status == PlanStatus::ok)
      at.planned_m = error_at(beside, frame.camera, seen.points[p], seen.depths[p]);
  }
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    const ShadowPlan of_fit = plan_beside(capture, frame, scene, seen, light, fit);
    if (of_fit.status != PlanStatus::ok) continue;
    LightFigures::Planned& planned = figures.planned.emplace_back();
    planned.fit = to_string(fit);
    planned.maps = of_fit.map_count;
    for (const ShadowMap& map : of_fit.maps()) planned.texels += std::int64_t{map.width} * map.height;
    planned.error = measure(of_fit, view, {});
  }
  return figures;
}

}  // namespace

std::string_view to_string(FindingKind kind) noexcept {
  return kNames[static_cast<std::size_t>(kind)];
}

bool is_waste(FindingKind kind) noexcept {
  return kind == FindingKind::map_unseen || kind == FindingKind::texels_unseen;
}

std::string digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

std::string percent(double share) {
  return digits(100.0 * share) + " %";
}

Finding finding_of(FindingKind kind, const LightLooks& looks, int map, double size, std::string_view unit,
                   std::optional<glm::dvec2> pixel) {
  Finding finding;
  finding.kind = kind;
  finding.light = looks.light;
  finding.map = map < 0 ? -1 : static_cast<int>(looks.map[static_cast<std::size_t>(map)]);
  finding.size = size;
  finding.unit = unit;
  finding.pixel = pixel;
  return finding;
}

std::string map_name(const LightLooks& looks, std::size_t map) {
  return "map " + std::to_string(looks.map[map]);
}

void FindingList::add(Finding finding) {
  finding.frame = frame_;
  for (Known& known : known_) {
    const Finding& before = known.finding;
    if (before.kind != finding.kind || before.light != finding.light || before.map != finding.map) continue;
    // Several of one frame count once.
    const int frames = before.frames + (known.last_frame == frame_ ? 0 : 1);
    if (finding.size > before.size) known.finding = finding;
    known.finding.frames = frames;
    known.last_frame = frame_;
    return;
  }
  known_.push_back({finding, frame_});
}

std::vector<Finding> FindingList::sorted() const {
  std::vector<Finding> all;
  for (const Known& known : known_) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const Finding& f) {
      return f.kind == known.finding.kind && f.light == known.finding.light;
    });
    if (same == all.end()) {
      all.push_back(known.finding);
      continue;
    }
    // The largest speaks for all.
    Finding other = known.finding;
    if (other.size > same->size) std::swap(other, *same);
    std::swap(other.also, same->also);
    same->also.insert(same->also.end(), other.also.begin(), other.also.end());
    same->also.push_back(other.map);
    std::sort(same->also.begin(), same->also.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Finding& a, const Finding& b) { return a.kind < b.kind; });
  return all;
}

ShadowPlan plan_of(const Capture& capture, const CapturedFrame& frame, int light) {
  ShadowPlan plan;
  plan.status = PlanStatus::ok;
  plan.origin_world = frame.camera.position;
  plan.clip_space = capture.clip_space;
  plan.selection = frame.selection;
  const Light& source = frame.lights[static_cast<std::size_t>(light)];
  plan.light_direction = travel_at(source, frame.camera.position);
  for (const CapturedMap& captured : frame.maps) {
    if (captured.light != light) continue;
    ShadowMap& map = plan.map[static_cast<std::size_t>(plan.map_count)] = ShadowMap{};
    map.clip_from_world = captured.clip_from_world;
    map.clip_from_camera_relative =
        glm::mat4(captured.clip_from_world * glm::translate(glm::dmat4(1.0), frame.camera.position));
    map.depth_begin = captured.begin;
    map.depth_end = captured.end;
    map.overlap = captured.overlap;
    map.cascade = plan.map_count++;
    map.width = captured.width;
    map.height = captured.height;
    map.warp = &warps::none;
    if (const auto* sun = std::get_if<DirectionalLight>(&source)) {
      map.light_world = glm::dvec4(-glm::normalize(sun->direction), 0.0);
    } else if (const auto* spot = std::get_if<SpotLight>(&source)) {
      map.light_world = glm::dvec4(spot->position, 1.0);
      plan.light_direction = glm::normalize(spot->direction);
    } else {
      map.light_world = glm::dvec4(std::get<PointLight>(source).position, 1.0);
    }
  }
  return plan;
}

ShadowPlan plan_beside(const Capture& capture, const CapturedFrame& frame, const CapturedScene& scene,
                       const SeenSurfaces& seen, int light, Fit fit) {
  std::int64_t texels = 0;
  int maps = 0;
  double end = 0.0, filter = 0.0;
  for (const CapturedMap& map : frame.maps) {
    if (map.light != light) continue;
    texels += std::int64_t{map.width} * map.height;
    ++maps;
    end = std::max(end, map.end);
    filter = std::max(filter, map.filter_texels);
  }
  PlanOptions options;
  if (maps == 0) return ShadowPlan{};
  options.cascades = maps;
  options.fit = fit;
  const double side = std::sqrt(static_cast<double>(texels) / maps);
  options.resolution.max_size = std::clamp(static_cast<int>(side), kLeastMapSize, kMaxMapSize);
  options.clip_space = capture.clip_space;
  options.filter.texels = std::min(filter, 0.25 * options.resolution.max_size);
  // Shadows end where the engine's do.
  Camera camera = frame.camera;
  if (std::isfinite(end) && end > camera.near_depth) camera.far_depth = std::min(camera.far_depth, end);
  const std::array<Box, 1> round{bounds_of(seen.points)};
  const Boxes points(round);
  const Boxes receivers = scene.receivers.empty() ? points : Boxes(scene.receivers);
  const Boxes casters = scene.casters.empty() ? receivers : Boxes(scene.casters);
  // Not by the points: a plan for them serves nothing between them, and here they are far apart.
  return make_plan(camera, frame.lights[static_cast<std::size_t>(light)], {casters, receivers}, options);
}

Judgement judge(const Capture& capture) {
  Judgement judgement;
  FindingList findings;
  std::unique_ptr<JudgedFrame> before;
  for (std::size_t f = 0; f < capture.frames.size(); ++f) {
    const CapturedFrame& frame = capture.frames[f];
    findings.begin_frame(static_cast<int>(f));
    std::unique_ptr<JudgedFrame> now = judge_frame(capture, frame, before.get(), findings);
    if (f == 0) {
      const auto lights_nothing = [](const LightLooks& looks) {
        return std::none_of(looks.lit.begin(), looks.lit.end(), [](char lit) { return lit != 0; });
      };
      if (!now->seen.points.empty() && std::any_of(now->looks.begin(), now->looks.end(), lights_nothing))
        judgement.notes.push_back(
            "A light lights nothing that is in view: only the matrices of its maps could be looked at.");
      if (now->seen.points.empty())
        judgement.notes.push_back(
            "Neither points nor receivers are in view: only the matrices of maps could be looked at.");
      else if (now->seen.guessed)
        judgement.notes.push_back("The receivers' boxes stand for surfaces: visible points would say more.");
      if (!now->seen.points.empty() && now->seen.normals.empty())
        judgement.notes.push_back("Points have no normals: the bias was not checked.");
      if (std::any_of(frame.maps.begin(), frame.maps.end(),
                      [](const CapturedMap& map) { return map.stores_back; }))
        judgement.notes.push_back(
            "Maps store back faces: their bias was not checked, as the thickness of casters is not known.");
      if (capture.scenes[frame.scene].casters.empty())
        judgement.notes.push_back("There are no casters: nothing says whether near planes cut any.");
      for (std::size_t light = 0; light < frame.lights.size(); ++light)
        judgement.lights.push_back(
            figures_of(capture, frame, lit_part(now->seen, now->looks[light]), static_cast<int>(light)));
    }
    before = std::move(now);
  }
  if (capture.frames.size() == 1)
    judgement.notes.push_back("There is one frame: nothing says whether edges are stable.");
  judgement.findings = findings.sorted();
  return judgement;
}

}  // namespace gnomon::judge
