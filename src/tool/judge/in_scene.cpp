// How many pixels do an engine's maps get wrong in a scene, and how many does gnomon's plan?
#include "judge/in_scene.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "edit_words.hpp"
#include "float_channel.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/study/expected_error.hpp"
#include "gnomon/trace/reference.hpp"
#include "gnomon/trace/seen_shadow.hpp"
#include "gnomon/trace/tracer.hpp"
#include "offscreen_context.hpp"
#include "scene_words.hpp"
#include "view/pictures.hpp"

namespace gnomon::tool {
namespace {

/// First hits of rays all over the image, with the triangles' normals.
void add_points(const trace::Tracer& tracer, const Camera& camera, judge::CapturedScene& scene) {
  scene.normals.clear();
  judge::for_each_ray(camera, [&](const glm::dvec2&, const glm::dvec3& origin, const glm::dvec3& way) {
    trace::Ray ray;
    ray.origin = origin;
    ray.direction = way;
    ray.begin = camera.near_depth;
    ray.end = camera.far_depth;
    const trace::Hit hit = tracer.first_hit(ray);
    if (hit.triangle == trace::kNoTriangle || !(glm::length(hit.normal) > 0.0)) return;
    scene.points.push_back(origin + way * hit.t);
    scene.normals.push_back(glm::dot(hit.normal, way) > 0.0 ? -hit.normal : hit.normal);
  });
}

/// What the capture says nothing about, from the scene.
void complete(judge::Capture& capture, const Scene& scene, const trace::Tracer& tracer) {
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  std::vector<judge::CapturedScene> scenes;
  for (judge::CapturedFrame& frame : capture.frames) {
    judge::CapturedScene& own = scenes.emplace_back(capture.scenes[frame.scene]);
    if (own.receivers.empty()) own.receivers = boxes;
    if (own.casters.empty()) own.casters = boxes;
    if (own.points.empty()) add_points(tracer, frame.camera, own);
    frame.scene = scenes.size() - 1;
  }
  capture.scenes = std::move(scenes);
}

/// The exact shadow of one light, as the camera sees it.
struct Truth {
  std::vector<trace::Verdict> verdicts;
  trace::SeenShadow seen;
};

Truth truth_of(render::Renderer& renderer, const render::PreparedFilter& filter, const trace::Tracer& tracer,
               const Camera& camera, const Light& light) {
  render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  renderer.draw(ShadowPlan{}, camera, filter, surfaces);
  const trace::SurfacePoints points =
      trace::surface_points(tracer, camera, light, renderer.positions(), renderer.normals());
  Truth truth{trace::hard_reference(tracer, points, light).pixels, {}};
  truth.seen =
      trace::seen_shadow(tracer, camera, light, points, view::lit_of(truth.verdicts, truth.verdicts.size()));
  return truth;
}

DrawnErrors drawn(render::Renderer& renderer, const render::PreparedFilter& filter, const Camera& camera,
                  const Light& light, const ShadowPlan& plan, const Truth& truth, std::string& picture,
                  std::uint64_t& pixels) {
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.light = &light;
  renderer.draw(plan, camera, filter, options);
  const FloatImage mask = renderer.mask();
  const report::MaskErrors errors = report::mask_errors(channel(mask, 0), truth.seen.mask, truth.seen.mask);
  const std::vector<std::uint8_t> bytes =
      encode_png(view::misclassified_picture(mask, truth.verdicts, renderer.normals()));
  picture.assign(bytes.begin(), bytes.end());
  pixels = errors.pixels;
  const ExpectedError expected = expected_error(plan, truth.seen.picture());
  return {errors.false_lit + errors.false_shadow, errors.false_lit, errors.false_shadow, expected.share()};
}

}  // namespace

std::vector<Option> judged_scene_options(JudgedScene& judged) {
  const auto set = [&judged](const std::string& word) {
    judged.context = word;
    return true;
  };
  std::vector<Option> options{{.name = "--context",
                               .target = ParsedWord{set, judged.context},
                               .help = "OpenGL context that draws SCENE",
                               .names = offscreen_context_names()}};
  for (Option& option : edit_options(judged.edits)) {
    option.needs = "SCENE";
    options.push_back(std::move(option));
  }
  return options;
}

SceneJudgement judge_in_scene(judge::Capture& capture, const JudgedScene& judged) {
  if (capture.clip_space.handedness == Handedness::left)
    throw std::runtime_error("SCENE: glTF worlds are right-handed, and the capture's is left-handed");
  check_scene_word("SCENE", judged.file);
  const std::vector<std::string> names = offscreen_context_names();
  const auto kind =
      static_cast<render::ContextKind>(std::find(names.begin(), names.end(), judged.context) - names.begin());
  const Scene scene = load_edited(judged.file, {}, judged.edits);
  warn_of(scene);
  const trace::Tracer tracer(scene);
  complete(capture, scene, tracer);
  SceneJudgement result;
  result.judgement = judge::judge(capture);
  const judge::CapturedFrame& frame = capture.frames.front();
  const auto context = render::create_context(kind);
  render::Renderer renderer(scene);
  const render::PreparedFilter filter = renderer.prepare(render::filters::hard);
  for (const judge::LightFigures& figures : result.judgement.lights) {
    const Light& light = frame.lights[static_cast<std::size_t>(figures.light)];
    const Truth truth = truth_of(renderer, filter, tracer, frame.camera, light);
    DrawnLightErrors& errors = result.drawn.emplace_back();
    errors.captured =
        drawn(renderer, filter, frame.camera, light, figures.plan, truth, errors.picture, errors.pixels);
    if (figures.tight)
      errors.planned = drawn(renderer, filter, frame.camera, light, figures.tight->plan, truth,
                             errors.planned_picture, errors.pixels);
  }
  render::check_context();
  return result;
}

}  // namespace gnomon::tool
