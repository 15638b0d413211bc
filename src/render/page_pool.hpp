// The pages of a frame on the GPU: where each lies in the pool, and the tables that shaders find them by.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl_object.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/reuse.hpp"

namespace gnomon::render {

/// How casters are drawn into one page: from positions relative to an origin, into a rectangle of a layer.
struct DrawnPage {
  ShadowMap map;  ///< page_map: planes for culling
  glm::mat4 clip_from_position{1.0f};
  int layer = 0;
  TexelRect place{};  ///< in the layer, border included
};

/// Pages side by side in the layers of one depth array.
class PagePool {
 public:
  /// Sides of a layer, and layers that all pages of the plan need.
  struct Extent {
    int side = 1, layers = 1;
  };
  [[nodiscard]] static Extent extent_of(const PagePlan& plan) noexcept;

  /// Places the pages and sends the tables. `origin_world`: what casters are drawn relative to.
  void build(const PagePlan& plan, const glm::dvec3& origin_world);
  [[nodiscard]] std::span<const DrawnPage> pages() const noexcept { return pages_; }
  /// Binds the tables where shaders/common/pages.glsl reads them.
  void bind() const noexcept;

 private:
  /// Mirrors PageLevel and PageRecord of the shaders.
  struct Level {
    glm::mat4 clip_from_point;
    std::array<glm::vec4, kMaxSelectPlanes> select_planes;
    glm::ivec4 grid;
  };
  struct Record {
    glm::mat4 clip_from_point;
    glm::uvec4 key;
  };
  std::vector<DrawnPage> pages_;
  std::vector<Level> levels_;
  std::vector<Record> records_;
  std::vector<std::uint32_t> table_;
  Buffer level_buffer_, record_buffer_, table_buffer_;
};

}  // namespace gnomon::render
