// What stands in the scene of a capture: boxes, visible points, or a picture of depths.
#include "judge/capture_scene.hpp"

#include <glm/geometric.hpp>

#include "judge/depth_picture.hpp"
#include "shared_fields.hpp"

namespace gnomon::judge {
namespace {

constexpr std::size_t kMostPoints = 100000;

void read_points(const Fields& fields, CapturedScene& scene) {
  if (fields.at("points").size() > kMostPoints) fields.refuse("points", "holds more than 100000");
  ListedPoints listed = points_from(fields, "points");
  scene.points = std::move(listed.points);
  for (std::size_t i = 0; i < listed.normals.size(); ++i) {
    const double length = glm::length(listed.normals[i]);
    if (!(length > 0.0))
      throw CaseError(element_path(fields.path_of("points"), i) + ": has a normal without length");
    scene.normals.push_back(listed.normals[i] / length);
  }
}

std::vector<Box> boxes_of(const Fields& fields, std::string_view key) {
  if (!fields.has(key)) return {};
  std::vector<Box> boxes = fields.boxes(key);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    const double largest = std::max(glm::length(box.min), glm::length(box.max));
    if (box.empty() || !(largest <= kLargestNumber))
      throw CaseError(element_path(fields.path_of(key), i) +
                      (box.empty() ? ": has min above max" : ": is beyond 1e30"));
  }
  return boxes;
}

}  // namespace

int size_from(const Fields& fields, std::string_view key) {
  const int size = fields.integer(key);
  if (size < 1 || size > kLargestMap) fields.refuse(key, "must lie in 1..65536");
  return size;
}

void read_depth_picture(const Fields& frame, const Camera& camera, CapturedScene& scene) {
  if (!frame.has("depth_picture")) return;
  if (frame.has("points")) frame.refuse("depth_picture", "stands beside points: one of both");
  const Fields fields(frame.at("depth_picture"), frame.path_of("depth_picture"),
                      {"width", "height", "depths"});
  DepthPicture picture;
  picture.width = size_from(fields, "width");
  picture.height = size_from(fields, "height");
  picture.depths = fields.numbers("depths");
  const std::size_t pixels =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (pixels > kMostPoints) fields.refuse("depths", "must be at most 100000 pixels");
  if (picture.depths.size() != pixels)
    fields.refuse("depths", "needs " + std::to_string(pixels) + " numbers, has " +
                                std::to_string(picture.depths.size()));
  bool shows_any = false, sees_any = false;
  for (std::size_t i = 0; i < picture.depths.size(); ++i) {
    const double depth = picture.depths[i];
    if (!(depth >= 0.0))
      throw CaseError(element_path(fields.path_of("depths"), i) +
                      ": must be a depth in front of the camera, or 0 where nothing is");
    shows_any |= depth > 0.0;
    sees_any |= depth >= camera.near_depth && depth <= camera.far_depth;
  }
  if (shows_any && !sees_any) fields.refuse("depths", "none lies between the camera's planes");
  add_points(picture, camera, scene);
}

CapturedScene scene_of(const Fields& fields) {
  CapturedScene scene;
  scene.receivers = boxes_of(fields, "receivers");
  scene.casters = boxes_of(fields, "casters");
  if (fields.has("points")) read_points(fields, scene);
  return scene;
}

}  // namespace gnomon::judge
