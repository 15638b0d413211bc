// Which surfaces does a picture of view depths show?
#pragma once

#include <vector>

#include "gnomon/camera.hpp"
#include "judge/capture.hpp"

namespace gnomon::judge {

/// View depths of an image, row by row from its upper left corner, world units. What is not above 0, or no
/// number, shows nothing.
struct DepthPicture {
  int width = 0, height = 0;  ///< of the picture: it need not have the camera's pixels
  std::vector<double> depths;
};

/// Points of the surfaces with their normals. A pixel is left out where no neighbour shows the same surface.
void add_points(const DepthPicture& picture, const Camera& camera, CapturedScene& scene);

}  // namespace gnomon::judge
