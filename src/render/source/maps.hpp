// Shadows from the maps of one light's plan: depths that filters read, or identifiers.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "filter/stored_maps.hpp"
#include "maps/map_pass.hpp"
#include "maps/silhouettes.hpp"
#include "source/frame_source.hpp"
#include "source/identifier_pass.hpp"

namespace gnomon::render {

class MapSource final : public FrameSource {
 public:
  MapSource(CasterScene& casters, CasterPass& pass, MapTargets& maps, Screen& screen);

  static const SourceSupport kSupport, kBentSupport, kIdentifierSupport;

  /// Makes what the filter's maps hold beside their depths. Throws RenderError.
  void prepare(const FilterSettings& settings);
  /// Makes what identifiers need, once. Throws RenderError.
  void prepare_identifiers();

  [[nodiscard]] FrameOptionSet supports(const FrameJob& frame) const noexcept override;
  [[nodiscard]] SourceSteps steps(const FrameJob& frame) const noexcept override;
  void begin(FrameJob& frame) override;
  void update(FrameJob& frame) override;
  [[nodiscard]] SurfacePass surfaces() const noexcept override;
  void store(FrameJob& frame) override;
  void mask(FrameJob& frame, GLuint fbo) override;
  void tint(FrameJob& frame) override;
  void count(FrameJob& frame) override;
  void lose() noexcept override;

  [[nodiscard]] int map_count() const noexcept { return map_count_; }  ///< of the last frame
  [[nodiscard]] glm::ivec2 size(int map) const noexcept { return map_size_[static_cast<std::size_t>(map)]; }
  /// Whether the last frame's depths are even along the light.
  [[nodiscard]] bool linear() const noexcept { return kind_.linear; }
  /// Reads the depths of the last frame's map, row by row.
  void read_depths(int map, std::span<float> depths) const noexcept;

 private:
  /// What the filter chose for each map from its depths, and what it was told when it did.
  struct Adapted {
    struct Map {
      bool valid = false;
      FilterSettings told, own;
    };
    std::array<Map, kMaxMaps> map;
    int maps_read_back = 0;  ///< in the last frame
  };

  /// Whether the frame's shadows are found by identifiers.
  [[nodiscard]] bool numbers(const FrameJob& frame) const noexcept;
  void fit(const ShadowPlan& plan);
  /// Makes room for what maps hold beside their depths. Maps drawn without it are not kept.
  void fit_beside(FrameJob& frame);
  void draw_identified(const FrameJob& frame) noexcept;
  /// For maps whose depths are not those of the last frame; the others keep what was chosen then.
  void adapt(FrameJob& frame);
  /// Whether a pass over the pixels costs less than what it saves.
  [[nodiscard]] bool pays_to_mark(const FrameJob& frame) const noexcept;

  CasterScene& casters_;
  CasterPass& pass_;
  MapTargets& maps_;
  Screen& screen_;
  MapPass map_pass_;
  StoredMaps stored_;
  Adapted adapted_;
  std::optional<Silhouettes> silhouettes_;     ///< made when a filter that reads them is first prepared
  std::optional<IdentifierPass> identifiers_;  ///< made when they are first prepared
  DrawnMaps drawn_;                            ///< of the last frame
  std::array<glm::ivec2, kMaxMaps> map_size_{};
  int map_count_ = 0;
  // What the maps hold.
  DepthKind kind_;
  bool has_silhouettes_ = false;
  std::optional<IdentifierOf> numbered_;
};

}  // namespace gnomon::render
