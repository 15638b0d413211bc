// Which animations does a glTF document name, before any key is read?
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::detail {

/// Accessors of one morph target's offsets; -1: none.
struct MorphSource {
  int positions = -1, normals = -1;
};

/// One animation as the file has it; indices into accessors and nodes are in range.
struct AnimationSource {
  struct Keys {
    int input = 0, output = 0;
    std::string interpolation;
  };
  struct Channel {
    std::size_t sampler = 0;  // may be out of range
    int node = -1;            // -1: an extension names what moves
    std::string path;
  };
  std::string name;
  std::vector<Keys> samplers;
  std::vector<Channel> channels;
};

struct MotionSource {
  std::vector<AnimationSource> animations;  // in the file's order; broken ones are there, and empty
  std::map<std::pair<int, int>, std::vector<MorphSource>>
      targets;                                                   // of mesh and primitive, where there are any
  std::map<int, std::vector<float>> node_weights, mesh_weights;  // where there are any
};

/// Breaks in animations, targets and weights are warned of, and what they are in is skipped.
[[nodiscard]] MotionSource read_motion_source(const nlohmann::json& source,
                                              std::vector<std::string>& warnings);

}  // namespace gnomon::detail
