// Shoots one ray at one triangle through the installed tracer.
#include <array>
#include <cstdint>
#include <cstdio>

#include "all_headers.hpp"

int main() {
  gnomon::Scene scene;
  scene.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.texcoords.assign(3, {0, 0});
  scene.indices = {0, 1, 2};
  scene.materials.resize(1);
  scene.primitives.resize(1);
  scene.primitives[0].index_count = 3;
  scene.instances.resize(1);
  const gnomon::trace::Tracer tracer(scene);
  gnomon::trace::Ray ray;
  ray.origin = {0, 0, 5};
  ray.direction = {0, 0, -1};
  std::array<std::uint8_t, 1> stopped{};
  tracer.occluded({&ray, 1}, stopped);
  std::printf("consumer of trace: %zu triangle, stopped: %d\n", tracer.triangle_count(), stopped[0]);
  return stopped[0] == 1 ? 0 : 1;
}
