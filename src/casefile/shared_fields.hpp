// How do files have lights, clip spaces and points of surfaces? Cases and captures have them alike.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/casefile/casefile.hpp"
#include "gnomon/clip_space.hpp"
#include "gnomon/light.hpp"
#include "json_fields.hpp"

namespace gnomon {

/// "lights[2]".
[[nodiscard]] std::string element_path(const std::string& path, std::size_t index);

/// Sets `out` by the name under `key`, if there is one. `set` returns false for a name that is none of
/// `names`.
template <typename Value, typename Set>
void read_name(const Fields& fields, std::string_view key, Value& out, const char* names, Set set) {
  if (!fields.has(key)) return;
  const std::string name = fields.text(key);
  if (!set(name, out)) fields.refuse(key, "is \"" + one_line(name, 40) + "\", not one of " + names);
}

/// More than 0 and less than 180, in radians.
[[nodiscard]] double half_open_degrees(const Fields& fields, std::string_view key);

/// `path`: of the light. `more`: keys beside those of its type.
[[nodiscard]] Light light_from(const nlohmann::json& value, const std::string& path,
                               const std::vector<std::string_view>& more = {});

[[nodiscard]] ClipSpace clip_space_from(const nlohmann::json& value, const std::string& path);

/// Points of visible surfaces; normals as the file has them, as many or none.
struct ListedPoints {
  std::vector<glm::dvec3> points, normals;
};
/// Lists of three numbers, or of six with the normal.
[[nodiscard]] ListedPoints points_from(const Fields& fields, std::string_view key);

}  // namespace gnomon
