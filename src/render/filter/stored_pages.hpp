// What filters store besides the depths of pages: images as large as the pool, and the passes that fill a
// page.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "filter/filter_block.hpp"
#include "filter/stored_maps.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/pages.hpp"
#include "source/page_pool.hpp"

namespace gnomon::render {

class StoredPages {
 public:
  StoredPages();

  /// Options and depth curve of each level, where shaders/pass/page/tables.glsl reads them.
  void send_levels(const PagePlan& plan, const FilterSettings& settings);
  /// Fills the slots of resident pages that hold other texels than these settings make of their depths.
  /// `block`: the one in `filter_buffer`, which is bound; its first map is that of the level at hand
  /// meanwhile. Frees everything where the filter stores nothing.
  void build(const FilterPrograms& programs, const FilterSettings& settings, const FilterBlock& block,
             GLuint filter_buffer, const PagePool& pool, GLuint depth);
  /// Binds the images to the filters' texture units, and the levels' options.
  void bind() const noexcept;

  [[nodiscard]] int passes() const noexcept { return passes_; }  ///< of the last build()
  [[nodiscard]] std::uint64_t filtered_texels() const noexcept { return filtered_texels_; }  ///< the same
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::uint64_t scratch_bytes() const noexcept { return scratch_bytes_; }

 private:
  /// Mirrors PageFilter of shaders/pass/page/tables.glsl.
  struct LevelValues {
    std::array<glm::vec4, kOptionVectors> options;
    glm::vec4 curve;
    bool operator==(const LevelValues&) const = default;
  };
  struct Slot {
    std::uint64_t drawn = 0;  ///< PagePool::drawn_in of the depths that were filtered; 0: none
    LevelValues values{};
  };
  struct Shape {
    int side = 0, layers = 0, vectors = 0;
    GLenum format = 0;
    bool scratch = false;
    bool operator==(const Shape&) const = default;
  };
  void fit(const Shape& wanted);
  /// No slot holds texels that other settings made.
  void forget_other_settings(const FilterSettings& settings, FilterBlock block) noexcept;
  /// Pages whose slots hold other texels than they must; they count as filled from here on.
  [[nodiscard]] std::vector<std::size_t> take_stale(const PagePool& pool);
  void fill(const FilterPrograms& programs, const PagePool& pool, std::span<const std::size_t> pages);
  void draw(const FilterPrograms& programs, const PagePool& pool, std::span<const std::size_t> pages,
            bool blurs);

  Shape shape_;
  std::vector<Texture> stored_, scratch_;
  Framebuffer stored_fbo_, scratch_fbo_;
  VertexArray no_vertices_;
  Sampler smooth_sampler_, nearest_sampler_;
  bool smooth_ = false;
  std::vector<LevelValues> levels_;
  Buffer level_buffer_;
  std::vector<Slot> slots_;
  FilterSettings made_with_;
  FilterBlock made_block_{};
  int passes_ = 0;
  std::uint64_t filtered_texels_ = 0, bytes_ = 0, scratch_bytes_ = 0;
};

}  // namespace gnomon::render
