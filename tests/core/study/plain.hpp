// A plain with boxes on it, and a machine that takes time for all there is: what techniques are chosen for.
#pragma once

#include <algorithm>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/study/technique.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {

inline constexpr FilterCost kFilters[] = {{"hard", 0.0, 0.0, 2.0, 4.0, 1.2},
                                          {"pcf", 0.0, 0.0, 5.0, 4.0, 1.0}};

/// A plain with boxes on it, and a machine that takes time for all there is.
struct Plain {
  Camera camera = perspective_camera({0, 5, 0}, {0, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 200, 960, 640);
  std::vector<Box> receivers = {{{-90, -1, -200}, {90, 0, -1}}}, casters;
  std::vector<CasterWork> work;
  Light light = DirectionalLight{{0.2, -1, 0.1}};
  Camera picture = camera;
  std::vector<float> mask, depths, occluder_distances;
  CostModel costs{{{0.5, 0.2, 2.0, 1.0, 40.0, 3.0}, kFilters}};
  Budget budget;
  TechniqueSet among;
  PlanOptions base;

  Plain() {
    for (int i = 0; i < 40; ++i) {
      const double z = -2.0 - 5.0 * i;
      casters.push_back({{-20, 0, z - 1}, {20, 4, z}});
      work.push_back({1000, i % 2 == 0});
    }
    picture.width = 120;
    picture.height = 80;
    see(200.0);
  }
  /// The shadow of the boxes on the ground, to a depth.
  void see(double farthest) {
    mask.clear();
    depths.clear();
    for (int i = 0; i < picture.width * picture.height; ++i) {
      const double x = (i % picture.width + 0.5) / picture.width * 2.0 - 1.0,
                   y = 1.0 - (i / picture.width + 0.5) / picture.height * 2.0;
      const glm::dvec3 ray = point_at(picture, x, y, 1.0) - picture.position;
      const double depth = ray.y < 0.0 ? -picture.position.y / ray.y : 0.0;
      const glm::dvec3 ground = picture.position + ray * depth, to_light{-0.2, 1.0, -0.1};
      const bool dark = std::any_of(casters.begin(), casters.end(),
                                    [&](const Box& box) { return cross(box, ground, to_light).hits; });
      depths.push_back(depth < farthest ? static_cast<float>(depth) : 0.0f);
      mask.push_back(dark ? 0.0f : 1.0f);
    }
  }
  [[nodiscard]] ShadowPicture shadow() const { return {picture, mask, depths, occluder_distances}; }
  [[nodiscard]] TechniqueChoice choose() const {
    return choose_technique(camera, shadow(), light, {casters, receivers}, work, among, budget, costs, base);
  }
  /// Every technique of the set, each chosen from itself alone.
  [[nodiscard]] std::vector<Technique> all() const {
    std::vector<Technique> list;
    for (const Warp* warp : {&warps::none, &warps::lispsm, &warps::optimal}) {
      for (int cascades = 1; cascades <= 4; ++cascades) {
        for (const int size : {256, 512, 1024, 2048, 4096}) {
          for (const FilterCost& filter : kFilters) {
            Plain one = *this;
            one.budget = {};
            const Warp* const warp_list[] = {warp};
            const int cascade_list[] = {cascades}, size_list[] = {size};
            one.among = {warp_list, {}, cascade_list, size_list};
            one.costs.filters = {&filter, 1};
            list.push_back(one.choose().chosen);
          }
        }
      }
    }
    return list;
  }
};

}  // namespace gnomon::test
