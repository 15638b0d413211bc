// Random and extreme input of make_plan from a number alone: the same bits for every compiler and C library.
#include "seeded_input.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "lanes/elementary.hpp"

namespace gnomon::test {
namespace {

constexpr double kPi = 3.141592653589793;

glm::dvec3 unit_vector(SeededNumbers& random) {
  for (;;) {
    const glm::dvec3 v = random.vector();
    const double square = glm::dot(v, v);
    if (square > 0.01 && square < 1.0) return v / std::sqrt(square);
  }
}

Camera seeded_camera(SeededNumbers& random, bool stiff) {
  Camera c;
  const double world = stiff ? random.power_of_two(-30, 30) : random.power_of_two(-2, 9);
  c.far_depth = world;
  c.near_depth = world / random.power_of_two(0.03, stiff ? 36.0 : 16.6);
  if (stiff && random.chance(0.1)) c.near_depth = world * (1.0 - 1e-12);
  // One number to a statement: compilers take the operands of + and * in either order.
  const glm::dvec3 place = random.vector();
  c.position = place * (world * (stiff && random.chance(0.3) ? 1e7 : 2.0));
  c.forward = unit_vector(random);
  c.up = stiff && random.chance(0.1) ? c.forward : glm::dvec3(0, 1, 0);
  const double degrees =
      stiff ? (random.chance(0.2) ? 0.01 : random.between(0.01, 179.9)) : random.between(1, 150);
  c.top = elementary::tan(0.5 * degrees * kPi / 180.0);
  const double aspect = stiff ? random.power_of_two(-5.6, 5.6) : random.between(0.4, 2.5);
  c.orthographic = random.chance(0.15);
  if (c.orthographic) c.top = world * random.power_of_two(-6, 1);
  c.bottom = -c.top;
  c.right = c.top * aspect;
  c.left = -c.right;
  if (random.chance(0.15)) {
    const double x = random.between(-1.5, 1.5) * c.right, y = random.between(-1.5, 1.5) * c.top;
    c.left += x;
    c.right += x;
    c.bottom += y;
    c.top += y;
  }
  c.height = 64 + random.pick(1017);
  c.width = std::max(1, static_cast<int>(c.height * aspect));
  if (random.chance(0.05)) c.far_depth = std::numeric_limits<double>::infinity();
  return c;
}

/// `reach`: the camera's far depth, or what stands for it.
Light seeded_light(SeededNumbers& random, const Camera& camera, double reach, bool stiff) {
  const glm::dvec3 forward = glm::normalize(camera.forward), free = unit_vector(random);
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  const int kind = random.pick(10);
  if (kind < 7) {
    glm::dvec3 d = free;
    if (kind == 0) d = {0, -1, 0};
    if (kind == 1) d = forward * sign;
    if (kind == 2) d = forward * sign + free * random.power_of_two(stiff ? -1000.0 : -40.0, -3.0);
    if (kind == 3) d = glm::cross(forward, free);
    const double length = random.power_of_two(-10, 10);
    if (glm::dot(d, d) > 0.0) return DirectionalLight{d * length};
    return DirectionalLight{};
  }
  const double ahead = random.between(-0.2, 1.2), away = random.unit();
  const glm::dvec3 aside = random.vector();
  const bool at_eye = stiff && random.chance(0.2);
  const glm::dvec3 position =
      at_eye ? camera.position : camera.position + (forward * ahead + aside) * (reach * away);
  const double range = reach * random.power_of_two(stiff ? -20.0 : -4.0, 3.0);
  if (kind == 9) return PointLight{position, range};
  const double half = stiff ? random.between(1e-6, kPi - 1e-6) : random.between(0.05, 1.6);
  return SpotLight{position, random.chance(0.2) ? forward * sign : free, half, range};
}

Box seeded_box(SeededNumbers& random, const Camera& camera, double reach, bool stiff) {
  const glm::dvec3 forward = glm::normalize(camera.forward);
  const double depth = reach * random.power_of_two(stiff ? -20.0 : -8.0, 0.3);
  const double across = camera.orthographic ? camera.top : std::min(camera.top, 3.0) * depth;
  const glm::dvec3 centre = camera.position + forward * depth + random.vector() * across;
  glm::dvec3 half;
  for (int axis = 0; axis < 3; ++axis)
    half[axis] =
        random.chance(0.1) ? 0.0 : depth * random.power_of_two(stiff ? -30.0 : -8.0, stiff ? 4.0 : 1.0);
  if (random.chance(0.03)) half = glm::dvec3(0.0);
  if (stiff && random.chance(0.05)) half = -half;
  return {centre - half, centre + half};
}

void seed_options(SeededNumbers& random, double reach, SeededInput& input) {
  PlanOptions& o = input.options;
  o = PlanOptions{};
  o.resolution.max_size = random.chance(0.05) ? 4 : 64 << random.pick(8);
  o.cascades = 1 + random.pick(kMaxMaps);
  o.split.partition =
      random.chance(0.75) ? Partition::view_depth : static_cast<Partition>(1 + random.pick(2));
  o.split.scheme = static_cast<SplitScheme>(random.pick(7));
  o.split.lambda = random.unit();
  o.split.range = static_cast<SplitRange>(random.pick(3));
  const double n = input.camera.near_depth;
  if (random.chance(0.2))
    o.split.pseudo_near =
        n * elementary::pow(std::max(reach / std::max(n, reach * 1e-9), 1.0), random.unit());
  o.fit = random.chance(0.5) ? Fit::tight : static_cast<Fit>(1 + random.pick(3));
  o.warp.objective = static_cast<Objective>(random.pick(3));
  const int warp = random.pick(static_cast<int>(all_warps().size()) + 2);
  if (static_cast<std::size_t>(warp) < all_warps().size())
    o.warp.warp = all_warps()[static_cast<std::size_t>(warp)];
  if (random.chance(0.5)) o.filter.texels = random.between(0.0, std::min(8.0, 0.25 * o.resolution.max_size));
  if (random.chance(0.1)) o.filter.world = reach * random.power_of_two(-20, 0);
  if (random.chance(0.1)) o.resolution.max_error = random.power_of_two(-3, 3);
  if (random.chance(0.1)) {
    const std::int64_t least = least_budget_side(o);
    o.resolution.texel_budget = least * least * 8 + static_cast<std::int64_t>(random.power_of_two(0, 24));
  }
  for (int i = 1; i < o.cascades; ++i)
    o.split.given[static_cast<std::size_t>(i - 1)] = n + (reach - n) * i / o.cascades;
  input.visible = nullptr;
  if (random.chance(0.1) && !input.camera.orthographic) {
    const double begin = std::max(n, 1e-9 * reach) * 1.5;
    input.depths = visible_between(begin, std::max(begin, reach * random.unit()));
    input.visible = &input.depths;
  }
  if (random.chance(0.2)) o.split.overlap = random.unit();
  if (random.chance(0.5)) o.prune = PruneRules::all();
  if (random.chance(0.3)) o.prune.bits = static_cast<std::uint32_t>(random.bits()) & PruneRules::kAll;
  if (random.chance(0.3)) o.resolution.prune_error = random.power_of_two(random.chance(0.1) ? -29 : -3, 3);
  o.clip_space.ndc_depth = static_cast<NdcDepth>(random.pick(2));
  o.clip_space.reversed_z = random.chance(0.3);
  o.clip_space.y_down = random.chance(0.3);
  o.clip_space.handedness = static_cast<Handedness>(random.pick(2));
}

}  // namespace

std::uint64_t SeededNumbers::bits() {
  state_ += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double SeededNumbers::power_of_two(double low, double high) {
  return elementary::exp2(between(low, high));
}

void seed_input(std::uint64_t seed, Extremes extremes, SeededInput& input) {
  SeededNumbers random(seed);
  const bool stiff = extremes == Extremes::stiff;
  input.camera = seeded_camera(random, stiff);
  const double reach =
      std::isinf(input.camera.far_depth) ? input.camera.near_depth * 1000.0 : input.camera.far_depth;
  input.light = seeded_light(random, input.camera, reach, stiff);
  input.receivers.clear();
  input.casters.clear();
  const int receivers = stiff && random.chance(0.05) ? 0 : 1 + random.pick(random.chance(0.5) ? 2 : 24);
  for (int i = 0; i < receivers; ++i)
    input.receivers.push_back(seeded_box(random, input.camera, reach, stiff));
  if (random.chance(0.4)) {  // a ground under everything
    const glm::dvec3 e = input.camera.position;
    input.receivers.push_back({e - glm::dvec3(2, 0.2, 2) * reach, e + glm::dvec3(2, -0.1, 2) * reach});
  }
  if (random.chance(0.5)) {
    input.casters = input.receivers;
  } else {
    const int casters = 1 + random.pick(24);
    for (int i = 0; i < casters; ++i) input.casters.push_back(seeded_box(random, input.camera, reach, stiff));
  }
  seed_options(random, reach, input);
}

}  // namespace gnomon::test
