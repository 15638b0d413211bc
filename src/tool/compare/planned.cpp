// What a technique plans for one camera, maps or pages, ready to be drawn, timed and looked into.
#include "planned.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/metric.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/reuse.hpp"
#include "picture_colors.hpp"
#include "seen_from.hpp"

namespace gnomon::tool {
namespace {

// Rounds after which a policy that reads the last frame stops: `queried` refines by an octave in each.
constexpr int kMostRounds = 8;
// A shadow edge: the mask differs by this from a pixel within reach of the next sparse point.
constexpr float kEdge = 0.25f;

std::vector<float> lit_of(const FloatImage& mask) {
  std::vector<float> lit;
  lit.reserve(mask.values.size() / 2);
  for (std::size_t i = 0; i < mask.values.size(); i += 2) lit.push_back(mask.values[i]);
  return lit;
}

bool same_pages(const PagePlan& a, const PagePlan& b) {
  return a.levels.size() == b.levels.size() && std::equal(a.pages.begin(), a.pages.end(), b.pages.begin(),
                                                          b.pages.end(), [](const Page& p, const Page& q) {
                                                            return p.level == q.level &&
                                                                   p.column == q.column && p.row == q.row;
                                                          });
}

/// Matrices relative to another eye; the pages stay where they are.
void rebase(PlannedPages& pages, const glm::dvec3& origin_world) noexcept {
  for (ShadowMap& level : std::span(pages.storage.levels).first(pages.plan.levels.size()))
    level = rebased(level, origin_world);
  pages.plan.origin_world = origin_world;
}

/// Least and largest value in the square round a pixel that ends half way to the next sparse point.
std::pair<float, float> range_round(const std::vector<float>& values, int width, int height, int pixel) {
  constexpr int kReach = Stage::kStride / 2 + 1;
  const int x = pixel % width, y = pixel / width;
  float least = values[static_cast<std::size_t>(pixel)], most = least;
  for (int row = std::max(y - kReach, 0); row <= std::min(y + kReach, height - 1); ++row) {
    for (int column = std::max(x - kReach, 0); column <= std::min(x + kReach, width - 1); ++column) {
      const float value = values[static_cast<std::size_t>(row * width + column)];
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  return {least, most};
}

}  // namespace

Planned::Planned(Stage& stage, const SweepEntry& entry, const Camera& camera)
    : stage_(stage), entry_(entry), camera_(camera) {
  if (!by_pages()) {
    again();
    return;
  }
  const Stage::View& view = *stage_.view(camera);
  const PageStorage storage(entry.pages.capacity, std::max<std::size_t>(view.sparse_points.size(), 1));
  pages_ = std::make_unique<PlannedPages>(PlannedPages{storage, {}});
  last_ = std::make_unique<PlannedPages>(PlannedPages{storage, {}});
  feedback_.assign(view.sparse_points.size(), 0);
  if ((entry.pages.policy->feedback & kDepthEdge) != 0) {
    for (std::size_t i = 0; i < feedback_.size(); ++i) feedback_[i] = view.depth_edges[i] ? kDepthEdge : 0;
  }
  plan_pages_into(*pages_, nullptr);
  if ((entry.pages.policy->feedback & (kShadowEdge | kShadowChanged)) != 0) refine();
}

void Planned::plan_pages_into(PlannedPages& pages, const PagePlan* last) {
  const Stage::View& view = *stage_.view(camera_);
  pages.plan = plan_pages(camera_, stage_.light(), stage_.bounds(), {view.sparse_points, {}, feedback_, last},
                          entry_.plan, entry_.pages, pages.storage.spans());
}

void Planned::refine() {
  render::FrameOptions options;
  options.prune = prune_rules_of(PruneSource::this_frame);
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  std::vector<float> before;
  for (int round = 0; round < kMostRounds && pages_->plan.status == PlanStatus::ok; ++round) {
    draw(camera_, options);
    std::vector<float> lit = lit_of(stage_.renderer().mask());
    report(lit, before);
    before = std::move(lit);
    std::swap(pages_, last_);
    plan_pages_into(*pages_, &last_->plan);
    if (same_pages(pages_->plan, last_->plan)) return;
  }
}

void Planned::report(const std::vector<float>& mask, const std::vector<float>& mask_before) {
  const Stage::View& view = *stage_.view(camera_);
  for (std::size_t i = 0; i < feedback_.size(); ++i) {
    const auto pixel = static_cast<int>(view.sparse_pixels[i]);
    const auto [least, most] = range_round(mask, camera_.width, camera_.height, pixel);
    feedback_[i] = most - least > kEdge ? kShadowEdge : 0;
    // Nothing to compare with yet: every page may change.
    const bool changed = mask_before.empty() ||
                         std::abs(mask[view.sparse_pixels[i]] - mask_before[view.sparse_pixels[i]]) > kEdge;
    if (changed) feedback_[i] |= kShadowChanged;
  }
}

void Planned::again() {
  by_pages() ? plan_pages_into(*pages_, &last_->plan) : void(maps_ = stage_.plan(entry_, camera_));
}

void Planned::seen_by(const Camera& after) {
  by_pages() ? rebase(*pages_, after.position) : void(maps_ = seen_from(maps_, camera_, after));
}

render::FrameStats Planned::draw(const Camera& camera, render::FrameOptions options) {
  options.depth_layer = entry_.layer;
  const render::PreparedFilter filter = stage_.filter(entry_);
  return by_pages() ? stage_.renderer().draw(pages_->plan, camera, filter, options)
                    : stage_.renderer().draw(maps_, camera, filter, options);
}

PlanStatus Planned::status() const noexcept {
  return by_pages() ? pages_->plan.status : maps_.status;
}

std::string_view Planned::invalid_field() const noexcept {
  return by_pages() ? pages_->plan.invalid_field : maps_.invalid_field;
}

std::span<const Omission> Planned::omitted() const noexcept {
  return by_pages() ? pages_->plan.omitted() : maps_.omitted();
}

int Planned::map_count() const noexcept {
  return by_pages() ? static_cast<int>(pages_->plan.pages.size()) : maps_.map_count;
}

const ShadowMap* Planned::map(int index) const noexcept {
  if (index < 0 || index >= map_count()) return nullptr;
  const auto at = static_cast<std::size_t>(index);
  return by_pages() ? &pages_->plan.levels[pages_->plan.pages[at].level] : &maps_.map[at];
}

std::vector<float> Planned::aliasing(const FloatImage& mask) const {
  std::vector<float> m;
  if (!by_pages()) {
    const FloatImage image = stage_.renderer().aliasing();
    for (std::size_t i = 0; i < image.values.size(); i += 4)
      m.push_back(image.values[i + 3] < 0.0f ? 0.0f : image.values[i]);
    return m;
  }
  const FloatImage at = stage_.renderer().positions(), facing = stage_.renderer().normals();
  m.resize(mask.values.size() / 2);
  for (std::size_t i = 0; i < m.size(); ++i) {
    const ShadowMap* const level = map(static_cast<int>(mask.values[2 * i + 1]));
    if (level == nullptr || !(facing.values[4 * i + 3] > 0.0f)) continue;
    const glm::dvec3 point =
        camera_.position + glm::dvec3(at.values[4 * i], at.values[4 * i + 1], at.values[4 * i + 2]);
    const glm::dvec3 normal(facing.values[4 * i], facing.values[4 * i + 1], facing.values[4 * i + 2]);
    const glm::dvec3 light =
        level->light_world.w != 0.0 ? point - glm::dvec3(level->light_world) : pages_->plan.light_direction;
    if (glm::dot(normal, light) >= 0.0) continue;
    m[i] = static_cast<float>(measure_point(*level, camera_, point, normal).m_max);
  }
  return m;
}

Image Planned::heat_map(const FloatImage& mask) const {
  if (!by_pages()) return stage_.renderer().heat_map();
  constexpr render::Color kNone{158, 158, 158};  // the sky of heat.frag
  const std::vector<float> m = aliasing(mask);
  Image image = render::blank_image(mask.width, mask.height, kNone);
  for (std::size_t i = 0; i < m.size(); ++i) {
    if (m[i] > 0.0f) set_pixel(image, i, render::heat_color(static_cast<double>(m[i])));
  }
  return image;
}

std::uint64_t Planned::table_bytes() const noexcept {
  if (!by_pages()) return 0;
  // As shaders/common/pages.glsl has them: a matrix and a key for each page, with four planes for each level.
  constexpr std::uint64_t kPage = 80, kLevel = 144, kEntry = 4;
  const PagePlan& plan = pages_->plan;
  return kPage * plan.pages.size() + kLevel * plan.levels.size() + kEntry * plan.table.size();
}

}  // namespace gnomon::tool
