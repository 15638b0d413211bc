// The street, its rays, and what is counted in pictures of it.
#include "street.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"

namespace sample {
namespace {

/// The same numbers from 0 to 1 in every run and on every machine.
class Numbers {
 public:
  double between(double low, double high) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * static_cast<double>(state_ >> 11) / 0x1p53;
  }

 private:
  std::uint64_t state_ = 3;
};

struct Hit {
  double t = std::numeric_limits<double>::infinity();
  int axis = -1;  // of the face's normal; -1: nothing was hit
};

Hit first_hit(std::span<const gnomon::Box> boxes, const glm::dvec3& origin, const glm::dvec3& direction) {
  constexpr double kBegin = 1e-6;  // of the direction's length: what is nearer is the surface itself
  const glm::dvec3 inverse = 1.0 / direction;
  Hit hit;
  for (const gnomon::Box& box : boxes) {
    const glm::dvec3 a = (box.min - origin) * inverse, b = (box.max - origin) * inverse;
    const glm::dvec3 in = glm::min(a, b), out = glm::max(a, b);
    const double enter = std::max({in.x, in.y, in.z}), leave = std::min({out.x, out.y, out.z});
    if (!(enter <= leave && enter > kBegin && enter < hit.t)) continue;
    hit = {enter, in.x == enter ? 0 : in.y == enter ? 1 : 2};
  }
  return hit;
}

}  // namespace

Street::Street() {
  Numbers numbers;
  boxes.push_back({{-60, -1, -170}, {60, 0, 20}});
  for (int i = 0; i < 18; ++i) {
    for (const double x : {-14.0, 6.0}) {
      const double front = x + numbers.between(0.0, 2.0), height = numbers.between(2.0, 9.0);
      boxes.push_back({{front, 0, -9.0 * i - 6.0}, {x + 6.0, height, -9.0 * i}});
    }
  }
  for (int i = 0; i < 30; ++i) {
    const double x = numbers.between(-5.0, 5.0), z = numbers.between(-120.0, 6.0);
    boxes.push_back({{x, 0, z}, {x + 0.3, numbers.between(1.0, 3.0), z + 0.3}});
  }
}

gnomon::Camera Street::camera(int frame, int width, int height) const {
  const glm::dvec3 eye{-1.0, 3.0, 14.0 - 1.5 * frame}, at{2.0, 0.5, -20.0 - 1.5 * frame};
  return gnomon::perspective_camera(eye, at - eye, {0, 1, 0}, 0.75, static_cast<double>(width) / height, 0.2,
                                    180.0, width, height);
}

void append_box(const gnomon::Box& box, std::vector<Vertex>& out) {
  const std::array<glm::dvec3, 2> ends{box.min, box.max};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      std::array<glm::vec3, 4> corner{};
      for (int i = 0; i < 4; ++i) {
        const bool first = i == 1 || i == 2, second = i >= 2;  // round the face
        glm::dvec3 place{};
        place[axis] = ends[static_cast<std::size_t>(side)][axis];
        place[(axis + 1) % 3] = ends[side == 1 ? first : second][(axis + 1) % 3];
        place[(axis + 2) % 3] = ends[side == 1 ? second : first][(axis + 2) % 3];
        corner[static_cast<std::size_t>(i)] = glm::vec3(place);
      }
      glm::vec3 normal{0.0f};
      normal[axis] = side == 1 ? 1.0f : -1.0f;
      for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) out.push_back({corner[i], normal});
    }
  }
}

ExactPicture exact_picture(const Street& street, const gnomon::Camera& camera) {
  const gnomon::CameraAxes axes = gnomon::camera_axes(camera);
  const glm::dvec3 sun = glm::normalize(street.sun);
  ExactPicture out{camera.width, camera.height, {}, {}};
  for (int row = 0; row < camera.height; ++row) {
    const double y = camera.top + (camera.bottom - camera.top) * (row + 0.5) / camera.height;
    for (int column = 0; column < camera.width; ++column) {
      const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / camera.width;
      const glm::dvec3 ray = axes.forward + x * axes.right + y * axes.up;
      const Hit hit = first_hit(street.boxes, camera.position, ray);
      const double cosine = hit.axis < 0 ? 0.0 : std::copysign(1.0, ray[hit.axis]) * sun[hit.axis];
      ExactPicture::Pixel pixel = ExactPicture::uncounted;
      if (cosine > 0.0) {
        const Hit blocker = first_hit(street.boxes, camera.position + hit.t * ray - 1e-6 * sun, -sun);
        pixel = blocker.axis < 0 ? ExactPicture::lit : ExactPicture::shadow;
      }
      out.pixels.push_back(pixel);
      out.brightness.push_back(static_cast<float>(std::max(cosine, 0.0)));
    }
  }
  return out;
}

namespace {

bool is_wrong(ExactPicture::Pixel exact, float lit) {
  return exact != ExactPicture::uncounted && (lit > 0.5f) != (exact == ExactPicture::lit);
}

}  // namespace

void count_wrong(const ExactPicture& exact, std::span<const float> lit, Wrong& wrong) {
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    wrong.of += exact.pixels[i] != ExactPicture::uncounted ? 1 : 0;
    wrong.pixels += is_wrong(exact.pixels[i], lit[i]) ? 1 : 0;
  }
}

gnomon::ShadowPlan plan_of(const gnomon::ShadowPlan& like, const gnomon::Camera& camera,
                           std::span<const glm::dmat4> clip_from_world, std::span<const double> ends,
                           int map_size, const gnomon::BiasOptions& bias) {
  gnomon::ShadowPlan plan = like;
  const gnomon::ShadowMap own = like.map[0];
  plan.map_count = static_cast<int>(clip_from_world.size());
  for (std::size_t i = 0; i < clip_from_world.size(); ++i) {
    gnomon::ShadowMap& map = plan.map[i] = own;
    map.cascade = static_cast<int>(i);
    map.warp = &gnomon::warps::none;
    map.kappa = 0.0;
    map.clip_from_world = clip_from_world[i];
    map.clip_from_camera_relative = glm::mat4(glm::translate(clip_from_world[i], plan.origin_world));
    map.depth_begin = i == 0 ? camera.near_depth : ends[i - 1];
    map.depth_end = ends[i];
    map.width = map.height = map_size;
    map.select_plane_count = map.cull_plane_count = 0;  // every caster is drawn
    // At a point in the middle of its depths; without a warp they are the same everywhere.
    const glm::dvec3 point =
        camera.position + std::sqrt(map.depth_begin * map.depth_end) * glm::normalize(camera.forward);
    const glm::dvec3 light = -glm::dvec3(map.light_world);
    const double depths = plan.clip_space.ndc_depth == gnomon::NdcDepth::zero_to_one ? 1.0 : 2.0;
    map.texel_world = map.texel_world_max =
        gnomon::texel_extent_world(map.clip_from_world, map.texels(), light, point);
    map.depth_range_world =
        depths / std::abs(gnomon::ndc_depth_per_world_unit(map.clip_from_world, light, point));
    map.bias_world.constant = bias.constant_texels * std::max(map.texel_world.x, map.texel_world.y);
  }
  return plan;
}

void write_pictures(const std::filesystem::path& file, const ExactPicture& exact,
                    std::span<const Drawn> drawn) {
  const std::size_t width = static_cast<std::size_t>(exact.width),
                    height = static_cast<std::size_t>(exact.height);
  gnomon::Image image{file.string(), static_cast<int>(width * drawn.size()), 2 * exact.height, {}};
  image.rgba.assign(width * drawn.size() * height * 2 * 4, 255);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (std::size_t pixel = 0; pixel < width * height; ++pixel) {
      const bool wrong = is_wrong(exact.pixels[pixel], drawn[i].lit[pixel]);
      for (std::size_t half = 0; half < 2; ++half) {
        const std::size_t row = pixel / width + half * height, column = i * width + pixel % width;
        std::uint8_t* const out = &image.rgba[4 * (row * width * drawn.size() + column)];
        for (std::size_t c = 0; c < 3; ++c) {
          const int shown = drawn[i].rgb[3 * pixel + c];
          out[c] = static_cast<std::uint8_t>(half == 0 ? shown
                                             : wrong   ? (c == 0 ? 255 : 40)
                                                       : 150 + shown * 2 / 5);
        }
      }
    }
  }
  gnomon::write_png(image, file);
}

}  // namespace sample
