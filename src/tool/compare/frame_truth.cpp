// What all techniques of a frame are compared with: exact rays, and what the camera shows.
#include "frame_truth.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "exact_results.hpp"

namespace gnomon::tool {
namespace {

/// The hard shadow at the points.
trace::HardReference hard_shadow(const Stage& stage, const trace::SurfacePoints& points) {
  trace::HardReference hard{points.width, points.height, {}};
  for (const float verdict :
       stage.exact().values(stage.exact().key("hard").add(points), points.pixels.size(), [&] {
         std::vector<float> values;
         for (const trace::Verdict one : trace::hard_reference(stage.tracer(), points, stage.light()).pixels)
           values.push_back(static_cast<float>(one));
         return values;
       }))
    hard.pixels.push_back(static_cast<trace::Verdict>(verdict));
  return hard;
}

/// The light over whole pixels, and behind it which pixels show several surfaces.
trace::PixelReference pixel_light(const Stage& stage, const Camera& camera,
                                  const trace::SurfacePoints& points, int samples) {
  const std::size_t count = points.pixels.size();
  const std::vector<float> both =
      stage.exact().values(stage.exact().key("pixels").add(points).add(camera).add(samples), 2 * count, [&] {
        trace::PixelReference pixels =
            trace::pixel_reference(stage.tracer(), camera, points, stage.light(), samples);
        pixels.pixels.insert(pixels.pixels.end(), pixels.several.begin(), pixels.several.end());
        return std::move(pixels.pixels);
      });
  const auto middle = both.begin() + static_cast<std::ptrdiff_t>(count);
  return {points.width, points.height, {both.begin(), middle}, {middle, both.end()}};
}

/// What a camera shows of the scene as it is posed.
trace::SurfacePoints points_through(Stage& stage, const SweepEntry& entry, const Camera& camera) {
  render::Renderer& renderer = stage.renderer();
  render::FrameOptions options;
  options.prune = prune_rules_of(PruneSource::this_frame);
  options.aliasing = options.heat_map = options.cascade_tint = false;
  renderer.draw(stage.plan(entry, camera), camera, stage.filter(entry), options);
  return trace::surface_points(stage.tracer(), camera, stage.light(), renderer.positions(),
                               renderer.normals());
}

/// What the frame's camera shows, and its hard shadow.
void trace_frame(Stage& stage, const SweepEntry& entry, FrameTruth& truth) {
  truth.points = points_through(stage, entry, truth.camera);
  truth.hard = hard_shadow(stage, truth.points);
}

/// 1 lit, 0 in shadow, -1 undecided.
std::vector<float> values_of(const trace::HardReference& hard) {
  std::vector<float> values;
  values.reserve(hard.pixels.size());
  for (const trace::Verdict verdict : hard.pixels)
    values.push_back(verdict == trace::Verdict::lit      ? 1.0f
                     : verdict == trace::Verdict::shadow ? 0.0f
                                                         : -1.0f);
  return values;
}

/// Pixel of `before` that shows the point which pixel `i` of `after` shows, within the side of a pixel; -1:
/// none does.
std::vector<int> seen_before(const trace::SurfacePoints& after, const trace::SurfacePoints& before,
                             const Camera& camera_before) {
  const CameraAxes axes = camera_axes(camera_before);
  std::vector<int> seen_at(after.pixels.size(), -1);
  for (std::size_t i = 0; i < after.pixels.size(); ++i) {
    const trace::SurfacePoint& point = after.pixels[i];
    if (point.state != trace::PixelState::facing) continue;
    const glm::dvec3 way = point.position - camera_before.position;
    const double depth = glm::dot(axes.forward, way), scale = camera_before.orthographic ? 1.0 : depth;
    if (!(depth > 0.0)) continue;
    const double width = (camera_before.right - camera_before.left) * scale,
                 height = (camera_before.top - camera_before.bottom) * scale;
    const double column =
        std::floor((glm::dot(axes.right, way) - camera_before.left * scale) / width * before.width);
    const double row =
        std::floor((camera_before.top * scale - glm::dot(axes.up, way)) / height * before.height);
    if (!(column >= 0.0 && column < before.width && row >= 0.0 && row < before.height)) continue;
    const int at = static_cast<int>(row) * before.width + static_cast<int>(column);
    const trace::SurfacePoint& found = before.pixels[static_cast<std::size_t>(at)];
    if (found.state != trace::PixelState::facing) continue;
    // Off the plane, not along it: a pixel that grazes its surface is long.
    const double side = std::max(width / before.width, height / before.height);
    if (std::abs(glm::dot(point.normal, found.position - point.position)) <= side) seen_at[i] = at;
  }
  return seen_at;
}

}  // namespace

FrameTruth frame_truth(Stage& stage, int frame, const SweepEntry& entry, int pixel_samples) {
  FrameTruth truth;
  truth.frame = frame;
  truth.camera = stage.camera(frame);
  truth.before = stage.camera_before(frame);
  stage.see(frame);
  const bool over_pixels = pixel_samples > 0;
  trace::SurfacePoints points_before;
  if (stage.plays() || over_pixels) {
    stage.go_to(frame, Stage::At::before);
    if (stage.plays()) stage.retrace();
    if (over_pixels) {
      points_before = points_through(stage, entry, truth.before);
      truth.pixels.light_before = pixel_light(stage, truth.before, points_before, pixel_samples).pixels;
    }
    if (stage.plays()) {
      trace_frame(stage, entry, truth);
      truth.lit_before = values_of(truth.hard);
    }
    stage.go_to(frame, Stage::At::frame);
    if (stage.plays()) stage.retrace();
  }
  trace_frame(stage, entry, truth);
  if (over_pixels) {
    trace::PixelReference pixels = pixel_light(stage, truth.camera, truth.points, pixel_samples);
    truth.pixels.light = std::move(pixels.pixels);
    truth.pixels.several = std::move(pixels.several);
    truth.pixels.seen_at = seen_before(truth.points, points_before, truth.before);
  }
  truth.seen =
      trace::seen_shadow(stage.tracer(), truth.camera, stage.light(), truth.points, values_of(truth.hard));
  if (!stage.plays()) truth.lit_before = truth.seen.mask;
  truth.undecided = static_cast<std::uint64_t>(
      std::count(truth.hard.pixels.begin(), truth.hard.pixels.end(), trace::Verdict::undecided));
  return truth;
}

}  // namespace gnomon::tool
