// The pages of one frame: planned for what its surfaces show, drawn, and planned again where the policy reads
// what was drawn.
#include "frame_pages.hpp"

#include <algorithm>
#include <chrono>

#include "float_channel.hpp"
#include "gnomon/motion.hpp"

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
    const std::size_t points = std::max<std::size_t>(surfaces_->points.size(), 1);
    return std::make_unique<Planned>(
        Planned{std::vector<std::byte>(page_memory(input.pages.capacity, points)), {}, {}});
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
  const gnomon::View view{.camera = surfaces_->camera, .points_world = surfaces_->points};
  const PageHistory history{last, feedback_};
  const auto begin = Clock::now();
  planned.plan = plan_pages(view, input_.light, input_.bounds, input_.pages, planned.memory, &history);
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

void FramePages::rebase_to(const glm::dvec3& origin_world) {
  std::vector<ShadowMap> levels;
  for (const ShadowMap& level : now_->plan.levels) levels.push_back(rebased(level, origin_world));
  now_->levels = std::move(levels);
  now_->plan.levels = now_->levels;
  now_->plan.origin_world = origin_world;
}

PageStats FramePages::measure() const noexcept {
  const gnomon::View view{
      .camera = surfaces_->camera, .points_world = surfaces_->points, .normals_world = surfaces_->normals};
  return gnomon::measure(now_->plan, view, input_.bounds);
}

const ShadowMap* FramePages::level_of(int page) const noexcept {
  if (page < 0 || static_cast<std::size_t>(page) >= now_->plan.pages.size()) return nullptr;
  return &now_->plan.levels[now_->plan.pages[static_cast<std::size_t>(page)].level];
}

}  // namespace gnomon::tool
