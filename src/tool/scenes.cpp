// `gnomon scenes`: which scenes come with the program, and how to get one as a file.
#include "scenes.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "gnomon/scene/load.hpp"
#include "output.hpp"

namespace gnomon::tool {

namespace {

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

}  // namespace

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

int write_scene(const std::string& name, const std::filesystem::path& out) {
  write_file(out, build_glb(name));
  return 0;
}

}  // namespace gnomon::tool
