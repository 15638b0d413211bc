// What filters store besides the depth maps: the images, and the passes that fill them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "filter/filter_block.hpp"
#include "filter/filter_tiles.hpp"
#include "gl/gl_object.hpp"
#include "gl/shader_text.hpp"
#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// What of a filter's settings its programs are compiled for.
struct FilterVariant {
  static constexpr int kAnyReach = -1;
  const Filter* filter = nullptr;
  int vectors = 1;
  MapRead reads = MapRead::depth;  ///< reads_of
  bool reads_slope = false;
  int reach = 0;     ///< of the blur that all maps have; kAnyReach: read from the block for each map
  int channels = 1;  ///< of a stored texel
  bool operator==(const FilterVariant&) const = default;
};
[[nodiscard]] FilterVariant variant_of(const FilterSettings& settings) noexcept;

/// The programs of one variant of a filter; those that it has no use for are empty. Texels are stored and
/// blurred by store_rows and blur_columns where all maps have one reach, else by store and blur.
struct FilterPrograms {
  FilterVariant variant;
  /// Made when pages are first drawn; the last two where the filter stores texels.
  Program mask_pages, store_page, blur_page;
  Program mask_lights, shade_clusters;  ///< made when many lights are first drawn
  Program shaped_mask, shaped_mark;  ///< made when a map has a shape; `mask` and `mark` are for linear ones
  Program mask, mark, blur_columns, store, blur, join_mip, depth_max, sum_rows, sum_columns;
  /// One that stores all vectors of a texel, or, where the reach is above 0, one for each that blurs it.
  std::vector<Program> store_rows;

  /// `shaped`: a map of the frame is not linear.
  [[nodiscard]] const Program& mask_for(bool shaped) const noexcept {
    return shaped && shaped_mask ? shaped_mask : mask;
  }
  [[nodiscard]] const Program& mark_for(bool shaped) const noexcept {
    return shaped && shaped_mark ? shaped_mark : mark;
  }
};
/// The shader of pass/mask/mask.frag for maps that lie as the part `source` says.
[[nodiscard]] ShaderName mask_shader(const Filter& filter, MapRead reads, std::string source);
/// Shaders that the filter takes part in when it is read so, that of the mask first.
[[nodiscard]] std::vector<ShaderName> filter_shaders(const Filter& filter, MapRead reads);
/// The same for pages; none where pages do not take such a filter.
[[nodiscard]] std::vector<ShaderName> pages_shaders(const Filter& filter, MapRead reads);
/// The same for a pool of many lights: the mask of one, and the light of all.
[[nodiscard]] std::vector<ShaderName> lights_shaders(const Filter& filter, MapRead reads);
/// Adds the programs for pages, once. Throws RenderError as make_filter_programs, and for
/// page_filter_refusal.
void make_pages_programs(const FilterSettings& settings, FilterPrograms& programs);
/// The mask of one of many lights, from a pool. Throws RenderError as make_filter_programs, and for filters
/// that store texels.
[[nodiscard]] Program make_lights_program(const FilterSettings& settings);
/// The mask and the light of all of them, by clusters.
[[nodiscard]] Program make_clusters_program(const FilterSettings& settings);
/// Adds the programs that read maps of any shape, once. Throws RenderError as make_filter_programs.
void make_shaped_programs(const FilterSettings& settings, FilterPrograms& programs);
/// Throws RenderError with shader file and line.
[[nodiscard]] FilterPrograms make_filter_programs(const FilterSettings& settings);

/// Texture units of the filters, as the shaders state them.
inline constexpr GLuint kCompareUnit = 4, kDepthUnit = 5, kDepthMaxUnit = 7, kStoredUnit = 8;
/// Binding of the block of filter_block.hpp.
inline constexpr GLuint kFilterBinding = 1;

/// The maps to be stored: layers 0, 1, .. of `depth`, each in the lower left corner of its layer.
struct StoreJob {
  GLuint depth = 0;
  int layer_width = 0, layer_height = 0;
  std::span<const glm::ivec2> map_size;
  bool mipmaps = false, shaped = false;  ///< shaped: a map is not linear
  /// Maps whose depths are those of the last build(): what was made of them stays, where it was made alike.
  std::array<bool, kMaxMaps> held{};
  /// Draws the bound program over the frame's pixels, so that it marks the tiles that the mask reads. Empty:
  /// maps are filtered whole.
  std::function<void()> mark_read = {};
};

class StoredMaps {
 public:
  using Held = std::array<bool, kMaxMaps>;

  StoredMaps();
  /// Fills everything that `settings` reads; images are made anew where size or format changes, and given up
  /// where the filter has no use for them. The block must be bound at kFilterBinding and be the one of
  /// `reach`.
  void build(const FilterPrograms& programs, const FilterSettings& settings, const FilterBlock& block,
             const StoreJob& job);
  /// Binds what build() filled to the filters' texture units.
  void bind() const noexcept;

  [[nodiscard]] int passes() const noexcept { return passes_; }          ///< of the last build()
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }  ///< kept for look-ups
  [[nodiscard]] std::uint64_t scratch_bytes() const noexcept { return scratch_bytes_ + tiles_.bytes(); }
  /// Texels that were filled since the last call; waits for the passes.
  [[nodiscard]] std::uint64_t take_filtered_texels() { return tiles_.take_count(); }
  /// Texels of the maps that the last build() began anew.
  [[nodiscard]] std::uint64_t whole_texels() const noexcept { return whole_texels_; }
  /// OpenGL name of the image of channels 4 i .. 4 i + 3, 0 where there is none.
  [[nodiscard]] GLuint image(std::size_t i) const noexcept {
    return i < stored_.size() ? stored_[i].name() : 0;
  }

 private:
  /// True where all images are new.
  bool fit(const FilterPrograms& programs, const FilterSettings& settings, const StoreJob& job, bool blurred);
  /// Which maps are valid as they are; `made_` becomes what they hold after this build().
  Held keep_whole(const StoreJob& job) noexcept;
  /// The same, and decides which tiles of the others are filled.
  Held choose_tiles(const FilterPrograms& programs, const StoreJob& job);
  /// Whether the last build() was told the same.
  [[nodiscard]] bool made_alike(const FilterSettings& settings, const FilterBlock& block) noexcept;
  void blur_map(const FilterPrograms& programs, GLint map, bool blurred);
  void walk_map(const FilterPrograms& programs, GLint map);
  void walk_rows(const Program& program, GLint map, std::span<const Texture> into, GLint layer);
  void walk_columns(const FilterPrograms& programs, GLint map, std::size_t vector);
  void join_mips(const FilterPrograms& programs, const StoreJob& job, const Held& held);
  void sum_map(const FilterPrograms& programs, GLint map, const StoreJob& job);
  void build_depth_max(const FilterPrograms& programs, const StoreJob& job, const Held& held);
  void draw(GLuint fbo, glm::ivec2 size);

  struct Shape {
    int width = 0, height = 0, layers = 0, levels = 0, vectors = 0;
    GLenum format = 0;
    bool scratch = false, walks = false, depth_max = false;
    bool operator==(const Shape&) const = default;
  };
  Shape shape_;
  std::vector<Texture> stored_, scratch_;
  Texture depth_max_;
  Framebuffer stored_fbo_ = make_framebuffer(), scratch_fbo_ = make_framebuffer();
  VertexArray no_vertices_ = make_vertex_array();
  Sampler stored_sampler_ = make_sampler(), nearest_sampler_ = make_sampler();
  FilterSettings made_with_;  ///< of the last build()
  FilterBlock made_block_{};
  /// What a layer holds; a frame touches those of its maps alone.
  struct Made {
    bool depths = false;  ///< texels of these settings
    bool whole = false;   ///< in all tiles
    int marks = 0;        ///< frames that marked tiles since the depths were drawn
  };
  std::array<Made, kMaxMaps> made_{};
  FilterTiles tiles_;
  std::uint64_t whole_texels_ = 0;
  glm::ivec2 viewport_{0};
  int passes_ = 0;
  std::uint64_t bytes_ = 0, scratch_bytes_ = 0;
};

}  // namespace gnomon::render
