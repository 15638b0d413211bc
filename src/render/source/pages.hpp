// Shadows from the pages of one light's plan, which a pool keeps from frame to frame.
#pragma once

#include "filter/stored_pages.hpp"
#include "source/frame_source.hpp"
#include "source/page_pool.hpp"
#include "source/page_runs.hpp"

namespace gnomon::render {

class PageSource final : public FrameSource {
 public:
  PageSource(CasterScene& casters, CasterPass& pass, MapTargets& maps, Screen& screen);

  static const SourceSupport kSupport;

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

  [[nodiscard]] const PagePool& pool() const noexcept { return pool_; }

 private:
  /// Runs [first, last) of the pool, each into a layer of the stage, and from there into the pool.
  void draw_runs(std::size_t first, std::size_t last, const DepthDraw& how) noexcept;
  /// Each page by itself, into its slot: what lies behind its first surface is found there. `of_light`: says
  /// how the light's depths run.
  void draw_each(const ShadowPlan& of_light, const DepthDraw& how) noexcept;

  CasterScene& casters_;
  CasterPass& pass_;
  MapTargets& maps_;
  Screen& screen_;
  PagePool pool_;
  PageStage stage_;
  StoredPages stored_;
  DepthKind kind_;                ///< that the pool holds
  glm::dvec3 origin_world_{0.0};  ///< that casters of the last frame were drawn from
};

}  // namespace gnomon::render
