// Culls, then turns runs of instances of one primitive into one draw command each.
#include "casters/draw_list.hpp"

#include <algorithm>

#include "casters/view_planes.hpp"
#include "gnomon/motion.hpp"

namespace gnomon::render {
namespace {

constexpr GLuint kCopiesBinding = 1;  // as shaders/pass/depth/copy.vert states it

/// What a rectangle of a map shows, a texel wider for rounding; without the rule no planes.
class PartPlanes {
 public:
  PartPlanes(PruneRules prune, const ShadowMap& map, const TexelRect& rectangle,
             const ClipSpace& clip_space) {
    const std::array<glm::dvec4, 5> sides = rectangle_planes(map, rectangle, clip_space);
    take(prune, map, sides);
  }
  PartPlanes(PruneRules prune, const ShadowMap& map, std::span<const glm::dvec4> planes) {
    take(prune, map, planes);
  }
  [[nodiscard]] std::span<const glm::dvec4> planes() const { return {planes_.data(), count_}; }

 private:
  void take(PruneRules prune, const ShadowMap& map, std::span<const glm::dvec4> planes) {
    if (!prune.has(PruneRule::caster_clusters)) return;
    const double texel = std::max(map.texel_world_max.x, map.texel_world_max.y);
    for (const glm::dvec4& plane : planes) planes_[count_++] = plane + glm::dvec4(0.0, 0.0, 0.0, texel);
  }
  std::array<glm::dvec4, kMaxCullPlanes> planes_{};
  std::size_t count_ = 0;
};

}  // namespace

DrawLists::DrawLists(SceneBuffers& scene)
    : scene_(scene), culling_(scene), cache_(scene, culling_), visible_(scene.order().size()) {
  commands_.reserve(scene.order().size());
  objects_.reserve(scene.order().size() * 2);
}

void DrawLists::clear() {
  objects_.clear();
  commands_.clear();
  ranges_.clear();
  page_parts_.clear();
  moving_parts_.clear();
  copies_.clear();
  part_count_.fill(0);
  beneath_.fill({});
  layered_count_ = 0;
  layered_draws_ = 0;
  stats_.fill({});
}

void DrawLists::build(const CullingJob& job, const DrawnMaps& drawn, const Camera& camera,
                      const LayeredRule& rule) {
  clear();
  PruneSavings saved;
  culling_.count_omissions(job.plan, saved);
  // Casters moved in maps of earlier plans as well, which are not brought up to date now.
  if (!job.moved_world.empty() && job.plan.map_count > 0) cache_.forget(job.plan.maps().size());
  for (std::size_t map = 0; map < job.plan.maps().size(); ++map) add_map(job, drawn, map, saved);
  join_maps(job, drawn, rule);
  saved_ = saved.net();
  finish(camera);
}

void DrawLists::build_uncached(const CullingJob& job, const Camera& camera) {
  clear();
  PruneSavings saved;
  culling_.count_omissions(job.plan, saved);
  for (std::size_t map = 0; map < job.plan.maps().size(); ++map) {
    move_[map] = {};
    const ShadowMap& of = job.plan.map[map];
    DrawnPart& part = parts_[map][part_count_[map]++];
    part = {{0, 0, of.width, of.height}, false, ranges_.size(), 0};
    const std::span<const std::uint8_t> casters = culling_.casters_of(job, of, saved);
    add_view(casters, stats_[map], PartPlanes(job.prune, of, part.rectangle, job.plan.clip_space).planes(),
             saved.of(PruneRule::caster_clusters));
    part.end = ranges_.size();
    stats_[map].texels = texels_of(of);
  }
  saved_ = saved.net();
  finish(camera);
}

void DrawLists::build_pages(std::span<const DrawnPage> pages, const Camera& camera, PruneRules prune,
                            std::span<const std::uint8_t> moves) {
  clear();
  PruneSavings saved;
  MapStats& stats = stats_.front();
  std::vector<std::uint8_t> draws(visible_.size()), over(visible_.size());
  for (const DrawnPage& page : pages) {
    const std::span planes(page.map.cull_planes.data(), static_cast<std::size_t>(page.map.cull_plane_count));
    std::fill(draws.begin(), draws.end(), std::uint8_t{0});
    std::fill(over.begin(), over.end(), std::uint8_t{0});
    for (const std::uint32_t instance : culling_.instances_within(planes)) {
      if (!moves.empty() && moves[instance] != 0) {
        over[instance] = 1;
      } else if (!page.composed) {
        draws[instance] = 1;
      } else {
        ++saved.of(PruneRule::static_casters).instances;
        saved.of(PruneRule::static_casters).triangles += scene_.triangles_of(instance);
      }
    }
    const auto list = [&](std::span<const std::uint8_t> casters) {
      DrawnPart part{page.place, false, ranges_.size(), 0};
      add_view(casters, stats, PartPlanes(prune, page.map, planes).planes(),
               saved.of(PruneRule::caster_clusters));
      part.end = ranges_.size();
      return part;
    };
    page_parts_.push_back(list(draws));
    moving_parts_.push_back(list(over));
    stats.texels +=
        static_cast<std::uint64_t>(page.place.width) * static_cast<std::uint64_t>(page.place.height);
  }
  saved_ = saved.net();
  finish(camera);
}

void DrawLists::finish(const Camera& camera) {
  camera_begin_ = ranges_.size();
  MapStats& of_camera = stats_.back();
  of_camera = {};
  mark_visible(camera);
  PruneSaving none;
  add_view(visible_, of_camera, {}, none);
  of_camera.texels = static_cast<std::uint64_t>(camera.width) * static_cast<std::uint64_t>(camera.height);
  send_growing(object_buffer_, object_capacity_, objects_);
  send_growing(command_buffer_, command_capacity_, commands_);
  if (!copies_.empty()) {
    send_growing(copy_buffer_, copy_capacity_, copies_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCopiesBinding, copy_buffer_.name());
  }
  scene_.set_object_index_buffer(object_buffer_.name());
  bind_commands();
}

void DrawLists::add_map(const CullingJob& job, const DrawnMaps& drawn, std::size_t map, PruneSavings& saved) {
  const std::span<const std::uint8_t> casters = culling_.casters_of(job, job.plan.map[map], saved);
  const LayeredWork layered = cache_.update({job, drawn, map, casters}, saved);
  const MapWork& work = layered.map;
  const ShadowMap as_drawn = drawn_form(job.plan, map);
  MapStats& stats = stats_[map];
  if (layered.has_beneath) {
    Beneath& beneath = beneath_[map];
    beneath.used = true;
    beneath.adopts = layered.adopts;
    beneath.move = layered.beneath.move;
    for (const MapPart& part : layered.beneath.parts())
      beneath.part[beneath.part_count++] = listed(job, as_drawn, part, stats, saved);
    beneath.copies_whole =
        work.copies.size() == 1 && work.copies[0] == TexelRect{0, 0, as_drawn.width, as_drawn.height};
    beneath.copies = {copies_.size(), beneath.copies_whole ? 0 : work.copies.size()};
    for (const TexelRect& copy : work.copies) {
      if (!beneath.copies_whole) copies_.push_back({copy.x, copy.y, copy.width, copy.height});
      stats.copied += static_cast<std::uint64_t>(copy.width) * static_cast<std::uint64_t>(copy.height);
    }
  }
  move_[map] = work.move;
  for (const MapPart& part : work.parts())
    parts_[map][part_count_[map]++] = listed(job, as_drawn, part, stats, saved);
  stats.texels = work.texels;
  stats.held = !work.any();
  stats.scrolled = work.move.any() || layered.beneath.move.any();
  stats.age = work.age;
}

DrawnPart DrawLists::listed(const CullingJob& job, const ShadowMap& as_drawn, const MapPart& part,
                            MapStats& stats, PruneSavings& saved) {
  DrawnPart at{part.rectangle, part.clear, ranges_.size(), 0};
  add_view(part.draws, stats, PartPlanes(job.prune, as_drawn, part.rectangle, kOpenGlZeroToOne).planes(),
           saved.of(PruneRule::caster_clusters));
  at.end = ranges_.size();
  return at;
}

bool DrawLists::is_layered(int index) const noexcept {
  const std::span<const int> maps = layered_maps();
  return std::find(maps.begin(), maps.end(), index) != maps.end();
}

bool DrawLists::is_drawn_whole(std::size_t map, const DrawnMap& as) const noexcept {
  const DrawnPart& part = parts_[map].front();
  return part_count_[map] == 1 && part.clear && part.rectangle.width == as.width &&
         part.rectangle.height == as.height && !as.bent && !(as.even_scale > 0.0f);
}

void DrawLists::join_maps(const CullingJob& job, const DrawnMaps& drawn, const LayeredRule& rule) {
  if (rule.passes == MapPasses::each || job.redraws_whole || scene_.order().size() >> kMapShift != 0) return;
  // One viewport, and where faces are culled one winding. Maps of other sizes by gl_ViewportIndex would lose
  // bits: a driver may transform to it in other steps.
  const auto alike = [&](const DrawnMap& a, const DrawnMap& b) {
    return a.width == b.width && a.height == b.height &&
           (!rule.one_winding || is_mirrored(a.clip_from_position) == is_mirrored(b.clip_from_position));
  };
  const auto join_with = [&](const DrawnMap& one) {
    layered_count_ = 0;
    for (std::size_t map = 0; map < job.plan.maps().size(); ++map) {
      if (is_drawn_whole(map, drawn.map[map]) && alike(drawn.map[map], one))
        layered_[layered_count_++] = static_cast<int>(map);
    }
    return layered_count_;
  };
  std::size_t most = 0, best = 0;
  for (std::size_t map = 0; map < job.plan.maps().size(); ++map) {
    const std::size_t count = join_with(drawn.map[map]);
    if (count > most) best = map;
    most = std::max(most, count);
  }
  if (most > 0) join_with(drawn.map[best]);
  std::uint32_t draws_each = 0;
  for (const int map : layered_maps()) draws_each += stats_[static_cast<std::size_t>(map)].draws;
  const std::size_t commands = commands_.size(), objects = objects_.size(), ranges = ranges_.size();
  if (layered_count_ > 1) {
    layered_draws_ = add_joined();
    if (rule.passes == MapPasses::layered || one_pass_is_faster(draws_each, layered_draws_, rule.software))
      return;
  }
  commands_.resize(commands);
  objects_.resize(objects);
  ranges_.resize(ranges);
  layered_count_ = 0;
  layered_draws_ = 0;
}

std::uint32_t DrawLists::add_joined() {
  const std::size_t first_command = commands_.size(), first_range = ranges_.size();
  std::array<std::size_t, kMaxMaps> next{};  // of each map's ranges
  for (std::size_t i = 0; i < layered_count_; ++i)
    next[i] = parts_[static_cast<std::size_t>(layered_[i])][0].begin;
  for (std::uint32_t b = 0; b < scene_.batches().size(); ++b) {
    joining_.clear();
    for (std::size_t i = 0; i < layered_count_; ++i) {
      const auto map = static_cast<std::uint32_t>(layered_[i]);
      if (next[i] == parts_[map][0].end || ranges_[next[i]].batch != b) continue;
      const BatchRange& range = ranges_[next[i]++];
      for (std::uint32_t c = range.begin; c < range.end; ++c) joining_.push_back({commands_[c], map});
    }
    if (joining_.empty()) continue;
    std::stable_sort(joining_.begin(), joining_.end(), [](const MapCommand& a, const MapCommand& z) {
      return a.command.first_index != z.command.first_index ? a.command.first_index < z.command.first_index
                                                            : a.command.index_count < z.command.index_count;
    });
    BatchRange joined{b, static_cast<std::uint32_t>(commands_.size()), 0};
    for (const auto& [command, map] : joining_) {
      const bool same = commands_.size() > joined.begin &&
                        commands_.back().first_index == command.first_index &&
                        commands_.back().index_count == command.index_count;
      if (!same)
        commands_.push_back(
            {command.index_count, 0, command.first_index, 0, static_cast<std::uint32_t>(objects_.size())});
      commands_.back().instance_count += command.instance_count;
      for (std::uint32_t k = 0; k < command.instance_count; ++k) {
        const std::uint32_t object = objects_[command.base_instance + k];
        objects_.push_back(object | map << kMapShift);
      }
    }
    joined.end = static_cast<std::uint32_t>(commands_.size());
    ranges_.push_back(joined);
  }
  layered_part_ = {{}, false, first_range, ranges_.size()};
  return static_cast<std::uint32_t>(commands_.size() - first_command);
}

void DrawLists::mark_visible(const Camera& camera) {
  const std::array<ViewPlane, 6> planes = view_planes(camera, camera_axes(camera));
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const Box& box = scene_.boxes()[i];
    visible_[i] = scene_.shown(static_cast<std::uint32_t>(i)) &&
                  std::none_of(planes.begin(), planes.end(), [&](const ViewPlane& plane) {
                    return wholly_outside(box, camera.position, plane);
                  });
  }
}

bool DrawLists::add_parts(std::uint32_t instance, MapStats& stats, std::span<const glm::dvec4> planes,
                          PruneSaving& saved) {
  const std::uint32_t primitive = scene_.primitive_index(instance);
  if (planes.empty() || !scene_.clusters().has(primitive)) return false;
  const std::span<const IndexRun> runs =
      scene_.clusters().within(primitive, scene_.world_from_object(instance), planes);
  std::uint32_t indices = 0;
  for (const IndexRun& run : runs) indices += run.index_count;
  const std::uint32_t whole = scene_.primitive_of(instance).index_count;
  // Less than a tenth fewer is not worth the commands.
  if (indices > whole - whole / 10) return false;
  saved.triangles += (whole - indices) / 3;
  saved.instances += runs.empty() ? 1 : 0;
  if (runs.empty()) return true;
  const auto object = static_cast<std::uint32_t>(objects_.size());
  objects_.push_back(instance);
  for (const IndexRun& run : runs) commands_.push_back({run.index_count, 1, run.first_index, 0, object});
  stats.draws += static_cast<int>(runs.size());
  ++stats.instances;
  stats.triangles += indices / 3;
  return true;
}

void DrawLists::add_view(std::span<const std::uint8_t> draws, MapStats& stats,
                         std::span<const glm::dvec4> planes, PruneSaving& saved) {
  const std::span<const Batch> batches = scene_.batches();
  for (std::uint32_t b = 0; b < batches.size(); ++b) {
    BatchRange range{b, static_cast<std::uint32_t>(commands_.size()), 0};
    std::uint32_t previous = ~0u;
    for (std::uint32_t n = batches[b].begin; n < batches[b].end; ++n) {
      const std::uint32_t instance = scene_.order()[n];
      if (draws[instance] == 0) continue;
      if (add_parts(instance, stats, planes, saved)) {
        previous = ~0u;
        continue;
      }
      const Primitive& primitive = scene_.primitive_of(instance);
      if (scene_.primitive_index(instance) != previous) {
        previous = scene_.primitive_index(instance);
        commands_.push_back({primitive.index_count, 0, primitive.first_index, 0,
                             static_cast<std::uint32_t>(objects_.size())});
        ++stats.draws;
      }
      objects_.push_back(instance);
      ++commands_.back().instance_count;
      ++stats.instances;
      stats.triangles += primitive.index_count / 3;
    }
    range.end = static_cast<std::uint32_t>(commands_.size());
    if (range.end > range.begin) ranges_.push_back(range);
  }
}

void DrawLists::bind_commands() const noexcept {
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_.name());
}

void DrawLists::draw(std::uint32_t begin, std::uint32_t end) const noexcept {
  const auto offset = static_cast<std::uintptr_t>(begin) * sizeof(DrawCommand);
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                              static_cast<GLsizei>(end - begin), 0);
}

}  // namespace gnomon::render
