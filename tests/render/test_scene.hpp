// Small scenes whose shadows can be worked out by hand.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::render {

/// A scene with one opaque white material and nothing in it.
[[nodiscard]] Scene empty_scene();
/// Adds a material and answers its index.
int add_material(Scene& scene, const Material& material);
/// Adds the triangles as a primitive with flat normals, and an instance of it.
void add_mesh(Scene& scene, const std::vector<glm::vec3>& corners,
              const glm::dmat4& world_from_object = glm::dmat4(1.0), int material = 0, bool mirrored = false);
/// Corners of two triangles with the texture upright on them: (0,1) at `origin`, (1,0) at origin + u + v.
void add_quad(Scene& scene, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v,
              int material = 0);
void add_box(Scene& scene, const glm::vec3& min, const glm::vec3& max);
[[nodiscard]] std::vector<glm::vec3> box_triangles(const glm::vec3& min, const glm::vec3& max);

/// Ground of 40 x 40 units at y = 0 and one box standing on it.
inline constexpr glm::vec3 kBoxMin{-1.5f, 0.0f, -1.0f}, kBoxMax{1.0f, 2.5f, 1.5f};
[[nodiscard]] Scene box_on_ground();
/// The same with twelve boxes more.
[[nodiscard]] Scene boxes_on_ground();

/// An instance, and all instances of a scene, somewhere else.
[[nodiscard]] Instance shifted(const Instance& from, const glm::dvec3& by);
[[nodiscard]] Scene shifted(Scene scene, const glm::dvec3& by);

/// Does the ray from `point` towards the light meet the box? Never one that was shrunk to nothing.
[[nodiscard]] bool hits_box(const glm::dvec3& point, const glm::dvec3& to_light, const glm::dvec3& min,
                            const glm::dvec3& max);

[[nodiscard]] std::vector<Box> boxes_of(const Scene& scene);
/// Looks at the box of box_on_ground from some way off.
[[nodiscard]] Camera camera_on_box(int width, int height);
/// The same of 96 x 96 pixels, as it goes past the boxes.
[[nodiscard]] Camera going(double frame);
[[nodiscard]] ShadowPlan plan_for(const Scene& scene, const Camera& camera, const glm::dvec3& light_direction,
                                  const PlanOptions& options);

}  // namespace gnomon::render
