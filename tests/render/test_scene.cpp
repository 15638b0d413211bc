// Builds the scenes.
#include "test_scene.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gnomon::render {

Scene empty_scene() {
  Scene scene;
  scene.name = "test";
  scene.materials.push_back({});
  scene.materials[0].double_sided = true;
  return scene;
}

int add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

void add_mesh(Scene& scene, const std::vector<glm::vec3>& corners, const glm::dmat4& world_from_object,
              int material, bool mirrored) {
  Primitive primitive;
  primitive.first_index = static_cast<std::uint32_t>(scene.indices.size());
  primitive.index_count = static_cast<std::uint32_t>(corners.size());
  primitive.material = material;
  Instance instance;
  instance.world_from_object = world_from_object;
  instance.primitive = static_cast<std::uint32_t>(scene.primitives.size());
  instance.mirrored = mirrored;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t t = i - i % 3;
    scene.indices.push_back(static_cast<std::uint32_t>(scene.positions.size()));
    scene.positions.push_back(corners[i]);
    scene.normals.push_back(
        glm::normalize(glm::cross(corners[t + 1] - corners[t], corners[t + 2] - corners[t])));
    scene.texcoords.emplace_back(0.0f);
    primitive.bounds.extend(glm::dvec3(corners[i]));
    instance.bounds_world.extend(glm::dvec3(world_from_object * glm::dvec4(corners[i], 1.0)));
  }
  scene.primitives.push_back(primitive);
  scene.instances.push_back(instance);
  scene.bounds_world.extend(instance.bounds_world);
}

void add_quad(Scene& scene, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v, int material) {
  add_mesh(scene, {origin, origin + u, origin + u + v, origin, origin + u + v, origin + v}, glm::dmat4(1.0),
           material);
  const std::vector<glm::vec2> texcoords{{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}};
  std::copy(texcoords.begin(), texcoords.end(), scene.texcoords.end() - 6);
}

std::vector<glm::vec3> box_triangles(const glm::vec3& min, const glm::vec3& max) {
  const auto corner = [&](int i) {
    return glm::vec3((i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                     (i & 4) != 0 ? max.z : min.z);
  };
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2},
                                {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
  std::vector<glm::vec3> corners;
  for (const auto& f : kFaces) {
    for (const int i : {f[0], f[1], f[2], f[0], f[2], f[3]}) corners.push_back(corner(i));
  }
  return corners;
}

void add_box(Scene& scene, const glm::vec3& min, const glm::vec3& max) {
  add_mesh(scene, box_triangles(min, max));
}

Scene box_on_ground() {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  add_box(scene, kBoxMin, kBoxMax);
  return scene;
}

Instance shifted(const Instance& from, const glm::dvec3& by) {
  Instance to = from;
  to.world_from_object[3] += glm::dvec4(by, 0.0);
  to.bounds_world = {from.bounds_world.min + by, from.bounds_world.max + by};
  return to;
}

Scene shifted(Scene scene, const glm::dvec3& by) {
  for (Instance& instance : scene.instances) instance = shifted(instance, by);
  return scene;
}

Scene boxes_on_ground() {
  Scene scene = box_on_ground();
  for (int i = 0; i < 12; ++i) {
    const auto x = static_cast<float>(-9 + 6 * (i % 4)), z = static_cast<float>(-14 + 7 * (i / 4));
    add_box(scene, {x, 0.0f, z}, {x + 1.0f, 1.0f + 0.3f * static_cast<float>(i), z + 0.7f});
  }
  return scene;
}

bool hits_box(const glm::dvec3& point, const glm::dvec3& to_light, const glm::dvec3& min,
              const glm::dvec3& max) {
  if (min.x > max.x || min.y > max.y || min.z > max.z) return false;  // shrunk to nothing
  double begin = 0.0, end = 1e9;
  for (int c = 0; c < 3; ++c) {
    if (to_light[c] == 0.0) {
      if (point[c] < min[c] || point[c] > max[c]) return false;
      continue;
    }
    const double a = (min[c] - point[c]) / to_light[c], b = (max[c] - point[c]) / to_light[c];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

std::vector<Box> boxes_of(const Scene& scene) {
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  return boxes;
}

Camera camera_on_box(int width, int height) {
  const glm::dvec3 eye{4.5, 6.0, 9.0}, target{-0.3, 0.5, 0.0};
  return perspective_camera(eye, target - eye, {0, 1, 0}, 0.9, 1.0 * width / height, 0.5, 60.0, width,
                            height);
}

Camera going(double frame) {
  Camera camera = camera_on_box(96, 96);
  camera.position += glm::dvec3(0.06, 0.01, -0.11) * frame;
  return camera;
}

ShadowPlan plan_for(const Scene& scene, const Camera& camera, const glm::dvec3& light_direction,
                    const PlanOptions& options) {
  const std::vector<Box> boxes = boxes_of(scene);
  return make_plan(camera, DirectionalLight{light_direction}, {boxes, boxes}, options);
}

}  // namespace gnomon::render
