// What does drawing each of a scene's instances take?
#pragma once

#include <vector>

#include "gnomon/scene/scene.hpp"
#include "gnomon/study/technique.hpp"

namespace gnomon {

/// In the order of Scene::instances, for choose_technique.
[[nodiscard]] std::vector<CasterWork> caster_work(const Scene& scene);

}  // namespace gnomon
