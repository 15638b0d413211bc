// Plans one map through the installed core. all_headers.hpp is written by the test: every header that is
// installed.
#include <cstdio>

#include "all_headers.hpp"

int main() {
  const gnomon::Camera camera =
      gnomon::perspective_camera({0, 2, 10}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, 600, 400);
  const gnomon::Box box{{-5, 0, -20}, {5, 4, 0}};
  const gnomon::ShadowPlan plan =
      gnomon::make_plan(camera, gnomon::DirectionalLight{{0, -1, -0.5}}, {{&box, 1}, {&box, 1}});
  std::printf("consumer of core %.*s: %d maps\n", static_cast<int>(gnomon::kVersion.size()),
              gnomon::kVersion.data(), plan.map_count);
  return plan.status == gnomon::PlanStatus::ok && plan.map_count > 0 ? 0 : 1;
}
