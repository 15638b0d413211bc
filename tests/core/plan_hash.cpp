// Prints the hash of N plans (default 10 000), half of them of extreme input, and what their errors measure:
//   plan_hash [N] [--each]
// --each prints the hash after every plan, to find the first that differs between two builds. Exit 1 where a
// plan divides by zero, overflows or makes an invalid operation, which compilers may add where they divide
// before they choose.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/float_traps.hpp"
#include "support/plan_hash.hpp"
#include "support/seeded_input.hpp"

int main(int argc, char** argv) {
  using namespace gnomon;
  const int plans = argc > 1 && std::atoi(argv[1]) > 0 ? std::atoi(argv[1]) : 10000;
  const bool each = argc > 2 && std::strcmp(argv[2], "--each") == 0;
  test::PlanHash hash;
  test::SeededInput input;
  int trapped = 0;
  for (int i = 0; i < plans; ++i) {
    seed_input(static_cast<std::uint64_t>(i) + 1,
               i % 2 == 0 ? test::Extremes::ordinary : test::Extremes::stiff, input);
    test::choose_picture(i, input);
    ShadowPlan plan;
    double error = 0.0;
    // Measuring takes as long as planning: of some.
    constexpr int kMeasured = 8;
    const bool quiet = test::runs_without_trap([&] {
      plan = input.plan();
      if (i % kMeasured == 0 && plan.status == PlanStatus::ok)
        error = measure(plan, input.camera, input.bounds(), {6, 6, 6}).p95;
    });
    hash.add(plan);
    if (i % kMeasured == 0 && plan.status == PlanStatus::ok) hash.add(error);
    if (!quiet) std::fprintf(stderr, "plan %d raises a floating-point exception\n", i + 1);
    trapped += quiet ? 0 : 1;
    if (each) std::printf("%d %016llx\n", i + 1, static_cast<unsigned long long>(hash.value()));
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(hash.value()));
  return trapped == 0 ? 0 : 1;
}
