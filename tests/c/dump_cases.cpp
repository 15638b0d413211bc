// Writes cases with their plans and errors as the bytes of C structs, which have the same layout on every machine as long as
// they hold no pointer: what bindings compare their own results with.
//   c_dump_cases FILE RANDOM_CASES
// Each case: camera, light, options, casters and receivers (two numbers of 32 bits), their boxes, status and maps (two
// numbers), maps, and the error of plans that are ok.
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: c_dump_cases FILE RANDOM_CASES\n");
    return 2;
  }
  std::vector<Case> cases;
  for (const char* folder : {"cases", "stress_random"}) {
    for (const auto& one : std::filesystem::directory_iterator(std::filesystem::path(GNOMON_TEST_DATA) / folder))
      cases.push_back(load_case(one.path()));
  }
  const auto random = static_cast<std::uint64_t>(std::atoi(argv[2]));
  for (std::uint64_t i = 0; i < random; ++i) cases.push_back(read_case(stress::draw_case(2026, i).dump()));
  std::ofstream file(argv[1], std::ios::binary);
  const auto count = static_cast<std::uint32_t>(cases.size());
  write(file, &count, 1);
  for (const Case& c : cases) write_case(file, c);
  file.close();
  if (!file) {
    std::fprintf(stderr, "%s: could not be written\n", argv[1]);
    return 1;
  }
  std::printf("%u cases\n", count);
}
