// Plans with the core of the tree inside.
#include <cstdio>
#include <gnomon/gnomon.hpp>

int main() {
  const gnomon::Camera camera =
      gnomon::perspective_camera({0, 2, 10}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 100.0, 600, 400);
  const gnomon::Box box{{-5, 0, -20}, {5, 4, 0}};
  const gnomon::ShadowPlan plan =
      gnomon::make_plan(camera, gnomon::DirectionalLight{{0, -1, -0.5}}, {{&box, 1}, {&box, 1}});
  std::printf("engine: %d maps\n", plan.map_count);
  return plan.status == gnomon::PlanStatus::ok ? 0 : 1;
}
