// Do plans of C work without the heap? malloc and its relatives are counted where this program calls them
// (--wrap).
#include <gtest/gtest.h>

#include <cstdlib>

#include "in_c.hpp"

namespace {
long allocations = 0;
}

extern "C" {
void* __real_malloc(std::size_t bytes);
void* __real_calloc(std::size_t count, std::size_t bytes);
void* __real_realloc(void* old, std::size_t bytes);
void* __wrap_malloc(std::size_t bytes);
void* __wrap_calloc(std::size_t count, std::size_t bytes);
void* __wrap_realloc(void* old, std::size_t bytes);
void* __wrap_malloc(std::size_t bytes) {
  ++allocations;
  return __real_malloc(bytes);
}
void* __wrap_calloc(std::size_t count, std::size_t bytes) {
  ++allocations;
  return __real_calloc(count, bytes);
}
void* __wrap_realloc(void* old, std::size_t bytes) {
  ++allocations;
  return __real_realloc(old, bytes);
}
}

// The library needs no C++ library, so that it has no other way to the heap: the programs of C in this folder
// link without.
namespace gnomon::test {
namespace {

TEST(AllocationInC, plans_allocate_nothing_and_handles_do) {
  const std::vector<Box> boxes{{{-20, -1, -200}, {20, 30, -1}}};
  const Camera camera =
      perspective_camera({0, 5, 0}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 250.0, 960, 640);
  const InputInC in(camera, DirectionalLight{{0.3, -1, 0.2}}, boxes, boxes, {});
  PlanInC out;
  long before = allocations;
  gnomon_history* history = gnomon_history_create();
  gnomon_caster_set* set = nullptr;
  ASSERT_EQ(gnomon_caster_set_create(in.scene.casters, 1, &set, nullptr), GNOMON_OK);
  EXPECT_EQ(allocations - before, 4);

  const int64_t page_bytes = gnomon_page_memory(64, 5000), light_bytes = gnomon_light_memory(1, 0);
  std::vector<std::byte> memory(static_cast<std::size_t>(page_bytes + light_bytes));
  gnomon_page_options pages;
  gnomon_page_options_default(&pages, sizeof pages);
  pages.capacity = 64;
  gnomon_page_plan page_plan;
  gnomon_page_plan_default(&page_plan, sizeof page_plan);
  gnomon_light_request request;
  gnomon_light_request_default(&request, sizeof request);
  request.light = &in.light;
  gnomon_light_maps light_maps;
  gnomon_light_plan lights;
  gnomon_light_plan_default(&lights, sizeof lights);
  lights.lights = &light_maps;
  lights.light_size = sizeof light_maps;
  lights.light_room = 1;
  gnomon_stats stats;
  gnomon_stats_default(&stats, sizeof stats);
  int64_t found = 0;
  const std::vector<float> pixels(960 * 640, 0.5f);
  std::vector<glm::dvec3> edges(8);
  gnomon_shadow_picture picture;
  gnomon_shadow_picture_default(&picture, sizeof picture);
  picture.camera = &in.camera;
  picture.mask = picture.view_depths = picture.occluder_distances = pixels.data();
  picture.pixel_count = 960 * 640;
  gnomon_wrong_pixels wrong;
  before = allocations;
  EXPECT_EQ(gnomon_make_plan(&in.view, &in.light, &in.scene, nullptr, history, &out.plan, nullptr),
            GNOMON_OK);
  EXPECT_EQ(gnomon_measure(&out.plan, &in.view, &in.scene, nullptr, &stats, nullptr), GNOMON_OK);
  EXPECT_EQ(gnomon_expected_error(&out.plan, &picture, &wrong, nullptr), GNOMON_OK);
  EXPECT_EQ(gnomon_shadow_edge_points(&picture, &edges[0].x, 8, &found, nullptr), GNOMON_OK);
  EXPECT_EQ(gnomon_cull_set(out.maps, set, nullptr, 0, &found, nullptr), GNOMON_OK);
  EXPECT_EQ(gnomon_plan_pages(&in.view, &in.light, &in.scene, &pages, nullptr, memory.data(), page_bytes,
                              &page_plan, nullptr),
            GNOMON_OK);
  EXPECT_EQ(gnomon_plan_lights(&in.view, &request, sizeof request, 1, &in.scene, nullptr, nullptr,
                               memory.data(), page_bytes + light_bytes, &lights, nullptr),
            GNOMON_OK);
  EXPECT_EQ(allocations, before);
  gnomon_caster_set_destroy(set);
  gnomon_history_destroy(history);
}

}  // namespace
}  // namespace gnomon::test
