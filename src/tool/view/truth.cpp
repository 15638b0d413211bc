// The exact hard shadow of a picture, traced in the background row by row.
#include "truth.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace gnomon::tool::view {
namespace {

/// Rows traced at a time: the threads of the tracer share them.
constexpr int kBand = 16;

std::string text_of(const glm::dvec3& v) {
  return fmt::format("{} {} {} ", v.x, v.y, v.z);
}

/// All that the exact shadow depends on besides the scene.
std::string picture_of(const Camera& camera, const Light& light) {
  return text_of(camera.position) + text_of(camera.forward) +
         fmt::format("{} {} {} {} {} {} {} {} {}", camera.orthographic, camera.left, camera.right,
                     camera.bottom, camera.top, camera.near_depth, camera.far_depth, camera.width,
                     camera.height) +
         light_text(light);
}

FloatImage rows_of(const FloatImage& image, int begin, int end) {
  const auto row = static_cast<std::ptrdiff_t>(image.width) * image.channels;
  return {image.width,
          end - begin,
          image.channels,
          {image.values.begin() + row * begin, image.values.begin() + row * end},
          image.channel_names};
}

}  // namespace

std::string light_text(const Light& light) {
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) return " sun " + text_of(sun->direction);
  if (const auto* spot = std::get_if<SpotLight>(&light))
    return " spot " + text_of(spot->position) + text_of(spot->direction) +
           fmt::format("{} {}", spot->outer_radians, spot->range);
  const auto& point = std::get<PointLight>(light);
  return " point " + text_of(point.position) + fmt::format("{}", point.range);
}

bool Truth::is_of(const Camera& camera, const Light& light) const {
  return picture_ == picture_of(camera, light);
}

void Truth::begin(std::shared_ptr<const trace::Tracer> tracer, const Camera& camera, const Light& light,
                  FloatImage positions, FloatImage normals) {
  stop();
  picture_ = picture_of(camera, light);
  width_ = positions.width;
  height_ = positions.height;
  verdicts_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                   trace::Verdict::none);
  tracer_ = std::move(tracer);
  occluders_ = {*tracer_, light};
  thread_ = std::jthread([this, tracer = tracer_, camera, light, positions = std::move(positions),
                          normals = std::move(normals)](const std::stop_token& stopped) {
    for (int begin = 0; begin < height_ && !stopped.stop_requested(); begin += kBand) {
      const int end = std::min(begin + kBand, height_);
      const trace::SurfacePoints points = trace::surface_points(
          *tracer, camera, light, rows_of(positions, begin, end), rows_of(normals, begin, end));
      const trace::HardReference rows = trace::hard_reference(*tracer, points, light);
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(begin) * width_;
      std::copy(rows.pixels.begin(), rows.pixels.end(), verdicts_.begin() + first);
      rows_ = end;
    }
  });
}

void Truth::stop() {
  thread_ = {};  // asks it to stop, and waits
  picture_.clear();
  occluders_ = {};
  tracer_.reset();
  rows_ = 0;
  height_ = 0;
}

void Truth::finish() {
  if (thread_.joinable()) thread_.join();
}

std::span<const trace::Verdict> Truth::verdicts() const {
  return {verdicts_.data(), static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows_.load())};
}

bool Truth::done() const {
  return height_ > 0 && rows_ == height_;
}

}  // namespace gnomon::tool::view
