// The aliasing error m of each pixel of a frame with pages, as numbers and as colours.
#pragma once

#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/scene/image.hpp"

namespace gnomon::tool {

/// Images of a frame that was drawn with the pages of a plan.
struct PageFrameImages {
  FloatImage mask, positions, normals;
};

/// m of each pixel; 0 where there is none: sky, turned from the light, no page. Runs on all cores.
[[nodiscard]] std::vector<float> page_aliasing(const PagePlan& plan, const Camera& camera,
                                               const PageFrameImages& images);
/// The same as colours, with the little light and shadow that Renderer::heat_map() has.
[[nodiscard]] Image page_heat_map(const PagePlan& plan, const std::vector<float>& m,
                                  const PageFrameImages& images);

}  // namespace gnomon::tool
