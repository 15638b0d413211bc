// Which scene does the viewer show, before anything is drawn?
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/scene.hpp"
#include "gnomon/scene/shadow_boxes.hpp"

namespace gnomon::tool::view {

/// A scene as it was loaded; needs no context, so that any thread may load it.
struct Loaded {
  std::string name;  ///< as State::scene has it
  Scene scene;       ///< where `parted` without its panes
  Scene panes;
  bool parted = false;
  SceneEdits edits;            ///< that `scene` has had
  bool grounded = true;        ///< has_ground()
  bool shaded_by_sky = false;  ///< has_sky_that_casts()
  CameraPath path;
  ShadowBoxes boxes;  ///< of the instances at rest, and of panes behind them
};
/// `edits`: made first. `panes`: parts them from the scene, which then has no animations. Throws SceneError.
[[nodiscard]] std::shared_ptr<const Loaded> load(const std::string& scene, std::uint64_t max_triangles,
                                                 bool panes = false, const SceneEdits& edits = {});

}  // namespace gnomon::tool::view
