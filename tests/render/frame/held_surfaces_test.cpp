// Are surfaces drawn again whenever what the camera sees may differ, and only then?
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "gnomon/scene/pose.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

/// A renderer that goes on, and one made anew for each frame.
class Goes {
 public:
  explicit Goes(Scene scene) : scene_(std::move(scene)), renderer_(scene_) {}

  /// Draws one frame; true where its surfaces were held. They are those of a new renderer either way.
  bool on(const Camera& camera, const Source& source = {}) {
    const auto frame = [&](Renderer& renderer) {
      return renderer.draw(plan_for(scene_, camera, light, {}), camera,
                           renderer.prepare(filters::hard, source));
    };
    const MapStats camera_work = frame(renderer_).camera;
    Renderer anew(scene_);
    const FrameStats whole = frame(anew);
    EXPECT_FALSE(whole.camera.held);
    EXPECT_GT(whole.camera.triangles, 0u);
    EXPECT_EQ(camera_work.triangles, camera_work.held ? 0u : whole.camera.triangles);
    EXPECT_EQ(renderer_.positions().values, anew.positions().values);
    EXPECT_EQ(renderer_.normals().values, anew.normals().values);
    EXPECT_EQ(renderer_.mask().values, anew.mask().values);
    EXPECT_EQ(renderer_.image().rgba, anew.image().rgba);
    return camera_work.held;
  }
  void move(std::size_t instance, const glm::dvec3& by) {
    Instance& moved = scene_.instances[instance];
    moved.world_from_object[3] += glm::dvec4(by, 0.0);
    moved.bounds_world = {moved.bounds_world.min + by, moved.bounds_world.max + by};
    ASSERT_TRUE(renderer_.move_instance(instance, moved));
  }
  /// Lifts the upper vertices of an instance, which alone shows them; add_mesh gives each corner its own.
  void raise(std::size_t instance, float by) {
    const Instance& of = scene_.instances[instance];
    const Primitive& primitive = scene_.primitives[of.primitive];
    const std::uint32_t first = scene_.indices[primitive.first_index], count = primitive.index_count;
    Pose pose;
    PosedInstance at{static_cast<std::uint32_t>(instance), of.world_from_object, of.mirrored,
                     of.bounds_world};
    at.bounds_world.max.y += by;
    PosedVertices bent{at.instance, 0, first, count, primitive.bounds};
    bent.bounds.max.y += by;
    pose.instances.push_back(at);
    pose.vertices.push_back(bent);
    for (std::uint32_t i = first; i < first + count; ++i) {
      const glm::vec3 position = scene_.positions[i];
      pose.positions.push_back(position.y > 0.5f ? position + glm::vec3(0, by, 0) : position);
      pose.normals.push_back(scene_.normals[i]);
    }
    ASSERT_TRUE(renderer_.apply_pose(pose));
    apply_pose(pose, scene_);
  }

  glm::dvec3 light = kSlant;

 private:
  Scene scene_;
  Renderer renderer_;
};

TEST(HeldSurfaces, are_kept_under_a_still_camera_whatever_the_light_does) {
  Goes goes(box_on_ground());
  const Camera camera = camera_on_box(80, 60);
  EXPECT_FALSE(goes.on(camera));
  EXPECT_TRUE(goes.on(camera));
  goes.light = glm::normalize(glm::dvec3(-0.4, -1.0, 0.2));
  EXPECT_TRUE(goes.on(camera));
}

TEST(HeldSurfaces, are_drawn_again_once_the_camera_differs_in_anything) {
  const std::vector<std::function<void(Camera&)>> changes{
      [](Camera& camera) { camera.position.x += 1e-3; },
      [](Camera& camera) { camera.forward = glm::normalize(camera.forward + glm::dvec3(0, 1e-3, 0)); },
      [](Camera& camera) { camera.right += 1e-3; },
      [](Camera& camera) { camera.near_depth *= 1.5; },
      [](Camera& camera) { camera.width += 2; },
      [](Camera& camera) { camera.height -= 2; },
  };
  Goes goes(box_on_ground());
  const Camera camera = camera_on_box(80, 60);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    goes.on(camera);
    Camera other = camera;
    changes[i](other);
    EXPECT_FALSE(goes.on(other)) << i;
    EXPECT_TRUE(goes.on(other)) << i;
    EXPECT_FALSE(goes.on(camera)) << i;
  }
}

TEST(HeldSurfaces, are_drawn_again_once_the_scene_moves_or_bends) {
  Goes goes(boxes_on_ground());
  const Camera camera = camera_on_box(80, 60);
  EXPECT_FALSE(goes.on(camera));
  goes.move(1, {0.5, 0.0, 0.0});
  EXPECT_FALSE(goes.on(camera));
  EXPECT_TRUE(goes.on(camera));
  goes.raise(1, 0.25f);
  EXPECT_FALSE(goes.on(camera));
  EXPECT_TRUE(goes.on(camera));
}

TEST(HeldSurfaces, of_another_source_are_drawn_by_its_own_program) {
  Goes goes(box_on_ground());
  const Camera camera = camera_on_box(80, 60);
  EXPECT_FALSE(goes.on(camera));
  EXPECT_FALSE(goes.on(camera, Source::irregular()));
  EXPECT_TRUE(goes.on(camera, Source::irregular()));
  EXPECT_FALSE(goes.on(camera));
  for (const IdentifierOf of : {IdentifierOf::instance, IdentifierOf::triangle}) {
    IdentifierTest test;
    test.of = of;
    EXPECT_FALSE(goes.on(camera, Source::identifiers(test)));
    EXPECT_TRUE(goes.on(camera, Source::identifiers(test)));
  }
}

}  // namespace
}  // namespace gnomon::render
