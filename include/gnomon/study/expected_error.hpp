// How many pixels will a plan get wrong? Its texels are applied to a shadow that is known.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "gnomon/camera.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

/// Finds what lies between any point of space and the light, as a map finds it: by rays.
struct OccluderSearch {
  /// Distance along the light from the point to the occluder nearest the light, world units. Negative where
  /// that lies beyond the point, -infinity where there is none. nullptr: nothing is searched.
  double (*distance)(const void* scene, const glm::dvec3& point_world) noexcept = nullptr;
  const void* scene = nullptr;  ///< handed to `distance`; must outlive the search
};

/// A shadow as a camera sees it: of other maps, of the last frame, or of rays.
struct ShadowPicture {
  Camera camera;  ///< its width and height are those of both pictures
  /// 1 lit .. 0 in shadow, or negative where nothing counts, rows top to bottom. Columns go along
  /// cross(forward, up): those of a left-handed world from right to left.
  std::span<const float> mask;
  /// View depths of the surfaces. No surface: 0, below, infinite, not a number.
  std::span<const float> view_depths;
  /// For each dark pixel: distance along the light from the surface to the occluder nearest the light, world
  /// units. A map stores that occluder, and a bias longer than the distance lights the surface. Negative, not
  /// a number: not known there. Empty: not known at all.
  std::span<const float> occluder_distances = {};
  /// The surfaces' normals, unit, towards the viewer; zero where there is none. Empty: from view_depths. They
  /// are read beside `occluders` alone.
  std::span<const glm::vec3> normals_world = {};
  /// Searches what casts shadows in the picture's light. With it errors are those of the maps' own
  /// comparisons, also where the picture does not show the middle of a texel.
  OccluderSearch occluders = {};

  /// True where each span has the image's size, and there is a pixel. Distances and normals may be empty.
  [[nodiscard]] bool is_whole() const noexcept {
    const std::size_t count = mask.size();
    const bool alike = view_depths.size() == count &&
                       (occluder_distances.empty() || occluder_distances.size() == count) &&
                       (normals_world.empty() || normals_world.size() == count);
    if (camera.width < 1 || camera.height < 1) return false;
    const auto width = static_cast<std::size_t>(camera.width);
    return alike && count % width == 0 && count / width == static_cast<std::size_t>(camera.height);
  }
};

/// The errors that a plan will make.
struct ExpectedError {
  double wrong_pixels = 0.0;    ///< lit and dark pixels that are taken for each other
  double counted_pixels = 0.0;  ///< that have a surface, and are lit or dark
  /// wrong_pixels over counted_pixels, in [0,1]; 0 where none counts.
  [[nodiscard]] double share() const noexcept {
    return counted_pixels > 0.0 ? wrong_pixels / counted_pixels : 0.0;
  }
};

/// The widest half side of a box of texels that errors are expected for.
inline constexpr double kMaxKernelTexels = 33.0;

/// The pixels that comparisons in the plan's maps will misclassify, without drawing them: as hard comparison
/// of shaders/library/receiver.glsl has it, with the plan's bias. Nothing counts where a span has another
/// size than the image. Pure, allocates nothing.
///
/// With ShadowPicture::occluders each pixel is compared with what lies on the light's ray through the middle
/// of its texel, on the plane of its surface. Neighbours that read one texel search it once. Rounding by
/// the rasterizer is missed, and what filters do beyond averaging.
///
/// Without, each pixel takes the shadow that the picture shows where the middle of its texel meets the
/// surface. Light that the bias lets in counts where occluder_distances are known. Shadows narrower than a
/// pixel count less than they should: the picture should be as fine as the texels. Middles that another
/// surface hides are not known; what is known stands for them.
///
/// `kernel_texels`: half side of the box of texels whose comparisons a filter averages, as `pcf` does. 0, the
/// default, and what is no number stand for one texel, hard comparison. More than kMaxKernelTexels counts as
/// that. An average is wrong where it is on the other side of one half. A box whose corners and middle agree
/// counts as they do. A picture without occluders shows no edge between its pixels, and averages over less
/// than a pixel look too good. So they count by half, and one texel by the other half.
///
/// `every`: along each axis one of so many pixels is counted and stands for the others, 1: each. A picture as
/// fine as the texels then takes no longer than a coarse one. More than 4096 counts as that, and less than 1
/// as 1.
[[nodiscard]] ExpectedError expected_error(const ShadowPlan& plan, const ShadowPicture& shadow,
                                           double kernel_texels = 0.0, int every = 1) noexcept;
/// The same in the pages that serve the points of the picture. A point without a page is drawn as lit.
[[nodiscard]] ExpectedError expected_error(const PagePlan& plan, const ShadowPicture& shadow,
                                           double kernel_texels = 0.0, int every = 1) noexcept;

/// Points of the surfaces along the shadow's edges. A pixel is on an edge where one of its four neighbours
/// shows the same surface with another shadow. A plan for them (View::points_world) has its texels where they
/// show. Give such a plan visible points as well: maps reach no farther than its points. As many as `out`
/// has room for, evenly over the picture; returns how many.
[[nodiscard]] std::size_t shadow_edge_points(const ShadowPicture& shadow, std::span<glm::dvec3> out) noexcept;

}  // namespace gnomon
