// Loads a scene for the viewer, on any thread.
#include "loaded.hpp"

#include "edit_words.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/scene/translucent.hpp"

namespace gnomon::tool::view {

std::shared_ptr<const Loaded> load(const std::string& scene, std::uint64_t max_triangles, bool panes,
                                   const SceneEdits& edits) {
  auto loaded = std::make_shared<Loaded>();
  loaded->name = scene;
  loaded->scene = load_edited(scene, limits_of_triangles(max_triangles), edits);
  loaded->edits = edits;
  loaded->grounded = has_ground(loaded->scene);
  loaded->shaded_by_sky = has_sky_that_casts(loaded->scene);
  constexpr double kUsualAspect = 16.0 / 9.0;
  loaded->path = default_path(loaded->scene, kUsualAspect);
  loaded->parted = panes;
  if (panes) {
    TranslucentParts parts = split_translucent(loaded->scene);
    loaded->scene = std::move(parts.opaque);
    loaded->panes = std::move(parts.panes);
  }
  loaded->boxes = ShadowBoxes(loaded->scene);
  loaded->boxes.add(loaded->panes);
  return loaded;
}

}  // namespace gnomon::tool::view
