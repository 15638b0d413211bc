// What panes absorb on the light's way to each pixel: maps of absorbance beside the shadow maps, and the
// image that is read from them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "drawn_maps.hpp"
#include "gl_object.hpp"
#include "gnomon/plan.hpp"
#include "pixel_lists.hpp"
#include "scene_buffers.hpp"
#include "target.hpp"

namespace gnomon::render {

class PanePass {
 public:
  /// Throws RenderError.
  explicit PanePass(const Scene& panes);

  /// Compiles the programs of draw_listed(), once. Throws RenderError.
  void prepare_listed();
  /// Draws the panes into a layer for each map. Maps that no pane reaches, and maps whose shape bends lines,
  /// take none. `range`: as tint() takes it.
  void draw_maps(const ShadowPlan& plan, const DrawnMaps& drawn, double range = 0.0);
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

  [[nodiscard]] const Program& transmittance_program() const noexcept { return transmittance_program_; }
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
  };
  struct Listed {
    Listed();
    Program sums, transmittance;
    Buffer absorbed = make_buffer();  ///< red, green, blue of each sample
    std::uint64_t bytes = 0;
  };
  /// Texels of a map that the shown panes reach.
  [[nodiscard]] Rectangle reached(const DrawnMap& map, const glm::dvec3& origin_world) const noexcept;
  /// Shows the panes within a local light's range.
  void show_within(const glm::dvec4& light_world, double range);
  void fit(const glm::ivec2& layer_size, int layers);
  void set_light(const ShadowMap& map, const glm::dvec3& origin_world) const noexcept;
  /// By the program that is in use, whose uniforms besides the materials' are set.
  void draw_all() const noexcept;

  SceneBuffers panes_;
  Program map_program_, transmittance_program_, add_light_program_, shade_program_, over_program_;
  std::optional<Listed> listed_;
  Buffer order_;
  Texture absorbance_, moments_, places_, image_;
  Framebuffer map_fbo_, image_fbo_, over_fbo_;
  glm::ivec2 layer_size_{0}, image_size_{0};
  int layers_ = 0;
  std::vector<std::uint8_t> shown_;  ///< by instance: drawn into the maps at hand
  std::array<glm::vec4, kMaxMaps> drawn_{};
  glm::dvec4 light_world_{0.0};
};

}  // namespace gnomon::render
