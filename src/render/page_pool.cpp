// The pages of a frame on the GPU: where each lies in the pool, and the tables that shaders find them by.
#include "page_pool.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "frame_block.hpp"

namespace gnomon::render {
namespace {

// Bindings as shaders/common/pages.glsl states them.
constexpr GLuint kLevelBinding = 2, kRecordBinding = 3, kTableBinding = 4;
// Pages along each side of a layer: drivers take at least 2048 layers, of at least 16384 texels.
constexpr int kPagesAcross = 8;

template <class T>
void send(Buffer& buffer, const std::vector<T>& values) {
  buffer = make_buffer();
  const std::size_t bytes = std::max<std::size_t>(values.size() * sizeof(T), 16);
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data());
}

/// From the clip space of a page, -1..1 over its slot, to that of the layer it lies in.
glm::dmat4 layer_from_slot(const TexelRect& place, int side) {
  glm::dmat4 into(1.0);
  for (int axis = 0; axis < 2; ++axis) {
    const double size = axis == 0 ? place.width : place.height, begin = axis == 0 ? place.x : place.y;
    into[axis][axis] = size / side;
    into[3][axis] = (2.0 * begin + size) / side - 1.0;
  }
  return into;
}

}  // namespace

PagePool::Extent PagePool::extent_of(const PagePlan& plan) noexcept {
  constexpr int kPerLayer = kPagesAcross * kPagesAcross;
  const int pages = static_cast<int>(plan.pages.size());
  return {kPagesAcross * plan.slot_texels(), std::max(1, (pages + kPerLayer - 1) / kPerLayer)};
}

void PagePool::build(const PagePlan& plan, const glm::dvec3& origin_world) {
  const Extent extent = extent_of(plan);
  const int slot = plan.slot_texels();
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  pages_.clear();
  levels_.clear();
  records_.clear();
  for (const ShadowMap& map : plan.levels) {
    Level level{glm::mat4(drawn_from_plan * glm::dmat4(map.clip_from_camera_relative)), {}, {}};
    level.select_planes.fill({0.0f, 0.0f, 0.0f, 1.0f});
    for (int i = 0; i < map.select_plane_count; ++i) {
      const glm::dvec4 plane = map.select_planes[static_cast<std::size_t>(i)];
      const double at_origin = plane.w + glm::dot(glm::dvec3(plane), plan.origin_world);
      level.select_planes[static_cast<std::size_t>(i)] =
          glm::vec4(glm::vec3(plane), static_cast<float>(at_origin));
    }
    level.grid = {map.width / plan.page_texels, map.height / plan.page_texels, map.cascade, 0};
    levels_.push_back(level);
  }
  for (const Page& page : plan.pages) {
    DrawnPage drawn;
    drawn.map = page_map(plan, page);
    const int at = static_cast<int>(page.slot);
    drawn.layer = at / (kPagesAcross * kPagesAcross);
    drawn.place = {at % kPagesAcross * slot, at / kPagesAcross % kPagesAcross * slot, slot, slot};
    const auto counted_from = [&](const glm::dvec3& origin) {
      glm::dmat4 m = drawn.map.clip_from_world;
      m[3] = m * glm::dvec4(origin, 1.0);
      return m;
    };
    drawn.clip_from_position = glm::mat4(drawn_from_plan * counted_from(origin_world));
    records_.push_back({glm::mat4(layer_from_slot(drawn.place, extent.side) * drawn_from_plan *
                                  counted_from(plan.origin_world)),
                        {page.level, static_cast<std::uint32_t>(page.column),
                         static_cast<std::uint32_t>(page.row), static_cast<std::uint32_t>(drawn.layer)}});
    pages_.push_back(drawn);
  }
  table_ = {static_cast<std::uint32_t>(plan.levels.size()), static_cast<std::uint32_t>(plan.table.size()),
            static_cast<std::uint32_t>(plan.border_texels), 0};
  table_.insert(table_.end(), plan.table.begin(), plan.table.end());
  send(level_buffer_, levels_);
  send(record_buffer_, records_);
  send(table_buffer_, table_);
}

void PagePool::bind() const noexcept {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kLevelBinding, level_buffer_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kRecordBinding, record_buffer_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTableBinding, table_buffer_.name());
}

}  // namespace gnomon::render
