// `gnomon scenes`: which scenes come with the program, and how to get one as a file.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/load.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

struct ScenesRequest {
  std::vector<std::string> write;  ///< empty, or a name and a file
  bool json = false;
};

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.emplace_back(scene.name);
  return names;
}

std::string table_row(const BuiltinScene& entry, const Scene& scene) {
  const glm::dvec3 size = scene.bounds_world.max - scene.bounds_world.min;
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "%-8.*s %9llu triangles %6zu instances %7.1f x %6.1f x %7.1f  ",
                static_cast<int>(entry.name.size()), entry.name.data(),
                static_cast<unsigned long long>(scene.triangle_count()), scene.instances.size(), size.x,
                size.y, size.z);
  return numbers + std::string(entry.summary);
}

nlohmann::json to_json(const BuiltinScene& entry, const Scene& scene) {
  const Box& box = scene.bounds_world;
  return {{"name", std::string(entry.name)},          {"summary", std::string(entry.summary)},
          {"triangles", scene.triangle_count()},      {"instances", scene.instances.size()},
          {"materials", scene.materials.size()},      {"images", scene.images.size()},
          {"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}};
}

/// Name, triangles, instances, extents and summary of every builtin scene, as a table or as one line of JSON.
int list_scenes(bool json) {
  nlohmann::json list = nlohmann::json::array();
  for (const BuiltinScene& entry : builtin_scenes()) {
    const Scene scene = load_builtin(entry.name);
    if (json) {
      list.push_back(to_json(entry, scene));
    } else {
      print_line(table_row(entry, scene));
    }
  }
  if (json) print_line(nlohmann::json{{"scenes", list}}.dump());
  flush_output();
  return 0;
}

/// Writes a builtin scene as a binary glTF file. Throws SceneError for an unknown name.
int write_scene(const std::string& name, const std::filesystem::path& out) {
  const std::vector<std::string> names = scene_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) refuse_name("--write", name, names);
  write_file(out, build_glb(name));
  return 0;
}

}  // namespace

std::function<int()> declare_scenes(Arguments& arguments) {
  const auto request = std::make_shared<ScenesRequest>();
  arguments.options = {{.name = "--write",
                        .target = &request->write,
                        .help = "write the built-in scene NAME to FILE.glb",
                        .word = "NAME FILE.glb",
                        .names = scene_names(),
                        .only_names = false,
                        .words = 2},
                       {.name = "--json", .target = &request->json, .help = "print the list as JSON"}};
  return [request] {
    return request->write.empty() ? list_scenes(request->json)
                                  : write_scene(request->write[0], request->write[1]);
  };
}

}  // namespace gnomon::tool
