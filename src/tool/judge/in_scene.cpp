// How many pixels do an engine's maps get wrong in a scene, and how many does gnomon's plan?
#include "judge/in_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "float_channel.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/study/expected_error.hpp"
#include "gnomon/trace/reference.hpp"
#include "gnomon/trace/tracer.hpp"
#include "offscreen_context.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

/// Rays that tell what a frame shows: fewer for each of many.
constexpr int kColumns = judge::kRayColumns, kRows = judge::kRayRows;

/// First hits of rays all over the image, with the triangles' normals.
void add_points(const trace::Tracer& tracer, const Camera& camera, judge::CapturedScene& scene) {
  const CameraAxes axes = camera_axes(camera);
  scene.points.clear();
  scene.normals.clear();
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double across = (column + 0.5) / kColumns, down = (row + 0.5) / kRows;
      const glm::dvec3 aside = axes.right * (camera.left + (camera.right - camera.left) * across) +
                               axes.up * (camera.top + (camera.bottom - camera.top) * down);
      trace::Ray ray;
      ray.origin = camera.orthographic ? camera.position + aside : camera.position;
      ray.direction = camera.orthographic ? axes.forward : axes.forward + aside;
      ray.begin = camera.near_depth;
      ray.end = camera.far_depth;
      const trace::Hit hit = tracer.first_hit(ray);
      if (hit.triangle == trace::kNoTriangle || !(glm::length(hit.normal) > 0.0)) continue;
      scene.points.push_back(ray.origin + ray.direction * hit.t);
      scene.normals.push_back(glm::dot(hit.normal, ray.direction) > 0.0 ? -hit.normal : hit.normal);
    }
  }
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
  std::vector<float> lit, depths;
};

Truth truth_of(render::Renderer& renderer, const render::PreparedFilter& filter, const trace::Tracer& tracer,
               const Camera& camera, const Light& light) {
  render::FrameOptions surfaces;
  surfaces.aliasing = surfaces.heat_map = surfaces.cascade_tint = surfaces.time_passes = false;
  renderer.draw(ShadowPlan{}, camera, filter, surfaces);
  const trace::SurfacePoints points =
      trace::surface_points(tracer, camera, light, renderer.positions(), renderer.normals());
  const trace::HardReference hard = trace::hard_reference(tracer, points, light);
  Truth truth;
  const glm::dvec3 forward = camera_axes(camera).forward;
  for (std::size_t i = 0; i < hard.pixels.size(); ++i) {
    truth.lit.push_back(hard.pixels[i] == trace::Verdict::lit      ? 1.0f
                        : hard.pixels[i] == trace::Verdict::shadow ? 0.0f
                                                                   : -1.0f);
    const trace::SurfacePoint& point = points.pixels[i];
    truth.depths.push_back(point.state == trace::PixelState::sky
                               ? 0.0f
                               : static_cast<float>(glm::dot(forward, point.position - camera.position)));
  }
  return truth;
}

/// Grey where the shadow is right, orange where light is false, blue where shadow is.
std::string difference_png(const Camera& camera, const std::vector<float>& mask, const Truth& truth) {
  Image image;
  image.width = camera.width;
  image.height = camera.height;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float lit = truth.lit[i];
    std::array<std::uint8_t, 4> color{70, 74, 84, 255};
    if (lit > 0.5f) color = {215, 215, 210, 255};
    if (lit == 0.0f) color = {110, 112, 118, 255};
    if (lit == 0.0f && mask[i] > 0.5f) color = {255, 140, 0, 255};
    if (lit > 0.5f && mask[i] <= 0.5f) color = {30, 110, 230, 255};
    image.rgba.insert(image.rgba.end(), color.begin(), color.end());
  }
  const std::vector<std::uint8_t> bytes = encode_png(image);
  return {bytes.begin(), bytes.end()};
}

DrawnErrors drawn(render::Renderer& renderer, const render::PreparedFilter& filter, const Camera& camera,
                  const Light& light, const ShadowPlan& plan, const Truth& truth, std::string& picture,
                  std::uint64_t& pixels) {
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.light = &light;
  renderer.draw(plan, camera, filter, options);
  const std::vector<float> mask = channel(renderer.mask(), 0);
  const report::MaskErrors errors = report::mask_errors(mask, truth.lit, truth.lit);
  picture = difference_png(camera, mask, truth);
  pixels = errors.pixels;
  const ExpectedError expected = expected_error(plan, {camera, truth.lit, truth.depths});
  return {errors.false_lit + errors.false_shadow, errors.false_lit, errors.false_shadow, expected.share()};
}

}  // namespace

std::vector<std::string> judge_context_names() {
  return offscreen_context_names();
}

SceneJudgement judge_in_scene(judge::Capture& capture, const std::string& scene_word,
                              const std::string& context_word) {
  if (capture.clip_space.handedness == Handedness::left)
    throw std::runtime_error("SCENE: glTF worlds are right-handed, and the capture's is left-handed");
  check_scene_word("SCENE", scene_word);
  const std::vector<std::string> names = offscreen_context_names();
  const auto kind =
      static_cast<render::ContextKind>(std::find(names.begin(), names.end(), context_word) - names.begin());
  const Scene scene = load_scene(scene_word);
  const trace::Tracer tracer(scene);
  complete(capture, scene, tracer);
  SceneJudgement result;
  result.judgement = judge::judge(capture);
  const judge::CapturedFrame& frame = capture.frames.front();
  const auto context = render::create_context(kind);
  render::Renderer renderer(scene);
  const render::PreparedFilter filter = renderer.prepare(render::filters::hard);
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const int light = static_cast<int>(i);
    const judge::SeenSurfaces seen = judge::seen_surfaces(frame, capture.scenes[frame.scene]);
    const Truth truth = truth_of(renderer, filter, tracer, frame.camera, frame.lights[i]);
    DrawnLightErrors& errors = result.lights.emplace_back();
    errors.light = light;
    errors.captured = drawn(renderer, filter, frame.camera, frame.lights[i],
                            judge::plan_of(capture, frame, light), truth, errors.picture, errors.pixels);
    const ShadowPlan beside =
        judge::plan_beside(capture, frame, capture.scenes[frame.scene], seen, light, Fit::tight);
    if (beside.status != PlanStatus::ok) continue;
    errors.planned = drawn(renderer, filter, frame.camera, frame.lights[i], beside, truth,
                           errors.planned_picture, errors.pixels);
  }
  render::check_context();
  return result;
}

}  // namespace gnomon::tool
