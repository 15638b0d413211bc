// What is wrong with an engine's shadow maps, how much, where, and what would mend it?
#include "judge/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "base/travel.hpp"
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
    if (check_depths(capture, looks, out)) {
      check_cover(capture, looks, broken, out);
      check_use(capture, looks, broken, out);
    }
    check_neighbours(capture, looks, broken, out);
    check_precision(capture, looks, broken, out);
    check_bias(capture, looks, broken, out);
    if (before != nullptr && light < before->looks.size())
      check_motion(capture, before->looks[light], looks, broken, out);
  }
  return judged;
}

}  // namespace

ShadowPlan plan_of(const Capture& capture, const CapturedFrame& frame, int light) {
  ShadowPlan plan;
  plan.status = PlanStatus::ok;
  plan.origin_world = frame.camera.position;
  plan.clip_space = capture.clip_space;
  plan.selection = frame.selection[static_cast<std::size_t>(light)];
  const Light& source = frame.lights[static_cast<std::size_t>(light)];
  plan.light_direction = travel_at(source, frame.camera.position);
  if (const auto* spot = std::get_if<SpotLight>(&source))
    plan.light_direction = glm::normalize(spot->direction);
  const glm::dvec4 towards = std::holds_alternative<DirectionalLight>(source)
                                 ? glm::dvec4(-plan.light_direction, 0.0)
                                 : glm::dvec4(position_of(source), 1.0);
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
    map.light_world = towards;
  }
  return plan;
}

namespace {

/// gnomon's plan for the frame's camera and light, with as many maps and texels.
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
  // Both are measured at the same points, so that those that no caster reaches have a map as well.
  options.prune = options.prune.without(PruneRule::casterless_cascades).without(PruneRule::casterless_faces);
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

std::int64_t texels_of(const ShadowPlan& plan) {
  std::int64_t texels = 0;
  for (const ShadowMap& map : plan.maps()) texels += std::int64_t{map.width} * map.height;
  return texels;
}

LightFigures figures_of(const Capture& capture, const CapturedFrame& frame, const SeenSurfaces& seen,
                        const LightLooks& looks) {
  LightFigures figures;
  figures.light = looks.light;
  figures.plan = plan_of(capture, frame, looks.light);
  figures.texels = texels_of(figures.plan);
  const View view{.camera = frame.camera, .points_world = seen.points};
  figures.error = measure(figures.plan, view, {});
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    MeasureOptions one;
    one.map = static_cast<int>(i);
    figures.of_map.push_back({static_cast<int>(looks.map[i]), measure(figures.plan, view, {}, one)});
  }
  const auto planned = [&](Fit fit) -> std::optional<LightFigures::Planned> {
    const ShadowPlan plan = plan_beside(capture, frame, capture.scenes[frame.scene], seen, looks.light, fit);
    if (plan.status != PlanStatus::ok) return std::nullopt;
    return LightFigures::Planned{fit, plan, texels_of(plan), measure(plan, view, {})};
  };
  figures.tight = planned(Fit::tight);
  figures.stable = planned(Fit::stable);
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    SeenError& at = figures.seen.emplace_back();
    at.pixel = seen.pixels[p];
    at.m = error_at(figures.plan, frame.camera, seen.points[p], seen.depths[p]);
    if (figures.tight)
      at.planned_m = error_at(figures.tight->plan, frame.camera, seen.points[p], seen.depths[p]);
  }
  return figures;
}

/// What the first frame leaves unknown.
std::vector<std::string> notes_on(const Capture& capture, const CapturedFrame& frame,
                                  const JudgedFrame& judged) {
  std::vector<std::string> notes;
  const SeenSurfaces& seen = judged.seen;
  const auto lights_nothing = [](const LightLooks& looks) {
    return std::none_of(looks.lit.begin(), looks.lit.end(), [](char lit) { return lit != 0; });
  };
  if (seen.points.empty()) {
    notes.emplace_back(
        "Neither points nor receivers are in view: only the matrices of maps could be looked at.");
  } else {
    if (std::any_of(judged.looks.begin(), judged.looks.end(), lights_nothing))
      notes.emplace_back(
          "A light lights nothing that is in view: only the matrices of its maps could be looked at.");
    if (seen.guessed)
      notes.emplace_back("The receivers' boxes stand for surfaces: visible points would say more.");
    if (seen.normals.empty()) notes.emplace_back("Points have no normals: the bias was not checked.");
  }
  if (std::any_of(frame.maps.begin(), frame.maps.end(),
                  [](const CapturedMap& map) { return map.stores_back; }))
    notes.emplace_back(
        "Maps store back faces: their bias was not checked, as the thickness of casters is not known.");
  if (capture.scenes[frame.scene].casters.empty())
    notes.emplace_back("There are no casters: nothing says whether near planes cut any.");
  if (capture.frames.size() == 1)
    notes.emplace_back("There is one frame: nothing says whether edges are stable.");
  return notes;
}

/// The point nearest to the middle of what the map serves in the image; of what the light lights for none.
std::optional<glm::dvec2> middle_of(const LightLooks& looks, std::optional<std::size_t> map) {
  const auto counts = [&](std::size_t p) {
    return looks.counts[p] != 0 && (!map || looks.chosen[p] == static_cast<int>(*map));
  };
  glm::dvec2 sum(0.0);
  double count = 0.0;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (!counts(p)) continue;
    sum += looks.seen->pixels[p];
    count += 1.0;
  }
  std::optional<glm::dvec2> nearest;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    const glm::dvec2& at = looks.seen->pixels[p];
    if (counts(p) && (!nearest || glm::distance(at, sum / count) < glm::distance(*nearest, sum / count)))
      nearest = at;
  }
  return nearest;
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

Finding finding_of(FindingKind kind, const LightLooks& looks, std::optional<std::size_t> map, double size,
                   std::string_view unit, std::optional<glm::dvec2> pixel) {
  Finding finding;
  finding.kind = kind;
  finding.light = looks.light;
  finding.map = map ? static_cast<int>(looks.map[*map]) : -1;
  finding.size = size;
  finding.unit = unit;
  finding.pixel = pixel ? pixel : middle_of(looks, map);
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

double share_missed(const AliasingStats& error) noexcept {
  const auto points = static_cast<double>(error.samples + error.outside);
  return points > 0.0 ? static_cast<double>(error.outside) / points : 0.0;
}

std::vector<const LightFigures::Planned*> LightFigures::planned() const {
  std::vector<const Planned*> all;
  for (const std::optional<Planned>* one : {&tight, &stable})
    if (*one) all.push_back(&**one);
  return all;
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
      judgement.notes = notes_on(capture, frame, *now);
      for (const LightLooks& looks : now->looks)
        judgement.lights.push_back(figures_of(capture, frame, lit_part(now->seen, looks), looks));
    }
    before = std::move(now);
  }
  judgement.findings = findings.sorted();
  return judgement;
}

}  // namespace gnomon::judge
