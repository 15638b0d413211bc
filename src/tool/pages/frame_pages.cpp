// The pages of one frame: planned for what its surfaces show, drawn, and planned again where the policy reads
// what was drawn.
#include "frame_pages.hpp"

#include <algorithm>
#include <chrono>

#include "float_channel.hpp"
#include "gnomon/reuse.hpp"

namespace gnomon::tool {
namespace {

bool same_pages(const PagePlan& a, const PagePlan& b) {
  return a.levels.size() == b.levels.size() && std::equal(a.pages.begin(), a.pages.end(), b.pages.begin(),
                                                          b.pages.end(), [](const Page& p, const Page& q) {
                                                            return p.level == q.level &&
                                                                   p.column == q.column && p.row == q.row;
                                                          });
}

}  // namespace

FramePages::FramePages(const PageFrameInput& input, std::shared_ptr<const VisibleSurfaces> surfaces)
    : input_(input), surfaces_(std::move(surfaces)) {
  const auto storage = [&] {
    return std::make_unique<Planned>(Planned{PageStorage(std::clamp(input.pages.capacity, 0, kMostPages),
                                                         std::max<std::size_t>(surfaces_->points.size(), 1)),
                                             {}});
  };
  now_ = storage();
  feedback_ = first_feedback(*surfaces_, *input.pages.policy);
  plan_into(*now_, nullptr);
  wants_rounds_ = (input.pages.policy->feedback & (kShadowEdge | kShadowChanged)) != 0 &&
                  now_->plan.status == PlanStatus::ok;
  if (wants_rounds_) last_ = storage();
}

void FramePages::plan_into(Planned& planned, const PagePlan* last) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  planned.plan =
      plan_pages(surfaces_->camera, input_.light, input_.bounds, {surfaces_->points, {}, feedback_, last},
                 input_.plan, input_.pages, planned.storage.spans());
  plan_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

void FramePages::again() {
  plan_into(*now_, last_ ? &last_->plan : nullptr);
}

double FramePages::refine(render::Renderer& renderer, const render::PreparedFilter& filter,
                          const render::FrameOptions& options, int rounds) {
  double map_ms = 0.0;
  std::vector<float> before;
  for (int round = 0; round < rounds && wants_rounds_ && now_->plan.status == PlanStatus::ok; ++round) {
    const render::FrameStats stats = draw(renderer, surfaces_->camera, filter, options);
    map_ms += stats.ms(render::Pass::shadow_maps);
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      if (drawn_[i]) drawn_before_.push_back(page_map(now_->plan, now_->plan.pages[i]).clip_from_world);
    }
    std::vector<float> lit = channel(renderer.mask(), 0);
    feedback_ = feedback_of(*surfaces_, lit, before);
    before = std::move(lit);
    std::swap(now_, last_);
    plan_into(*now_, &last_->plan);
    wants_rounds_ = !same_pages(now_->plan, last_->plan);
  }
  return map_ms;
}

render::FrameStats FramePages::draw(render::Renderer& renderer, const Camera& camera,
                                    const render::PreparedFilter& filter,
                                    const render::FrameOptions& options) {
  render::FrameStats stats = renderer.draw(now_->plan, camera, filter, options);
  note_drawn(renderer);
  stats.pages_drawn = static_cast<int>(std::count(drawn_.begin(), drawn_.end(), true));
  return stats;
}

void FramePages::note_drawn(const render::Renderer& renderer) {
  const PagePlan& plan = now_->plan;
  drawn_.assign(plan.pages.size(), false);
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    drawn_[i] = renderer.drew_page(i);
    if (drawn_[i] || drawn_before_.empty()) continue;
    const glm::dmat4 matrix = page_map(plan, plan.pages[i]).clip_from_world;
    drawn_[i] = std::find(drawn_before_.begin(), drawn_before_.end(), matrix) != drawn_before_.end();
  }
}

void FramePages::rebase_to(const glm::dvec3& origin_world) noexcept {
  for (ShadowMap& level : std::span(now_->storage.levels).first(now_->plan.levels.size()))
    level = rebased(level, origin_world);
  now_->plan.origin_world = origin_world;
}

PageStats FramePages::measure() const noexcept {
  return measure_pages(now_->plan, surfaces_->camera, {surfaces_->points, surfaces_->normals, {}, nullptr});
}

const ShadowMap* FramePages::level_of(int page) const noexcept {
  if (page < 0 || static_cast<std::size_t>(page) >= now_->plan.pages.size()) return nullptr;
  return &now_->plan.levels[now_->plan.pages[static_cast<std::size_t>(page)].level];
}

}  // namespace gnomon::tool
