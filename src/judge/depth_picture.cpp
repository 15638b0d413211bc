// Which surfaces does a picture of view depths show?
#include "judge/depth_picture.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "judge/seen.hpp"

namespace gnomon::judge {
namespace {

class Surfaces {
 public:
  Surfaces(const DepthPicture& picture, const Camera& camera)
      : picture_(picture), camera_(camera), axes_(camera_axes(camera)) {}

  /// Not above 0: nothing is there.
  [[nodiscard]] double depth(int column, int row) const {
    if (column < 0 || row < 0 || column >= picture_.width || row >= picture_.height) return 0.0;
    const double depth =
        picture_.depths[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.width) +
                        static_cast<std::size_t>(column)];
    return std::isfinite(depth) && depth >= camera_.near_depth && depth <= camera_.far_depth ? depth : 0.0;
  }

  [[nodiscard]] glm::dvec3 point(int column, int row) const {
    const EyeRay ray =
        eye_ray(camera_, axes_, (column + 0.5) / picture_.width, (row + 0.5) / picture_.height);
    return ray.origin + ray.way * depth(column, row);
  }

  /// To the neighbour on either side that is nearer in depth; zero where neither shows the same surface.
  [[nodiscard]] glm::dvec3 along(int column, int row, int right, int down) const {
    const double here = depth(column, row);
    double least = kMostJump * here;
    glm::dvec3 way(0.0);
    for (const int side : {1, -1}) {
      const int c = column + side * right, r = row + side * down;
      const double there = depth(c, r);
      if (!(there > 0.0) || !(std::abs(there - here) < least)) continue;
      least = std::abs(there - here);
      way = static_cast<double>(side) * (point(c, r) - point(column, row));
    }
    return way;
  }

 private:
  static constexpr double kMostJump = 0.5;  // of the depth
  const DepthPicture& picture_;
  const Camera& camera_;
  CameraAxes axes_;
};

}  // namespace

void add_points(const DepthPicture& picture, const Camera& camera, CapturedScene& scene) {
  const Surfaces surfaces(picture, camera);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      if (!(surfaces.depth(column, row) > 0.0)) continue;
      const glm::dvec3 normal =
          glm::cross(surfaces.along(column, row, 0, 1), surfaces.along(column, row, 1, 0));
      if (!(glm::length(normal) > 0.0)) continue;
      scene.points.push_back(surfaces.point(column, row));
      scene.normals.push_back(glm::normalize(normal));
    }
  }
}

}  // namespace gnomon::judge
