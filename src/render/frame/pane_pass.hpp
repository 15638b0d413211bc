// What panes absorb on the light's way to each pixel: maps of absorbance beside the shadow maps, and the
// image that is read from them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "casters/scene_buffers.hpp"
#include "frame/target.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "maps/drawn_maps.hpp"
#include "source/page_pool.hpp"
#include "source/pixel_lists.hpp"

namespace gnomon::render {

/// Texels of images of panes.
struct PaneRoom {
  glm::ivec2 layer{0};
  int layers = 0;
  [[nodiscard]] std::uint64_t bytes() const noexcept;
  bool operator==(const PaneRoom&) const = default;
};
/// What holds both.
[[nodiscard]] PaneRoom both(const PaneRoom& a, const PaneRoom& b) noexcept;
/// For all maps of a plan.
[[nodiscard]] PaneRoom room_for(const ShadowPlan& plan) noexcept;

class PanePass {
 public:
  /// Throws RenderError.
  explicit PanePass(const Scene& panes);

  /// Compiles the programs of draw_listed(), once. Throws RenderError.
  void prepare_listed();
  /// Places one instance elsewhere.
  void move(std::size_t instance, const Instance& to);
  [[nodiscard]] SceneBuffers& scene() noexcept { return panes_; }
  /// How draw_maps() draws.
  struct MapDraw {
    bool keep = false;   ///< maps that are the last frame's are drawn where panes moved alone
    double range = 0.0;  ///< as tint() takes it
    PaneRoom room = {};  ///< of the images at least, for the other plans of the frame
  };
  /// Draws the panes into a layer for each map. Maps that no pane reaches, and maps whose shape bends lines,
  /// take none.
  void draw_maps(const ShadowPlan& plan, const DrawnMaps& drawn, const MapDraw& how);
  /// Texels that the last draw_maps() or draw_pages() cleared and drew.
  [[nodiscard]] std::uint64_t texels() const noexcept { return texels_; }
  /// Compiles the program that reads pages, once. Throws RenderError.
  void prepare_pages();
  /// Draws the panes into a place for each page that they reach; after the pool has placed the plan's pages.
  /// Places are smaller than pages where the images would take more than kMaxPageBytes, empty ones counted.
  void draw_pages(const PagePlan& plan, const PagePool& pool, const glm::dvec3& origin_world);
  /// Likewise for bind_maps(); the pool's tables are bound.
  void bind_pages(const glm::dvec3& camera_world) noexcept;
  static constexpr std::uint64_t kMaxPageBytes = std::uint64_t{256} << 20;

  /// Whether panes tint what a light lights: some lie in its maps and within its range, 0: none.
  [[nodiscard]] bool tint(const ShadowPlan& plan, const DrawnMaps& drawn, double range);
  /// Sums up what panes absorb before each listed sample of a frame, exactly. The frame's block is that of
  /// the plan; only after prepare_listed().
  void draw_listed(const ShadowPlan& plan, const glm::dvec3& camera_world, const PixelLists& lists);
  /// For a full-screen pass: the program's images and uniforms. `camera_world`: where positions are from.
  void bind_maps(const glm::dvec3& camera_world) noexcept;
  /// Multiplies the picture with the panes before its surfaces.
  void draw_over(const FrameTargets& targets, const glm::mat4& clip_from_camera_relative,
                 const glm::dvec3& camera_world);
  /// Makes the image anew where its size differs.
  void resize(int width, int height);
  /// Makes the image that of a frame in which panes tint nothing.
  void clear_image() noexcept;

  [[nodiscard]] const Program& transmittance_program() const noexcept { return transmittance_program_; }
  /// The same from pages; only after prepare_pages().
  [[nodiscard]] const Program& pages_program() const noexcept { return *pages_program_; }
  /// Makes the image from what draw_listed() left.
  [[nodiscard]] const Program& listed_program() const noexcept { return listed_->transmittance; }
  [[nodiscard]] const Program& add_light_program() const noexcept { return add_light_program_; }
  [[nodiscard]] const Program& shade_program() const noexcept { return shade_program_; }
  [[nodiscard]] GLuint fbo() const noexcept { return image_fbo_.name(); }
  [[nodiscard]] const Texture& image() const noexcept { return image_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept;

 private:
  struct Rectangle {
    glm::ivec2 low{0}, high{0};
    [[nodiscard]] bool empty() const noexcept { return low.x >= high.x || low.y >= high.y; }
    [[nodiscard]] std::uint64_t area() const noexcept;
    bool operator==(const Rectangle&) const = default;
  };
  struct Listed {
    Listed();
    Program sums, transmittance;
    Buffer absorbed = make_buffer();  ///< red, green, blue of each sample
    std::uint64_t bytes = 0;
  };
  /// Decides all texels of a map.
  struct Look {
    DrawnMap map;
    glm::dvec3 origin_world{0.0};
    glm::dvec4 light_world{0.0};
    glm::dvec2 range_world{0.0};
    bool operator==(const Look&) const = default;
  };
  /// What a layer holds.
  struct Held {
    bool valid = false;
    Look look;
    Rectangle at;  ///< texels that were cleared or drawn
  };
  /// Mirrors PanePage of shaders/pass/panes/place/pages.glsl.
  struct PageRecord {
    glm::vec4 from_pool{0.0f};
    glm::vec4 drawn{1.0f, 1.0f, 0.0f, 0.0f};  ///< no texel
    glm::vec4 layer{0.0f};
    bool operator==(const PageRecord&) const = default;
  };
  /// A page that panes reach.
  struct PageLook {
    glm::mat4 clip_from_position{1.0f};
    int layer = 0;
    glm::ivec2 place{0};
    Rectangle at;  ///< in the layer
    bool operator==(const PageLook&) const = default;
  };
  /// What decides all texels of the pages' places.
  struct PagesLook {
    std::vector<PageLook> pages;
    int side = 0, across = 1;  ///< texels along a place, places along a layer
    [[nodiscard]] PaneRoom room() const noexcept;
    glm::dvec3 origin_world{0.0};
    glm::dvec4 light_world{0.0};
    glm::dvec2 range_world{0.0};
    bool operator==(const PagesLook&) const = default;
  };
  [[nodiscard]] PagesLook place_pages(const PagePlan& plan, const PagePool& pool,
                                      const glm::dvec3& origin_world, std::vector<PageRecord>& records) const;
  /// Binds the images' layer for drawing sums of panes.
  void attach(int layer) noexcept;
  void begin_sums(const glm::dvec3& origin_world) noexcept;
  void end_sums() noexcept;
  void bind_images() noexcept;
  /// Draws one map, or what changed in it.
  void draw_map(int layer, const Look& look, bool keep) noexcept;
  void clear(const Rectangle& at) noexcept;
  /// The part of `now` that lies outside `before`.
  void clear_beyond(const Rectangle& before, const Rectangle& now) noexcept;
  /// Shows the panes within a local light's range.
  void show_within(const glm::dvec4& light_world, double range);
  /// Images of at least that size, and of at most so many bytes where they are larger.
  void fit(const PaneRoom& wanted, std::uint64_t most_bytes);
  /// Texels of a map that boxes reach.
  [[nodiscard]] static Rectangle reached(const DrawnMap& map, const glm::dvec3& origin_world,
                                         std::span<const Box> boxes) noexcept;
  /// Least and largest distance of panes along the light, rounded outwards: a pane that moves a little
  /// changes nothing.
  [[nodiscard]] glm::dvec2 range_along(const glm::dvec4& light_world) const noexcept;
  /// Of the program that is in use; positions are from `origin_world`.
  void set_light(const glm::dvec3& origin_world) const noexcept;
  /// By the program that is in use, whose uniforms besides the materials' are set.
  void draw_all() const noexcept;

  SceneBuffers panes_;
  Program map_program_, transmittance_program_, add_light_program_, shade_program_, over_program_;
  std::optional<Listed> listed_;
  Buffer order_;
  Texture absorbance_, moments_, places_, image_;
  Framebuffer map_fbo_, image_fbo_, over_fbo_;
  PaneRoom room_;
  glm::ivec2 image_size_{0};
  std::vector<std::uint8_t> shown_;  ///< by instance: drawn into the maps at hand
  std::vector<Box> shown_world_;     ///< bounds of these
  /// Bounds of panes that moved since the last draw_maps() or draw_pages(), before and after.
  std::vector<Box> changed_world_;
  std::array<Held, kMaxMaps> held_;
  std::optional<PagesLook> held_pages_;
  std::optional<Program> pages_program_;
  Buffer page_records_ = make_buffer();
  std::uint64_t texels_ = 0;
  std::array<glm::vec4, kMaxMaps> drawn_{};
  glm::dvec4 light_world_{0.0};
  glm::dvec2 range_world_{0.0};
};

}  // namespace gnomon::render
