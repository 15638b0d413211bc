// Does any file, taken for glTF or GLB, become a sound scene, in every pose, or a refusal of one line?
#include <algorithm>
#include <cmath>

#include "fuzz.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/scene/pose.hpp"
#include "load_memory.hpp"

namespace {

using gnomon::Scene;
using gnomon::fuzz::require;

// Small, so that an input of a few bytes that stands for millions of triangles is refused and not built. Real
// scenes, which have files beside them, get what the largest of them needs.
gnomon::LoadLimits small_limits() {
  gnomon::LoadLimits limits;
  if (!gnomon::fuzz::folder_of_input().empty()) {
    limits.file_bytes = limits.total_bytes = 1 << 26;
    limits.triangles = limits.vertices = 2'000'000;
    limits.pixels = 1 << 24;
    return limits;
  }
  limits.file_bytes = limits.total_bytes = 1 << 20;
  limits.triangles = limits.vertices = 20'000;
  limits.pixels = 1 << 16;
  limits.nodes = 1000;
  limits.animation_numbers = 100'000;
  return limits;
}

void check_arrays(const Scene& scene) {
  require(scene.normals.size() == scene.positions.size(), "a normal per vertex");
  require(scene.texcoords.size() == scene.positions.size(), "a texture coordinate per vertex");
  for (const std::uint32_t index : scene.indices) require(index < scene.positions.size(), "indices in range");
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      require(std::isfinite(scene.positions[i][c]), "finite positions");
      require(std::isfinite(scene.normals[i][c]), "finite normals");
    }
    require(std::isfinite(scene.texcoords[i].x) && std::isfinite(scene.texcoords[i].y),
            "finite texture coordinates");
  }
}

void check_records(const Scene& scene) {
  require(!scene.materials.empty(), "a default material");
  for (const gnomon::Primitive& p : scene.primitives) {
    require(p.index_count % 3 == 0 && p.index_count > 0, "whole triangles");
    require(std::uint64_t{p.first_index} + p.index_count <= scene.indices.size(), "primitives in range");
    require(p.material >= 0 && static_cast<std::size_t>(p.material) < scene.materials.size(),
            "materials in range");
  }
  for (const gnomon::Instance& i : scene.instances) {
    require(i.primitive < scene.primitives.size(), "instances in range");
    require(!i.bounds_world.empty(), "instances have bounds");
    for (int c = 0; c < 3; ++c) {
      require(std::isfinite(i.bounds_world.min[c]) && std::isfinite(i.bounds_world.max[c]), "finite bounds");
    }
  }
  for (const gnomon::Material& m : scene.materials) {
    require(m.base_color_image < static_cast<int>(scene.images.size()), "images in range");
    require(std::isfinite(m.alpha_cutoff), "a finite cutoff");
  }
  for (const gnomon::Image& image : scene.images) {
    require(image.width > 0 && image.height > 0, "pictures have pixels");
    require(image.rgba.size() ==
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4,
            "as many pixels as the size says");
  }
}

void check_pose(const Scene& scene, int animation, double time_s) {
  gnomon::Pose pose;
  require(gnomon::pose(scene, animation, time_s, pose), "a pose");
  require(pose.positions.size() == pose.normals.size(), "a normal per posed vertex");
  Scene posed = scene;
  gnomon::apply_pose(pose, posed);
  check_arrays(posed);
  check_records(posed);
}

void check_poses(const Scene& scene) {
  constexpr std::size_t kMost = 4;
  const std::vector<gnomon::Animation>& animations = scene.motion.animations;
  check_pose(scene, gnomon::kRestPose, 0.0);
  for (std::size_t i = 0; i < std::min(animations.size(), kMost); ++i) {
    for (const double share : {0.0, 0.37, 1.0})
      check_pose(scene, static_cast<int>(i), share * animations[i].duration_s);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Scene scene = gnomon::detail::load_gltf_bytes({data, size}, "fuzz", "fuzz",
                                                        gnomon::fuzz::folder_of_input(), small_limits());
    check_arrays(scene);
    check_records(scene);
    check_poses(scene);
    for (const std::string& warning : scene.warnings) gnomon::fuzz::require_one_line(warning);
  } catch (const gnomon::SceneError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
