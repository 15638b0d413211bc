// The pages of one frame: planned for what its surfaces show, drawn, and planned again where the policy reads
// what was drawn.
#pragma once

#include <memory>
#include <vector>

#include "gnomon/light.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/render/renderer.hpp"
#include "visible_surfaces.hpp"

namespace gnomon::tool {

/// Input of a page plan besides the surfaces; the boxes of `bounds` must outlive the pages.
struct PageFrameInput {
  Light light;
  SceneBounds bounds;
  PageOptions pages;  ///< its plan with the border of the filter
};

class FramePages {
 public:
  /// Rounds after which a policy that reads the last frame stops: `queried` refines by an octave in each.
  static constexpr int kMaxRounds = 8;

  /// Plans once, with nothing rendered yet.
  FramePages(const PageFrameInput& input, std::shared_ptr<const VisibleSurfaces> surfaces);
  FramePages(const FramePages&) = delete;
  FramePages& operator=(const FramePages&) = delete;

  /// Plans once more from the same input, for a stopwatch.
  void again();
  /// Where the policy reads the mask: draws and plans until the pages stay the same, at most `rounds` times.
  /// Returns the time of Pass::shadow_maps, milliseconds; 0 where `options` times no passes.
  double refine(render::Renderer& renderer, const render::PreparedFilter& filter,
                const render::FrameOptions& options, int rounds = kMaxRounds);
  /// False: another round of refine() would change nothing, or the policy reads no mask.
  [[nodiscard]] bool wants_rounds() const noexcept { return wants_rounds_; }
  /// Draws the pages. FrameStats::pages_drawn counts those that the rounds of refine() drew as well.
  render::FrameStats draw(render::Renderer& renderer, const Camera& camera,
                          const render::PreparedFilter& filter, const render::FrameOptions& options);
  /// Counts matrices from another eye; the pages stay where they are in the world.
  void rebase_to(const glm::dvec3& origin_world);

  [[nodiscard]] const PagePlan& plan() const noexcept { return now_->plan; }
  [[nodiscard]] const VisibleSurfaces& surfaces() const noexcept { return *surfaces_; }
  /// By page of the plan: drawn in this frame, not kept from earlier ones. Empty before draw().
  [[nodiscard]] const std::vector<bool>& drawn() const noexcept { return drawn_; }
  /// Time of the last plan_pages, milliseconds.
  [[nodiscard]] double plan_ms() const noexcept { return plan_ms_; }
  /// At the visible points, on their surfaces where normals were read.
  [[nodiscard]] PageStats measure() const noexcept;
  /// The grid whose texels serve a page; nullptr where there is no such page.
  [[nodiscard]] const ShadowMap* level_of(int page) const noexcept;

 private:
  struct Planned {
    std::vector<std::byte> memory;
    PagePlan plan;
    std::vector<ShadowMap> levels;  ///< those of the plan, once they are rebased
  };
  void plan_into(Planned& planned, const PagePlan* last);
  void note_drawn(const render::Renderer& renderer);

  PageFrameInput input_;
  std::shared_ptr<const VisibleSurfaces> surfaces_;
  std::unique_ptr<Planned> now_, last_;
  std::vector<std::uint8_t> feedback_;
  std::vector<glm::dmat4> drawn_before_;  ///< of the pages that rounds have drawn
  std::vector<bool> drawn_;
  double plan_ms_ = 0.0;
  bool wants_rounds_ = false;
};

}  // namespace gnomon::tool
