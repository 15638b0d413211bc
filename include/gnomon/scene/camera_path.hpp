// A camera flight: keys in time, a smooth curve between them.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon {

/// One key of a camera path.
struct CameraKey {
  glm::dvec3 position{0.0};           ///< eye, world space
  glm::dvec3 target{0.0, 0.0, -1.0};  ///< the point looked at, not equal to position
  /// Points to the top of the picture, any length but zero. Along the view, north (-Z) or +Z stands in.
  glm::dvec3 up{0.0, 1.0, 0.0};
};

/// The key of a camera with these unit axes. Its `up` stays +Y where that shows the same picture.
[[nodiscard]] CameraKey camera_key(const glm::dvec3& position, const glm::dvec3& forward,
                                   const glm::dvec3& up) noexcept;

/// Catmull-Rom through `keys` (centripetal, so no loops or cusps between them), in the unit interval of time.
/// One key is a still camera. `closed` joins the last key to the first.
struct CameraPath {
  std::vector<CameraKey> keys;                ///< at least one
  bool closed = false;                        ///< the last key leads back to the first
  double fov_y_radians = 1.0471975511965976;  ///< 60 degrees
  /// World units from the bottom of the image to its top; above 0 the camera is orthographic, and
  /// fov_y_radians does not count.
  double height_world = 0.0;
  double near_depth = 0.1;   ///< near plane, world units, above 0
  double far_depth = 100.0;  ///< far plane, world units
  /// The camera at time `t` in [0,1] (clamped), for an image of this size.
  [[nodiscard]] Camera at(double t, int width, int height) const noexcept;
};

/// Reads
/// {"keys":[{"position":[x,y,z],"target":[x,y,z]},...],"closed":false,"fov_y_deg":60,"near":0.1,"far":100},
/// with "height_world" in place of "fov_y_deg" for an orthographic camera. A key may have "up":[x,y,z].
/// Unknown keys are an error. Throws SceneError with file and key.
[[nodiscard]] CameraPath load_camera_path(const std::filesystem::path& file);
/// Writes the same format.
void save_camera_path(const CameraPath& path, const std::filesystem::path& file);

/// Where sight begins and ends, world units.
struct Sight {
  double near_depth = 0.1, far_depth = 100.0;  ///< view depths, 0 < near_depth < far_depth
};
/// For an eye that stands anywhere in or before a scene. Sight begins half way to the nearest box that does
/// not hold the eye. Where another box holds it, sight begins at most at 1e-4 of where it ends. It never
/// begins below 1e-6 of that. It ends beyond the farthest corner. Both are powers of two, so that they seldom
/// change while the eye moves. The default where all boxes are empty.
[[nodiscard]] Sight sight_from(const glm::dvec3& eye, std::span<const Box> boxes) noexcept;

/// Moves the keys of an orthographic path along their views, and its near and far plane, so that all boxes
/// lie between these. Does nothing where all boxes are empty.
void see_all(CameraPath& path, std::span<const Box> boxes) noexcept;

/// The default flight of a builtin scene, by its name. Any other scene has an orbit that shows all that it is
/// about, as near as an image of this width over height allows. The default holds it in a square image and
/// in wider ones. Its middle is near the front (+Z), 25 degrees up. It is higher where what lies flat would
/// fill less than three tenths of the image, or where hills hide it.
/// Skies, grounds, backdrops and strays do not count (docs/viewer.md#default-views). A room is flown
/// through from inside.
[[nodiscard]] CameraPath default_path(const Scene& scene, double aspect = 1.0);

}  // namespace gnomon
