// The views that are painted on the CPU from what the renderer measured, and their legends.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "canvas.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/reference.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

/// Visibility as grey; the sky blue.
[[nodiscard]] Image mask_picture(const FloatImage& mask, const FloatImage& normals);
/// The mask's error over a pale exact shadow. `verdicts` may be of the picture's first rows only; the rest
/// stays pale.
[[nodiscard]] Image misclassified_picture(const FloatImage& mask, std::span<const trace::Verdict> verdicts,
                                          const FloatImage& normals);
/// The mask's errors at pixels that a ray decides; acne and leaks at those whose exact shadow is uniform for
/// three pixels round.
[[nodiscard]] report::MaskErrors errors_of(const FloatImage& mask, std::span<const trace::Verdict> verdicts);
/// The exact shadow as numbers: 1 lit, 0 in shadow, -1 where nothing is decided; `pixels` of them.
[[nodiscard]] std::vector<float> lit_of(std::span<const trace::Verdict> verdicts, std::size_t pixels);
/// Share of pixels whose visibility differs by more than half between two masks of one camera; a pixel that
/// only one of them serves does not count. Both have one size.
[[nodiscard]] double flips_between(const FloatImage& before, const FloatImage& after);
/// The exact shadow as mask_picture() paints one.
[[nodiscard]] Image truth_picture(int width, int height, std::span<const trace::Verdict> verdicts,
                                  const FloatImage& normals);
/// `lit`, with every other square of kCheckerTexels texels darkened. `mask`: for the map or page of each
/// pixel; `map_of`: the texels that an index of the mask names, or nullptr.
[[nodiscard]] Image checker_picture(const Image& lit, const FloatImage& mask, const FloatImage& positions,
                                    const std::function<const ShadowMap*(int)>& map_of, const Camera& camera);
/// Grey where equal; orange where A is lighter, blue where B is, `gain` times the difference.
[[nodiscard]] Image difference_picture(const Image& a, const Image& b, double gain);

/// A depth map as large as the picture allows, and what lies in it.
struct MapPicture {
  Image image;
  std::vector<ScreenLine> lines;
};
/// `camera`: the one that the plan was made for.
[[nodiscard]] MapPicture map_picture(const FloatImage& depths, const ShadowPlan& plan, int map,
                                     const Camera& camera, const Box& scene, const std::vector<Box>& boxes,
                                     int width, int height);

/// The legend of a view, for the lower left corner of a picture of this width; empty where there is none.
[[nodiscard]] Image legend(View view, const ShadowPlan& plan, int picture_width);
/// Colour fields with what they stand for, under a title.
[[nodiscard]] Image field_legend(const std::string& title,
                                 const std::vector<std::pair<render::Color, std::string>>& fields,
                                 int picture_width);
/// Text on a dark ground, for a corner of the picture.
[[nodiscard]] Image label(const std::string& text);

}  // namespace gnomon::tool::view
