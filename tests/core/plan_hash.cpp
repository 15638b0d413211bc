// Prints the hash of N plans (default 10 000), half of them of extreme input, and what their errors measure:
//   plan_hash [N] [--each]
// --each prints the hash after every plan, to find the first that differs between two builds.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/plan_hash.hpp"
#include "support/seeded_input.hpp"

int main(int argc, char** argv) {
  using namespace gnomon;
  const int plans = argc > 1 && std::atoi(argv[1]) > 0 ? std::atoi(argv[1]) : 10000;
  const bool each = argc > 2 && std::strcmp(argv[2], "--each") == 0;
  test::PlanHash hash;
  test::SeededInput input;
  for (int i = 0; i < plans; ++i) {
    seed_input(static_cast<std::uint64_t>(i) + 1,
               i % 2 == 0 ? test::Extremes::ordinary : test::Extremes::stiff, input);
    const ShadowPlan plan = input.plan();
    hash.add(plan);
    // Measuring takes as long as planning: of some.
    constexpr int kMeasured = 8;
    if (i % kMeasured == 0 && plan.status == PlanStatus::ok)
      hash.add(measure(plan, input.camera, input.bounds(), {6, 6, 6}).p95);
    if (each) std::printf("%d %016llx\n", i + 1, static_cast<unsigned long long>(hash.value()));
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
  return 0;
}
