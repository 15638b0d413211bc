// One scene made ready to be measured: on the GPU, for rays, and with its cameras.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "gnomon/trace/reference.hpp"
#include "scene_view.hpp"
#include "seen_surfaces.hpp"
#include "sweep.hpp"

namespace gnomon::tool {

class Stage {
 public:
  /// Throws SceneError, RenderError, TraceError.
  Stage(const Sweep& sweep, const std::string& scene);

  /// With what `camera` shows, where the entry asks for it: see() must have been called for it.
  [[nodiscard]] ShadowPlan plan(const SweepEntry& entry, const Camera& camera) const noexcept;
  /// Draws what both cameras of a frame show, for plans that are given it. Forgets earlier frames.
  void see(const Camera& camera, const Camera& before);
  [[nodiscard]] Camera camera(int frame) const noexcept;
  [[nodiscard]] Camera camera_before(int frame) const noexcept;
  [[nodiscard]] const Light& light() const noexcept { return view_.light(); }
  [[nodiscard]] const trace::Tracer& tracer() const noexcept { return *tracer_; }
  [[nodiscard]] render::Renderer& renderer() noexcept { return *renderer_; }
  [[nodiscard]] render::PreparedFilter filter(const SweepEntry& entry) {
    if (entry.irregular()) return renderer_->prepare_irregular(entry.irregular_samples);
    if (entry.identifiers) return renderer_->prepare_identifiers(*entry.identifiers);
    return entry.by_pages() ? renderer_->prepare_pages(entry.filter) : renderer_->prepare(entry.filter);
  }
  [[nodiscard]] SceneBounds bounds() const noexcept { return view_.bounds(); }

  /// What a camera shows.
  struct View {
    Camera camera;
    VisibleDepths depths;
    std::vector<glm::dvec3> points;
    std::shared_ptr<const SeenSurfaces> surfaces;  ///< what pages are planned from
  };
  /// nullptr where the camera was not seen.
  [[nodiscard]] const View* view(const Camera& camera) const noexcept;
  [[nodiscard]] const Scene& scene() const noexcept { return view_.scene(); }

 private:
  [[nodiscard]] View seen_by(const Camera& camera);

  const Sweep& sweep_;
  std::vector<View> views_;
  SceneView view_;
  std::unique_ptr<trace::Tracer> tracer_;
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace gnomon::tool
