// One scene made ready to be measured: on the GPU, for rays, and with its cameras.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "exact_results.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/coarse_view.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/trace/reference.hpp"
#include "scene_view.hpp"
#include "sweep.hpp"
#include "texel_shares.hpp"
#include "visible_surfaces.hpp"

namespace gnomon::tool {

class Stage {
 public:
  /// Throws SceneError, RenderError, TraceError, and std::runtime_error where the scene has no such
  /// animation.
  Stage(const Sweep& sweep, const std::string& scene, ExactResults exact = {});

  /// One frame of a sweep, and what a viewer at 60 Hz saw before it.
  enum class At : std::uint8_t { before, frame };
  /// Poses the scene as it stands then, for draws and plans. Nothing where it plays no animation.
  void go_to(int frame, At at);
  /// Poses the scene as that viewer saw it so many of his frames before the sweep's.
  void pose_before(int frame, int viewer_frames);
  /// Rays see the scene as posed last.
  void retrace();
  [[nodiscard]] bool plays() const noexcept { return animation_ != kRestPose; }

  /// With what `camera` shows, where the entry asks for it: see() must have been called for it.
  [[nodiscard]] ShadowPlan plan(const SweepEntry& entry, const Camera& camera) const;
  /// Draws what both cameras of a frame show, for plans that are given it. Forgets earlier frames. The scene
  /// is left as it stands in the frame.
  void see(int frame);
  /// Time within the animation of a frame's pose; 0 where none plays.
  [[nodiscard]] double animation_seconds(int frame) const noexcept;
  [[nodiscard]] Camera camera(int frame) const noexcept;
  [[nodiscard]] Camera camera_before(int frame) const noexcept;
  [[nodiscard]] const Light& light() const noexcept { return view_.light(); }
  /// Results of rays that the disk may have already.
  [[nodiscard]] const ExactResults& exact() const noexcept { return exact_; }
  [[nodiscard]] const trace::Tracer& tracer() const noexcept { return *tracer_; }
  [[nodiscard]] render::Renderer& renderer() noexcept { return *renderer_; }
  [[nodiscard]] render::PreparedFilter filter(const SweepEntry& entry) {
    using render::Source;
    if (entry.irregular())
      return renderer_->prepare(render::filters::hard, Source::irregular(entry.irregular_samples));
    if (entry.identifiers)
      return renderer_->prepare(render::filters::hard, Source::identifiers(*entry.identifiers));
    return renderer_->prepare(entry.filter, entry.by_pages() ? Source::pages : Source::maps);
  }
  [[nodiscard]] SceneBounds bounds() const noexcept { return view_.bounds(); }

  /// What a camera shows.
  struct View {
    At at = At::frame;
    Camera camera;
    VisibleDepths depths;
    std::vector<glm::dvec3> points, normals;
    std::vector<glm::dvec3> edges;  ///< of the shadow of the frame before, where an entry takes them
    std::shared_ptr<const VisibleSurfaces> surfaces;  ///< what pages are planned from
  };
  /// nullptr where nobody looked through the camera.
  [[nodiscard]] const View* view(const Camera& camera) const noexcept;
  [[nodiscard]] const Scene& scene() const noexcept { return view_.scene(); }

 private:
  /// Which of the capture's frames it is.
  [[nodiscard]] std::size_t captured_frame(int frame) const noexcept;
  [[nodiscard]] View view_through(const Camera& camera);
  /// Edges of the shadow of the default plan, as a renderer finds them in the mask of a frame, and as many
  /// other points of the view.
  [[nodiscard]] std::vector<glm::dvec3> edges_of(const View& view);

  const Sweep& sweep_;
  ExactResults exact_;
  mutable CoarseView coarse_;  ///< scratch
  TexelShares shares_;         ///< of many lights
  std::vector<View> views_;
  SceneView view_;
  At at_ = At::frame;
  int animation_ = kRestPose;
  Scene at_rest_;  ///< empty where no animation plays
  Pose pose_;
  std::unique_ptr<trace::Tracer> tracer_;
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace gnomon::tool
