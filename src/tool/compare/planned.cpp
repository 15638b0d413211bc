// What a technique plans for one camera, maps or pages, ready to be drawn, timed and looked into.
#include "planned.hpp"

#include "moved_eye.hpp"
#include "page_aliasing.hpp"

namespace gnomon::tool {

Planned::Planned(Stage& stage, const SweepEntry& entry, const Camera& camera)
    : stage_(stage), entry_(entry), camera_(camera) {
  if (!by_pages()) {
    again();
    return;
  }
  PageOptions options_of_pages = entry.pages;
  options_of_pages.plan = entry.plan;
  pages_ = std::make_unique<FramePages>(PageFrameInput{stage_.light(), stage_.bounds(), options_of_pages},
                                        stage_.view(camera)->surfaces);
  if (!pages_->wants_rounds()) return;
  render::FrameOptions options;
  options.prune = prune_rules_of(PruneSource::this_frame);
  options.depth_layer = entry.layer;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  (void)pages_->refine(stage_.renderer(), stage_.filter(entry), options);
}

void Planned::again() {
  by_pages() ? pages_->again() : void(maps_ = stage_.plan(entry_, camera_));
}

void Planned::move_eye(const Camera& after) {
  by_pages() ? pages_->rebase_to(after.position) : void(maps_ = moved_eye(maps_, camera_, after));
}

render::FrameStats Planned::draw(const Camera& camera, render::FrameOptions options) {
  options.depth_layer = entry_.layer;
  options.linear_depth = entry_.linear_depth;
  options.map_passes = entry_.map_passes;
  const render::PreparedFilter filter = stage_.filter(entry_);
  return by_pages() ? pages_->draw(stage_.renderer(), camera, filter, options)
                    : stage_.renderer().draw(maps_, camera, filter, options);
}

PlanStatus Planned::status() const noexcept {
  return by_pages() ? pages_->plan().status : maps_.status;
}

std::string_view Planned::invalid_field() const noexcept {
  return by_pages() ? pages_->plan().invalid_field : maps_.invalid_field;
}

std::span<const Omission> Planned::omitted() const noexcept {
  return by_pages() ? pages_->plan().omitted() : maps_.omitted();
}

int Planned::map_count() const noexcept {
  return by_pages() ? static_cast<int>(pages_->plan().pages.size()) : maps_.map_count;
}

const ShadowMap* Planned::map(int index) const noexcept {
  if (by_pages()) return pages_->level_of(index);
  if (index < 0 || index >= maps_.map_count) return nullptr;
  return &maps_.map[static_cast<std::size_t>(index)];
}

std::vector<float> Planned::aliasing(const FloatImage& mask) const {
  const render::Renderer& renderer = stage_.renderer();
  if (by_pages())
    return page_aliasing(pages_->plan(), camera_, {mask, renderer.positions(), renderer.normals()});
  std::vector<float> m;
  const FloatImage image = renderer.aliasing();
  for (std::size_t i = 0; i < image.values.size(); i += 4)
    m.push_back(image.values[i + 3] < 0.0f ? 0.0f : image.values[i]);
  return m;
}

ExpectedError Planned::expected(const ShadowPicture& shadow) const noexcept {
  return by_pages() ? expected_error(pages_->plan(), shadow) : expected_error(maps_, shadow);
}

Image Planned::heat_map(const FloatImage& mask) const {
  const render::Renderer& renderer = stage_.renderer();
  if (!by_pages()) return renderer.heat_map();
  const PageFrameImages images{mask, renderer.positions(), renderer.normals()};
  return page_heat_map(pages_->plan(), page_aliasing(pages_->plan(), camera_, images), images);
}

std::uint64_t Planned::table_bytes() const noexcept {
  if (!by_pages()) return 0;
  // As shaders/pass/page/tables.glsl has them: a matrix and a key for each page, with four planes for each
  // level.
  constexpr std::uint64_t kPage = 80, kLevel = 144, kEntry = 4;
  const PagePlan& plan = pages_->plan();
  return kPage * plan.pages.size() + kLevel * plan.levels.size() + kEntry * plan.table.size();
}

}  // namespace gnomon::tool
