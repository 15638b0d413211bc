// Does any text, taken for a camera flight, become cameras of finite numbers or a refusal of one line?
#include <cmath>

#include "fuzz.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "load_memory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using gnomon::fuzz::require;
  try {
    const gnomon::CameraPath path =
        gnomon::detail::camera_path_from_text(gnomon::fuzz::as_text(data, size), "fuzz");
    require(!path.keys.empty(), "a flight has a key");
    for (const double t : {0.0, 0.3, 0.5, 0.99, 1.0}) {
      const gnomon::Camera camera = path.at(t, 640, 360);
      for (int c = 0; c < 3; ++c) {
        require(std::isfinite(camera.position[c]) && std::isfinite(camera.forward[c]), "finite cameras");
      }
      require(camera.near_depth > 0.0 && camera.far_depth > camera.near_depth, "near below far");
      require(camera.left < camera.right && camera.bottom < camera.top, "a view that is not empty");
    }
  } catch (const gnomon::SceneError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
