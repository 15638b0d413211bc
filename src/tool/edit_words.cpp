// Edits of a scene on a command line.
#include "edit_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

SectionPlane plane_word(const std::string& option, const std::string& word) {
  double numbers[4];
  const char* at = word.data();
  const char* const end = word.data() + word.size();
  const auto refuse = [&] {
    throw std::runtime_error(
        fmt::format("{} {}: wants four numbers, a normal and a distance, as in 0,1,0,2.5", option, word));
  };
  for (int i = 0; i < 4; ++i) {
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc{} || !(std::abs(numbers[i]) <= 1e30)) refuse();
    at = next;
    if (i < 3 && (at == end || *at++ != ',')) refuse();
  }
  if (at != end) refuse();
  const SectionPlane plane{{numbers[0], numbers[1], numbers[2]}, numbers[3]};
  if (plane.normal == glm::dvec3(0.0))
    throw std::runtime_error(fmt::format("{} {}: the normal must not be zero", option, word));
  return plane;
}

}  // namespace

std::vector<SectionPlane> section_words(const std::string& option, const std::string& word) {
  std::vector<SectionPlane> planes;
  for (std::size_t begin = 0; begin <= word.size();) {
    const std::size_t end = std::min(word.find('/', begin), word.size());
    if (planes.size() == kMaxSections)
      throw std::runtime_error(fmt::format("{}: at most {} planes", option, kMaxSections));
    planes.push_back(plane_word(option, word.substr(begin, end - begin)));
    begin = end + 1;
  }
  return planes;
}

std::string section_text(const std::vector<SectionPlane>& planes) {
  std::string text;
  for (const SectionPlane& plane : planes)
    text += fmt::format("{}{},{},{},{}", text.empty() ? "" : "/", plane.normal.x, plane.normal.y,
                        plane.normal.z, plane.distance);
  return text;
}

std::vector<Option> edit_options(SceneEdits& edits) {
  const auto set = [&edits](const std::string& word) {
    edits.sections = section_words("--section", word);
    return true;
  };
  return {{.name = "--up",
           .target = enum_word(edits.up, up_axis_names()),
           .help = "axis of the scene's file that points up, y as glTF has it, or z",
           .names = up_axis_names()},
          {.name = "--open-sky",
           .target = &edits.open_sky,
           .help = "let a mesh that surrounds the scene as its sky cast no shadow"},
          {.name = "--ground",
           .target = &edits.ground,
           .help = "add a ground under the scene's lowest point, which receives shadows"},
          {.name = "--section",
           .target = ParsedWord{set, {}},
           .help = "cut away what lies beyond planes: all p with normal . p > D; / between planes",
           .word = "NX,NY,NZ,D"},
          {.name = "--proxies",
           .target = &edits.proxies,
           .help = "glTF file whose meshes cast in place of those of the same names",
           .completion = Completion::files}};
}

std::string edit_text(const SceneEdits& edits, const LoadLimits& limits) {
  std::string text = edits.ground ? "ground" : "";
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
  if (edits.up == UpAxis::z) add("up z");
  if (edits.open_sky) add("open sky");
  if (!edits.sections.empty()) add("section " + section_text(edits.sections));
  if (!edits.proxies.empty())
    add(fmt::format("proxies {} {:016x}", scene_title(edits.proxies),
                    scene_files_hash(edits.proxies, limits)));
  return text;
}

std::string proxies_text(const Scene& scene) {
  const bool any = std::any_of(scene.instances.begin(), scene.instances.end(),
                               [](const Instance& instance) { return instance.has_proxy; });
  const CastTriangles triangles = cast_triangles(scene);
  return any ? fmt::format("shadow proxies cast {} triangles in place of {}", triangles.by_proxies,
                           triangles.without)
             : "";
}

Scene load_edited(const std::string& spec, const LoadLimits& limits, const SceneEdits& edits) {
  Scene scene = load_scene(spec, limits);
  edit(edits, scene, limits);
  return scene;
}

}  // namespace gnomon::tool
