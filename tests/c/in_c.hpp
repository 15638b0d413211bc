// A case of C++ as a program of C would write it down: field by field, and nothing from src/c.
#pragma once

#include <bit>
#include <vector>

#include "gnomon/c/gnomon.h"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {

gnomon_camera in_c(const Camera& camera);
gnomon_light in_c(const Light& light);
gnomon_clip_space in_c(const ClipSpace& space);
gnomon_plan_options in_c(const PlanOptions& options);

/// The first field in which the two differ by a bit, or "".
std::string first_difference(const ShadowMap& map, const gnomon_map& in_c);
/// The same of plans. `omissions` and `maps` are those of the plan in C.
std::string first_difference(const ShadowPlan& plan, const gnomon_plan& in_c);
std::string first_difference(const AliasingStats& stats, const gnomon_stats& in_c);

/// A plan of C with room for all that a plan may hold. Not to be copied: it points into itself.
struct PlanInC {
  gnomon_map maps[GNOMON_MAX_MAPS];
  gnomon_omission omissions[GNOMON_MAX_OMISSIONS];
  gnomon_plan plan;

  PlanInC();
  PlanInC(const PlanInC&) = delete;
  PlanInC& operator=(const PlanInC&) = delete;
};

/// What make_plan takes, in C. Points into the boxes that it was made from, and into itself.
struct InputInC {
  gnomon_camera camera;
  gnomon_view view;
  gnomon_light light;
  gnomon_scene scene;
  gnomon_plan_options options;

  InputInC(const Camera& camera, const Light& light, const std::vector<Box>& casters,
           const std::vector<Box>& receivers, const PlanOptions& options);
  InputInC(const InputInC&) = delete;
  InputInC& operator=(const InputInC&) = delete;
};

/// The lists of gnomon_cluster_lights() with room for `room` entries, tiles of 64 pixels and 48 slices.
/// Points into itself.
struct ClustersInC {
  std::vector<std::uint32_t> begin, list;
  gnomon_light_clusters found;
  std::int32_t status;

  ClustersInC(const gnomon_camera& camera, const std::vector<gnomon_light>& lights, std::int64_t room);
  ClustersInC(const ClustersInC&) = delete;
  ClustersInC& operator=(const ClustersInC&) = delete;
};

}  // namespace gnomon::test
