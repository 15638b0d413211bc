// A map's rectangle turned to the least area.
#include "map/turned.hpp"

#include <array>

#include "geometry/least_rectangle.hpp"
#include "map/gain.hpp"
#include "warp/plane_error.hpp"

namespace gnomon {

WarpChoice turned_to_least_area(const WarpInput& in, const WarpChoice& choice) noexcept {
  const PlaneMap map = plane_map(in.body, choice);
  std::array<glm::dvec2, kMaxBodyPoints> image;
  std::size_t count = 0;
  for (const WarpInput::Point& p : in.body) image[count++] = map.image(p.x, p.y);
  const glm::dvec2 side = least_rectangle_side({image.data(), count});
  WarpChoice turned = choice;
  turned.row_a = side;
  turned.row_b = {-side.y, side.x};
  // What the warp has measured is of its own rectangle.
  turned.gain_ratio = turned.last_ratio = 0.0;
  // Without perspective the area is the objective.
  if (in.flat()) return turned;
  PlaneError error(in);
  return error.value(turned) < error.value(choice) * (1.0 - kLeastWarpGain) ? turned : choice;
}

}  // namespace gnomon
