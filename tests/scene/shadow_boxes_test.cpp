// Do the boxes that plans take of a scene hold its triangles, and little air?
#include "gnomon/scene/shadow_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "gnomon/scene/load.hpp"

namespace gnomon::test {
namespace {

bool holds(const Box& outer, const Box& inner) {
  return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
         outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z;
}

/// Every triangle of the instance that no one box of the list holds.
int outside(const Scene& scene, const Instance& instance, std::span<const Box> boxes) {
  int count = 0;
  const Primitive& primitive = scene.primitives[instance.primitive];
  for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
    Box triangle;
    for (std::uint32_t k = i; k < i + 3; ++k) {
      const glm::dvec3 corner(scene.positions[scene.indices[primitive.first_index + k]]);
      triangle.extend(glm::dvec3(instance.world_from_object * glm::dvec4(corner, 1.0)));
    }
    count += std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) { return holds(box, triangle); });
  }
  return count;
}

double volume(std::span<const Box> boxes) {
  double sum = 0.0;
  for (const Box& box : boxes) {
    if (box.empty()) continue;
    const glm::dvec3 side = box.max - box.min;
    sum += side.x * side.y * side.z;
  }
  return sum;
}

TEST(ShadowBoxes, receivers_are_parts_of_large_meshes_and_hold_every_triangle) {
  const Scene scene = load_scene("builtin:hangar");
  const ShadowBoxes boxes(scene);
  const SceneBounds bounds = boxes.bounds();
  ASSERT_EQ(boxes.all().size(), scene.instances.size());
  EXPECT_EQ(bounds.casters.size(), scene.instances.size());
  EXPECT_GT(bounds.receivers.size(), scene.instances.size() + 32);
  EXPECT_LT(bounds.receivers.size(), 3 * scene.instances.size());
  for (const Instance& instance : scene.instances)
    EXPECT_EQ(outside(scene, instance, bounds.receivers.list()), 0);
  Box all;
  for (const Box& box : bounds.receivers.list()) all.extend(box);
  EXPECT_EQ(all, scene.bounds_world);
  EXPECT_LT(volume(bounds.receivers.list()), 0.9 * volume(boxes.all()));
}

TEST(ShadowBoxes, a_scene_of_few_triangles_has_the_boxes_of_its_instances) {
  Scene scene = load_scene("builtin:room");
  for (Primitive& primitive : scene.primitives)
    primitive.index_count = std::min(primitive.index_count, 3u * 16u);
  const ShadowBoxes boxes(scene);
  EXPECT_EQ(boxes.bounds().receivers.list().data(), boxes.all().data());
}

TEST(ShadowBoxes, what_does_not_receive_has_no_parts_and_what_moves_has_one_box) {
  Scene scene = load_scene("builtin:hangar");
  ShadowBoxes boxes(scene);
  const auto parts = [&] {
    const auto list = boxes.bounds().receivers.list();
    return static_cast<std::size_t>(std::ranges::count_if(list, [](const Box& box) { return !box.empty(); }));
  };
  const std::size_t before = parts();
  std::size_t divided = 0;
  while (!boxes.bounds().receivers.list()[divided].empty()) ++divided;
  const Box away{{1e3, 0, 0}, {1.1e3, 1, 1}};
  boxes.place(divided, away);
  EXPECT_LT(parts(), before);
  const auto moved = boxes.bounds().receivers.list();
  EXPECT_EQ(moved[divided], away);
  EXPECT_EQ(boxes.bounds().casters.list()[divided], away);
  // All others keep theirs.
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    EXPECT_EQ(outside(scene, scene.instances[i], moved) > 0, i == divided) << i;

  scene.instances[divided].receives = false;
  const ShadowBoxes without(scene);
  EXPECT_TRUE(without.bounds().receivers.list()[divided].empty());
  EXPECT_GT(outside(scene, scene.instances[divided], without.bounds().receivers.list()), 0);
}

TEST(ShadowBoxes, a_second_scene_stands_behind_the_first) {
  const Scene hangar = load_scene("builtin:hangar"), room = load_scene("builtin:room");
  ShadowBoxes boxes(hangar);
  boxes.add(room);
  const std::size_t count = hangar.instances.size();
  ASSERT_EQ(boxes.all().size(), count + room.instances.size());
  EXPECT_EQ(boxes.all()[count], room.instances[0].bounds_world);
  EXPECT_EQ(boxes.bounds().casters.list()[count], room.instances[0].bounds_world);
  const Box away{{1e3, 0, 0}, {1.1e3, 1, 1}};
  boxes.place(count, away);
  EXPECT_EQ(boxes.bounds().receivers.list()[count], away);
  for (const Instance& instance : hangar.instances)
    EXPECT_EQ(outside(hangar, instance, boxes.bounds().receivers.list()), 0);
  EXPECT_GT(outside(room, room.instances[0], boxes.bounds().receivers.list().subspan(count)), 0);
}

}  // namespace
}  // namespace gnomon::test
