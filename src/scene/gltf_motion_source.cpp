// Which animations does a glTF document name, before any key is read?
#include "gltf_motion_source.hpp"

#include <nlohmann/json.hpp>

#include "gltf_check.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

using nlohmann::json;

namespace {

AnimationSource animation_source(const json& checked) {
  AnimationSource out;
  out.name = one_line(checked.value("name", std::string()));
  for (const json& keys : checked["samplers"])
    out.samplers.push_back({keys["input"].get<int>(), keys["output"].get<int>(),
                            keys.value("interpolation", std::string("LINEAR"))});
  for (const json& channel : checked["channels"]) {
    const json& target = channel["target"];
    out.channels.push_back(
        {channel["sampler"].get<std::size_t>(), target.value("node", -1), target["path"].get<std::string>()});
  }
  return out;
}

const json* list_of(const json& source, const char* key) {
  const auto it = source.find(key);
  return it != source.end() && it->is_array() ? &*it : nullptr;
}

/// Runs `read`; where it refuses, that is a warning.
template <class Read>
void leniently(std::vector<std::string>& warnings, Read&& read) {
  try {
    read();
  } catch (const Refusal& e) {
    warn(warnings, e.what() + std::string(", skipped"));
  }
}

void read_targets(const json& source, MotionSource& out, std::vector<std::string>& warnings) {
  const json* meshes = list_of(source, "meshes");
  for (std::size_t m = 0; meshes != nullptr && m < meshes->size(); ++m) {
    const json& mesh = (*meshes)[m];
    const std::string where = element("meshes", m);
    leniently(warnings, [&] {
      std::vector<float> weights = checked_weights(mesh, where);
      if (!weights.empty()) out.mesh_weights[static_cast<int>(m)] = std::move(weights);
    });
    const json* primitives = list_of(mesh, "primitives");
    for (std::size_t p = 0; primitives != nullptr && p < primitives->size(); ++p) {
      leniently(warnings, [&] {
        std::vector<MorphSource> targets;
        for (const json& target :
             checked_morph_targets(source, (*primitives)[p], where + "." + element("primitives", p)))
          targets.push_back({target.value("POSITION", -1), target.value("NORMAL", -1)});
        if (!targets.empty()) out.targets[{static_cast<int>(m), static_cast<int>(p)}] = std::move(targets);
      });
    }
  }
  const json* nodes = list_of(source, "nodes");
  for (std::size_t n = 0; nodes != nullptr && n < nodes->size(); ++n) {
    leniently(warnings, [&] {
      std::vector<float> weights = checked_weights((*nodes)[n], element("nodes", n));
      if (!weights.empty()) out.node_weights[static_cast<int>(n)] = std::move(weights);
    });
  }
}

}  // namespace

MotionSource read_motion_source(const json& source, std::vector<std::string>& warnings) {
  MotionSource out;
  read_targets(source, out, warnings);
  const auto animations = source.find("animations");
  if (animations == source.end()) return out;
  if (!animations->is_array()) {
    warn(warnings, "animations", "must be a list, skipped");
    return out;
  }
  for (std::size_t i = 0; i < animations->size(); ++i) {
    out.animations.emplace_back();
    leniently(warnings, [&] {
      out.animations.back() =
          animation_source(checked_animation(source, (*animations)[i], element("animations", i)));
    });
  }
  return out;
}

}  // namespace gnomon::detail
