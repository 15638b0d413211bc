// OGRE's maps as captures for `gnomon judge` and `gnomon compare --entry`.
#include "ogre_captures.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "case_table.hpp"
#include "judge/capture.hpp"
#include "ogre_setups.hpp"

namespace peers {
namespace {

using namespace gnomon;

/// A set-up by the word in names of files.
struct NamedSetup {
  OgreSetup setup;
  const char* name;
};
constexpr NamedSetup kOfCases[] = {{OgreSetup::lispsm_n_opt, "lispsm"}, {OgreSetup::pssm, "pssm"}};
/// As their constructors leave them.
constexpr NamedSetup kOfCaptures[] = {
    {OgreSetup::focused, "focused"}, {OgreSetup::lispsm, "lispsm"}, {OgreSetup::pssm, "pssm"}};

/// One frame, and the side of its maps.
struct Shot {
  Case scene;
  int size = 1024;
};

void print_matrix(std::FILE* file, const char* key, const glm::dmat4& m) {
  std::fprintf(file, "\"%s\": [", key);
  for (int i = 0; i < 16; ++i) std::fprintf(file, "%s%.17g", i == 0 ? "" : ", ", m[i / 4][i % 4]);
  std::fprintf(file, "]");
}

void print_boxes(std::FILE* file, const char* key, const std::vector<Box>& boxes) {
  std::fprintf(file, "\"%s\": [", key);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    std::fprintf(file, "%s{\"min\": [%.17g, %.17g, %.17g], \"max\": [%.17g, %.17g, %.17g]}",
                 i == 0 ? "" : ", ", boxes[i].min.x, boxes[i].min.y, boxes[i].min.z, boxes[i].max.x,
                 boxes[i].max.y, boxes[i].max.z);
  std::fprintf(file, "]");
}

OgreMaps maps_of(const Shot& shot, OgreSetup setup) {
  OgreScene scene(shot.scene);
  scene.set_up(setup);
  return scene.maps(setup);
}

void print_frame(std::FILE* file, const Shot& shot, const OgreMaps& maps) {
  const Camera& camera = shot.scene.camera;
  std::fprintf(file, "{\"camera\": {");
  print_matrix(file, "view_from_world", view_from_world(camera));
  std::fprintf(file, ", ");
  print_matrix(file, "clip_from_view", clip_from_view(camera));
  std::fprintf(file, ", \"width\": %d, \"height\": %d},\n\"maps\": [", camera.width, camera.height);
  for (std::size_t i = 0; i < static_cast<std::size_t>(maps.count); ++i) {
    std::fprintf(file, "%s{", i == 0 ? "" : ",\n");
    print_matrix(file, "clip_from_world", maps.clip_from_world[i]);
    const bool last = i + 1 == static_cast<std::size_t>(maps.count);
    std::fprintf(file, ", \"width\": %d, \"height\": %d, \"depths\": [%.17g, %.17g]}", shot.size, shot.size,
                 i == 0 ? camera.near_depth : maps.border[i], last ? camera.far_depth : maps.border[i + 1]);
  }
  std::fprintf(file, "]}");
}

/// Throws std::exception where OGRE refuses the view, or the file cannot be written.
void write_capture(const std::string& name, const std::vector<Shot>& shots, OgreSetup setup) {
  std::vector<OgreMaps> maps;  // before there is a file
  for (const Shot& shot : shots) maps.push_back(maps_of(shot, setup));
  std::FILE* const file = std::fopen(name.c_str(), "w");
  const Case& first = shots.front().scene;
  if (file != nullptr) {
    const glm::dvec3 direction = std::get<DirectionalLight>(first.light).direction;
    std::fprintf(file,
                 "{\"format\": \"gnomon-capture/1\", \"name\": \"%s\", \"engine\": \"OGRE 1.12\",\n"
                 "\"lights\": [{\"type\": \"directional\", \"direction\": [%.17g, %.17g, %.17g]}],\n",
                 std::filesystem::path(name).stem().c_str(), direction.x, direction.y, direction.z);
    print_boxes(file, "receivers", first.receivers);
    std::fprintf(file, ",\n");
    print_boxes(file, "casters", first.casters);
    std::fprintf(file, ",\n\"frames\": [");
    for (std::size_t i = 0; i < shots.size(); ++i) {
      if (i > 0) std::fprintf(file, ",\n");
      print_frame(file, shots[i], maps[i]);
    }
    std::fprintf(file, "]}\n");
  }
  if (file == nullptr || std::fclose(file) != 0) throw std::runtime_error("cannot be written");
}

/// What another capture shows. Throws CaseError, and std::runtime_error where it has no sun or no boxes.
std::vector<Shot> shots_of(const std::string& file) {
  const judge::Capture capture = judge::load_capture(file);
  std::vector<Shot> shots;
  for (const judge::CapturedFrame& frame : capture.frames) {
    const judge::CapturedScene& scene = capture.scenes.at(frame.scene);
    if (frame.lights.size() != 1 || !std::holds_alternative<DirectionalLight>(frame.lights.front()) ||
        scene.casters.empty() || scene.receivers.empty() || frame.maps.empty())
      throw std::runtime_error(file + ": needs one sun, maps, casters and receivers");
    Shot shot;
    shot.scene.camera = frame.camera;
    shot.scene.light = frame.lights.front();
    shot.scene.casters = scene.casters;
    shot.scene.receivers = scene.receivers;
    shot.size = frame.maps.front().width;
    shots.push_back(std::move(shot));
  }
  return shots;
}

}  // namespace

int write_captures(const std::string& folder, const std::vector<std::string>& captures) {
  int code = 0;
  // What OGRE refuses is named, and all else is written.
  const auto write = [&](const NamedSetup& setup, const std::string& of, const std::vector<Shot>& shots) {
    const std::string name = folder + "/ogre_" + setup.name + "_" + of + ".json";
    try {
      write_capture(name, shots, setup.setup);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
      code = 1;
    }
  };
  try {
    for (const std::string& file : captures) {
      const std::vector<Shot> shots = shots_of(file);
      for (const NamedSetup& setup : kOfCaptures)
        write(setup, std::filesystem::path(file).stem().string(), shots);
    }
    if (!captures.empty()) return code;
    for (const NamedCase& c : load_cases())
      for (const NamedSetup& setup : kOfCases) write(setup, c.name, {{c, 1024}});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_peers_ogre: %s\n", error.what());
    return 2;
  }
  return code;
}

}  // namespace peers
