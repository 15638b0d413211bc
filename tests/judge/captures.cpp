// The shipped captures as JSON, and what tests do to them.
#include "captures.hpp"

#include <fstream>
#include <glm/ext/matrix_transform.hpp>

namespace gnomon::judge::test {

Json shipped(const std::string& name) {
  std::ifstream file(std::string(GNOMON_CAPTURES "/") + name + ".json");
  return Json::parse(file);
}

Json sound(const std::string& name) {
  Json capture = shipped(name);
  for_each_map(capture, [](Json& map, std::size_t) {
    if (!map.contains("stores")) map["bias"] = {{"texels", 0.5}, {"follows_plane", true}};
  });
  return capture;
}

void for_each_map(Json& capture, const std::function<void(Json& map, std::size_t index)>& change) {
  const auto of = [&](Json& frame) {
    for (std::size_t i = 0; i < frame["maps"].size(); ++i) change(frame["maps"][i], i);
  };
  if (capture.contains("maps")) of(capture);
  if (!capture.contains("frames")) return;
  for (Json& frame : capture["frames"]) of(frame);
}

glm::dmat4 matrix(const Json& numbers) {
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)].get<double>();
  return m;
}

glm::dmat4 scaled(double x, double y, double z, double shift_z) {
  glm::dmat4 m = glm::scale(glm::dmat4(1.0), {x, y, z});
  m[3][2] = shift_z;
  return m;
}

std::string refusal(const std::string& text) {
  try {
    (void)read_capture(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "taken";
}

void transform_maps(Json& capture, const glm::dmat4& left, int only) {
  for_each_map(capture, [&](Json& map, std::size_t index) {
    if (only >= 0 && index != static_cast<std::size_t>(only)) return;
    map["clip_from_world"] = numbers(left * matrix(map["clip_from_world"]));
  });
}

Judgement judged(const Json& capture) {
  return judge(read_capture(capture.dump()));
}

std::vector<std::string> kinds(const Judgement& judgement) {
  std::vector<std::string> names;
  for (const Finding& finding : judgement.findings) names.emplace_back(to_string(finding.kind));
  return names;
}

}  // namespace gnomon::judge::test
