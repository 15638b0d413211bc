// Scenes and draws of `gnomon filters`.
#include "stage.hpp"

#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "gnomon/render/context.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {
namespace {

/// A quad with corners origin, origin + u, origin + u + v, origin + v.
void add_quad(Scene& scene, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v) {
  Primitive primitive;
  primitive.first_index = static_cast<std::uint32_t>(scene.indices.size());
  primitive.index_count = 6;
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec3& corner : {origin, origin + u, origin + u + v, origin + v}) {
    scene.positions.push_back(corner);
    scene.normals.push_back(glm::normalize(glm::cross(u, v)));
    scene.texcoords.emplace_back(0.0f);
    primitive.bounds.extend(glm::dvec3(corner));
  }
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(first + i);
  Instance instance;
  instance.primitive = static_cast<std::uint32_t>(scene.primitives.size());
  instance.bounds_world = primitive.bounds;
  scene.bounds_world.extend(primitive.bounds);
  scene.primitives.push_back(primitive);
  scene.instances.push_back(instance);
}

/// Faces turned outwards, the bottom left out.
void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& size) {
  const glm::vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  add_quad(scene, low + z, x, y);
  add_quad(scene, low + x, -x, y);
  add_quad(scene, low, z, y);
  add_quad(scene, low + x + z, -z, y);
  add_quad(scene, low + y + z, x, -z);
}

}  // namespace

FilterStage::FilterStage(Scene scene, double elevation_deg, double azimuth_deg)
    : scene_(std::move(scene)),
      sun_(default_light({LightKind::sun, elevation_deg, azimuth_deg}, scene_.bounds_world)),
      renderer_(scene_) {
  for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
}

FilterStage::FilterStage(const std::string& scene)
    : FilterStage(load_scene(scene), kStageElevationDeg, kStageAzimuthDeg) {}

render::FrameStats FilterStage::draw(const render::FilterSettings& filter, const Camera& camera,
                                     int map_size) {
  PlanOptions options;
  options.resolution.max_size = map_size;
  options.cascades = 1;
  options.prune = kPruneNothing.with(PruneRule::light_depths);  // the size that was asked for
  options.warp.warp = &warps::none;
  options.clip_space = kOpenGlZeroToOne;  // depths as the maps hold them
  render::set_margin(filter, options);
  plan_ = make_plan(camera, sun_, {boxes_, boxes_}, options);
  render::FrameOptions frame;
  // What is timed is the whole frame.
  frame.prune = PruneRules{}.without(PruneRule::held_maps).without(PruneRule::scrolled_maps);
  frame.aliasing = frame.heat_map = frame.cascade_tint = false;
  const render::FrameStats stats = renderer_.draw(plan_, camera, renderer_.prepare(filter), frame);
  render::check_context();
  return stats;
}

std::vector<float> FilterStage::visibility() const {
  const FloatImage mask = renderer_.mask();
  std::vector<float> lit;
  for (std::size_t i = 0; i < mask.values.size(); i += 2) {
    lit.push_back(mask.values[i + 1] < 0.0f ? -1.0f : mask.values[i]);
  }
  return lit;
}

render::FilterSettings filter_from(std::string_view text) {
  const render::ParsedFilter parsed = render::parse_filter(text);
  if (!parsed.error.empty()) throw std::runtime_error("filters: " + parsed.error);
  return parsed.settings;
}

Scene contact_scene(bool bars) {
  Scene scene;
  scene.name = "contact";
  scene.materials.emplace_back().double_sided = true;
  add_quad(scene, {-8, 0, 8}, {16, 0, 0}, {0, 0, -16});
  add_box(scene, {-2.5f, 0, -1}, {1.5f, 2, 1.5f});
  add_box(scene, {-3, 0, 1.5f}, {0.3f, 3, 0.3f});
  add_quad(scene, {0.5f, 0, 1.5f}, {3, 0, 0}, {0, 1.5f, -2.5f});
  for (int i = 0; bars && i < 16; ++i)
    add_box(scene, {-4.5f, 0, -2.5f + 0.4f * static_cast<float>(i)}, {0.15f, 4.5f, 0.15f});
  return scene;
}

Camera contact_camera(int width, int height) noexcept {
  const glm::dvec3 eye{2.5, 4.0, 8.0}, target{0.4, 0.5, 0.0};
  return perspective_camera(eye, target - eye, {0, 1, 0}, 0.65, 1.0 * width / height, 0.5, 40.0, width,
                            height);
}

Scene grating_scene() {
  Scene scene;
  scene.name = "grating";
  scene.materials.emplace_back().double_sided = true;
  add_quad(scene, {-15, 0, 5}, {30, 0, 0}, {0, 0, -30});
  for (int i = 0; i < 48; ++i)
    add_box(scene, {-15, 6, -25.0f + 0.6f * static_cast<float>(i)}, {30, 0.1f, 0.25f});
  return scene;
}

Camera grating_camera(double distance, int width, int height) noexcept {
  const glm::dvec3 target{0.0, 0.0, -8.0}, eye = target + distance * glm::dvec3(0.0, 3.0, 12.0);
  return perspective_camera(eye, target - eye, {0, 1, 0}, 0.65, 1.0 * width / height, 0.5, 200.0, width,
                            height);
}

}  // namespace gnomon::tool
