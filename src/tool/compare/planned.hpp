// What a technique plans for one camera, maps or pages, ready to be drawn, timed and looked into.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "frame_pages.hpp"
#include "gnomon/study/expected_error.hpp"
#include "stage.hpp"

namespace gnomon::tool {

class Planned {
 public:
  /// Plans until what the renderer reports of it changes nothing: page policies may read the mask of a frame
  /// before. The stage must have looked through the camera.
  Planned(Stage& stage, const SweepEntry& entry, const Camera& camera);
  /// Plans once more from the same input, for a stopwatch.
  void again();
  /// As a renderer may draw it with another camera: the same texels over the same parts of the world.
  void move_eye(const Camera& after);
  /// With the entry's depth layer.
  render::FrameStats draw(const Camera& camera, render::FrameOptions options);

  [[nodiscard]] PlanStatus status() const noexcept;
  [[nodiscard]] std::string_view invalid_field() const noexcept;
  [[nodiscard]] std::span<const Omission> omitted() const noexcept;
  /// The texels that the mask's channel "map" names; nullptr: none.
  [[nodiscard]] const ShadowMap* map(int index) const noexcept;
  /// Maps or pages.
  [[nodiscard]] int map_count() const noexcept;
  /// The error m of each pixel of the last frame drawn, 0 where there is none: sky, turned from the light.
  [[nodiscard]] std::vector<float> aliasing(const FloatImage& mask) const;
  /// What the maps or pages will make of a shadow.
  [[nodiscard]] ExpectedError expected(const ShadowPicture& shadow) const noexcept;
  /// The error m as colours.
  [[nodiscard]] Image heat_map(const FloatImage& mask) const;
  /// Bytes of the tables that the look-up reads besides texels; 0 for maps.
  [[nodiscard]] std::uint64_t table_bytes() const noexcept;

 private:
  [[nodiscard]] bool by_pages() const noexcept { return entry_.by_pages(); }

  Stage& stage_;
  const SweepEntry& entry_;
  Camera camera_;
  ShadowPlan maps_;
  std::unique_ptr<FramePages> pages_;
};

}  // namespace gnomon::tool
