// Writes cases with their plans and errors as the bytes of C structs, which have the same layout on every
// machine as long as they hold no pointer: what bindings compare their own results with.
//   c_dump_cases FILE RANDOM_CASES [MORE]
// Each case: camera, light, options, casters and receivers (two numbers of 32 bits), their boxes, status and
// maps (two numbers), maps, and the error of plans that are ok. MORE: a second file, with pages and lights
// for the same cases: see write_pages and write_lights.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "draw.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "in_c.hpp"

namespace {

using namespace gnomon;

template <typename T>
void write(std::ofstream& file, const T* first, std::size_t count) {
  file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(T)));
}

void write_case(std::ofstream& file, const Case& c) {
  const test::InputInC input(c.camera, c.light, c.casters, c.receivers, c.options);
  test::PlanInC found;
  gnomon_make_plan(&input.view, &input.light, &input.scene, &input.options, nullptr, &found.plan, nullptr);
  write(file, &input.camera, 1);
  write(file, &input.light, 1);
  write(file, &input.options, 1);
  const std::uint32_t counts[] = {static_cast<std::uint32_t>(c.casters.size()),
                                  static_cast<std::uint32_t>(c.receivers.size())};
  write(file, counts, 2);
  write(file, c.casters.data(), c.casters.size());
  write(file, c.receivers.data(), c.receivers.size());
  const std::int32_t result[] = {found.plan.status, found.plan.map_count};
  write(file, result, 2);
  write(file, found.maps, static_cast<std::size_t>(found.plan.map_count));
  if (found.plan.status != GNOMON_OK) return;
  gnomon_measure_options grid;
  gnomon_measure_options_default(&grid, sizeof grid);
  grid.columns = grid.rows = 9;
  grid.depths = 7;
  gnomon_stats stats;
  gnomon_stats_default(&stats, sizeof stats);
  gnomon_measure(&found.plan, &input.view, &input.scene, &grid, &stats, nullptr);
  write(file, &stats, 1);
}

// Status; of pages that are ok: how many, levels, the error that they are for, their entries, the levels'
// maps, their error and texels per pixel. The case's number chooses the policy.
void write_pages(std::ofstream& file, const test::InputInC& input, std::int32_t index) {
  gnomon_page_options options;
  gnomon_page_options_default(&options, sizeof options);
  options.policy = index % gnomon_count(GNOMON_PAGE_POLICIES);
  options.capacity = 64 << (index % 4);
  std::vector<std::byte> memory(static_cast<std::size_t>(gnomon_page_memory(options.capacity, 16384)));
  gnomon_page_plan plan;
  gnomon_page_plan_default(&plan, sizeof plan);
  const std::int32_t status =
      gnomon_plan_pages(&input.view, &input.light, &input.scene, &options, nullptr, memory.data(),
                        static_cast<std::int64_t>(memory.size()), &plan, nullptr);
  write(file, &status, 1);
  if (status != GNOMON_OK) return;
  const std::int32_t counts[] = {static_cast<std::int32_t>(plan.page_count), plan.level_count};
  write(file, counts, 2);
  write(file, &plan.target_m, 1);
  write(file, plan.pages, static_cast<std::size_t>(plan.page_count));
  for (std::int32_t i = 0; i < plan.level_count; ++i) {
    gnomon_map map;
    gnomon_map_default(&map, sizeof map);
    gnomon_page_level(&plan, i, &map, nullptr);
    write(file, &map, 1);
  }
  gnomon_stats stats;
  gnomon_stats_default(&stats, sizeof stats);
  double texels_per_pixel = 0.0;
  gnomon_measure_pages(&plan, &input.view, &input.scene, nullptr, &stats, &texels_per_pixel, nullptr);
  write(file, &stats, 1);
  write(file, &texels_per_pixel, 1);
}

// Status; of three lights: the maps of each. They are that of the case, a lamp and a spot before the eye.
void write_lights(std::ofstream& file, const test::InputInC& input) {
  gnomon_light lights[3];
  for (gnomon_light& light : lights) gnomon_light_default(&light, sizeof light);
  lights[0] = input.light;
  lights[1].kind = 2;
  lights[2].kind = 1;
  lights[2].outer_radians = 0.5;
  for (gnomon_light* light : {&lights[1], &lights[2]}) {
    light->range = input.camera.near_depth * 400.0;
    for (int k = 0; k < 3; ++k) {
      light->position[k] = input.camera.position[k] + (k == 1 ? 0.05 : -0.02) * light->range;
      light->direction[k] = input.camera.forward[k];
    }
  }
  gnomon_light_request requests[3];
  for (int i = 0; i < 3; ++i) {
    gnomon_light_request_default(&requests[i], sizeof requests[i]);
    requests[i].light = &lights[i];
    requests[i].weight = 1.0 + i;
  }
  std::vector<std::byte> memory(static_cast<std::size_t>(gnomon_light_memory(3, 16384)));
  gnomon_light_maps maps[3];
  gnomon_light_plan plan;
  gnomon_light_plan_default(&plan, sizeof plan);
  plan.light_size = sizeof maps[0];
  plan.lights = maps;
  plan.light_room = 3;
  const std::int32_t status =
      gnomon_plan_lights(&input.view, requests, sizeof requests[0], 3, &input.scene, nullptr, nullptr,
                         memory.data(), static_cast<std::int64_t>(memory.size()), &plan, nullptr);
  write(file, &status, 1);
  if (status != GNOMON_INVALID_INPUT) write(file, maps, 3);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: c_dump_cases FILE RANDOM_CASES [MORE]\n");
    return 2;
  }
  std::vector<Case> cases;
  for (const char* folder : {"cases", "stress_random"}) {
    for (const auto& one :
         std::filesystem::directory_iterator(std::filesystem::path(GNOMON_TEST_DATA) / folder))
      cases.push_back(load_case(one.path()));
  }
  const auto random = static_cast<std::uint64_t>(std::atoi(argv[2]));
  for (std::uint64_t i = 0; i < random; ++i) cases.push_back(read_case(stress::draw_case(2026, i).dump()));
  std::ofstream file(argv[1], std::ios::binary), more(argc == 4 ? argv[3] : "", std::ios::binary);
  const auto count = static_cast<std::uint32_t>(cases.size());
  write(file, &count, 1);
  std::int32_t index = 0;
  for (const Case& c : cases) {
    write_case(file, c);
    if (argc == 4) {
      const test::InputInC input(c.camera, c.light, c.casters, c.receivers, c.options);
      write_pages(more, input, index++);
      write_lights(more, input);
    }
  }
  file.close();
  more.close();
  if (!file || (argc == 4 && !more)) {
    std::fprintf(stderr, "%s: could not be written\n", !file ? argv[1] : argv[3]);
    return 1;
  }
  std::printf("%u cases\n", count);
}
