// Which sweeps does `gnomon compare` go through: of each view and light, with techniques of others?
#include "parts.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>

#include "base/fnv.hpp"
#include "command.hpp"
#include "entry_file.hpp"
#include "exact_results.hpp"
#include "gnomon/scene/default_light.hpp"

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

/// Takes cameras and sun from a capture.
void look_through(const std::string& file, const CapturedMaps& capture, Sweep& sweep) {
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error("--capture " + file + ": " + why);
  };
  const Camera& first = capture.frames.front().camera;
  const double aspect = (first.right - first.left) / (first.top - first.bottom),
               wanted = static_cast<double>(sweep.width) / sweep.height;
  constexpr double kSquare = 0.01;
  if (std::abs(aspect / wanted - 1.0) > kSquare)
    refuse("--size " + std::to_string(sweep.width) + "x" + std::to_string(sweep.height) +
           " would not have square pixels; width over height is " + std::to_string(aspect));
  const auto steps = std::max<std::size_t>(capture.frames.size() - 1, 1);
  if (static_cast<std::size_t>(sweep.frames) > steps)
    refuse("--frames " + std::to_string(sweep.frames) + ": it has " + std::to_string(steps) +
           " frames that another precedes");
  for (const CapturedMaps::Frame& frame : capture.frames) {
    sweep.cameras.push_back(frame.camera);
    sweep.cameras.back().width = sweep.width;
    sweep.cameras.back().height = sweep.height;
  }
  const glm::dvec3& travel = capture.light_direction;
  constexpr double kDegree = std::numbers::pi / 180.0;
  sweep.light = {LightKind::sun, std::asin(std::clamp(-travel.y, -1.0, 1.0)) / kDegree,
                 std::atan2(-travel.x, travel.z) / kDegree};
  std::array<char, 17> hash{};
  ExactKey key(kFnvBasis);
  for (const Camera& camera : sweep.cameras) key.add(camera);
  std::snprintf(hash.data(), hash.size(), "%016" PRIx64, key.hash());
  sweep.camera_text = "capture " + fs::path(file).filename().string() + " " + hash.data();
}

/// Maps and masks of others, behind gnomon's own techniques. An entry that cannot be read is named.
void add_entries(const CompareRequest& request, Sweep& sweep, RefusedEntries& refused) {
  for (const EntryWord& word : request.entries) {
    try {
      if (fs::is_directory(word.path)) {
        sweep.entries.push_back(given_entry(word.name, load_given_masks(word.path)));
        continue;
      }
      const auto captured = load_captured_maps(word.path);
      for (const TechniqueFilter& filter : request.filters) {
        if (filter.irregular_samples == 0)
          sweep.entries.push_back(captured_entry(word.name, filter, captured));
      }
    } catch (const std::runtime_error& error) {
      refused.refuse(word.name, {}, error.what());
    }
  }
}

/// The request with one of its local lights.
CompareRequest with_local_light(const CompareRequest& request, int light) {
  CompareRequest one = request;
  one.local_light = light;
  const Box any{glm::dvec3(0.0), glm::dvec3(1.0)};
  const std::vector<Light> lights = local_lights(request.local_lights, any);
  one.light.kind = std::holds_alternative<SpotLight>(lights[static_cast<std::size_t>(light)])
                       ? LightKind::spot
                       : LightKind::point;
  return one;
}

/// The sweep of a request under one of its lights, numbered behind those before it.
Part part_of(const CompareRequest& request, int light, const std::vector<Part>& before,
             RefusedEntries& refused) {
  Part part{&request, {}, {}};
  try {
    if (!request.capture.empty()) {
      if (!request.camera.path.empty() || !request.camera.of_file.empty() || request.camera.eye)
        throw std::runtime_error("--capture: not with --path, --camera or --eye, which place another");
      const auto capture = load_captured_maps(request.capture);
      Sweep looked;
      static_cast<Measuring&>(looked) = request;
      look_through(request.capture, *capture, looked);
      CompareRequest lit = request;
      lit.light = looked.light;
      part.sweep = make_sweep(lit);
      part.sweep.cameras = looked.cameras;
      part.sweep.camera_text = looked.camera_text;
    } else {
      part.sweep = make_sweep(request.local_lights > 0 ? with_local_light(request, light) : request);
    }
    part.sweep.view = request.view;
    add_entries(request, part.sweep, refused);
  } catch (const std::runtime_error& error) {
    if (request.where.empty()) throw;
    throw std::runtime_error(request.where + ": " + error.what());
  }
  if (before.empty()) return part;
  const Sweep& last = before.back().sweep;
  part.sweep.first_index = last.index(last.scenes.size(), 0, 0);
  part.sweep.first_scene = last.first_scene + last.scenes.size();
  return part;
}

}  // namespace

void RefusedEntries::refuse(const std::string& entry, const std::string& scene, const std::string& why) {
  const std::string line = "entry " + entry + (scene.empty() ? "" : ", " + scene) + ": " + why;
  if (std::find(lines_.begin(), lines_.end(), line) != lines_.end()) return;
  warn(line + "; it is not measured");
  lines_.push_back(line);
}

std::vector<Part> parts_of(std::span<const CompareRequest> requests, RefusedEntries& refused) {
  std::vector<Part> parts;
  for (const CompareRequest& request : requests) {
    for (int light = 0; light < std::max(request.local_lights, 1); ++light)
      parts.push_back(part_of(request, light, parts, refused));
  }
  return parts;
}

}  // namespace gnomon::tool
