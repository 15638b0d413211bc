// One scene under the sun, drawn with any filter: what `gnomon filters` measures and shows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/image.hpp"

namespace gnomon::tool {

/// A small frame: maps are to dominate.
inline constexpr int kStageWidth = 480, kStageHeight = 270;
/// The place of the sun over a scene, degrees.
inline constexpr double kStageElevationDeg = 38.0, kStageAzimuthDeg = 140.0;

class FilterStage {
 public:
  /// `azimuth_deg`: where the sun stands, 0 over -Z, 90 over +X. Throws RenderError.
  FilterStage(Scene scene, double elevation_deg, double azimuth_deg);
  /// A scene by its name, with the sun over it. Throws SceneError and RenderError.
  explicit FilterStage(const std::string& scene);

  /// One map along the view, without a warp: filters are compared, not plans. Throws RenderError.
  render::FrameStats draw(const render::FilterSettings& filter, const Camera& camera, int map_size);
  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  /// Of the last draw().
  [[nodiscard]] const ShadowPlan& plan() const noexcept { return plan_; }
  [[nodiscard]] const render::Renderer& renderer() const noexcept { return renderer_; }
  /// Share of light per pixel of the last draw(); -1 where no map serves the pixel.
  [[nodiscard]] std::vector<float> visibility() const;

 private:
  Scene scene_;
  std::vector<Box> boxes_;
  Light sun_;
  render::Renderer renderer_;
  ShadowPlan plan_;
};

/// The settings of a text that is known to be right. Throws std::runtime_error where it is not.
[[nodiscard]] render::FilterSettings filter_from(std::string_view text);

/// A box and a leaning board on the ground: a contact, and a slanted plane that shadows and is shadowed. With
/// `bars`, a fence stands on the sun's side, and its shadow falls over the others'.
[[nodiscard]] Scene contact_scene(bool bars);
[[nodiscard]] Camera contact_camera(int width, int height) noexcept;
/// Bars high over a long ground, across the view: stripes of shadow without a contact, thinner the farther
/// off.
[[nodiscard]] Scene grating_scene();
/// Looks under the bars along the ground, from `distance` times as far off.
[[nodiscard]] Camera grating_camera(double distance, int width, int height) noexcept;

}  // namespace gnomon::tool
