// Where do the outlines of casters run within the texels of the shadow maps?
// Based on: Sen, Cammarano, Hanrahan, "Shadow Silhouette Maps", 2003.
#pragma once

#include <cstdint>
#include <vector>

#include "casters/draw_list.hpp"
#include "casters/scene_buffers.hpp"
#include "frame/target.hpp"
#include "gl/gl_object.hpp"

namespace gnomon::render {

/// One image of points for each map. Its texel i lies between the centres of the map's texels i and i + 1,
/// and holds a point of the outline that crosses it, or its own middle.
class Silhouettes {
 public:
  /// Finds the edges of all casters but alpha-masked ones, whose outline is none of their triangles'. Throws
  /// RenderError.
  explicit Silhouettes(const SceneBuffers& scene);
  /// True where the points of all maps are lost.
  bool fit(const MapTargets& maps);
  /// Draws the points of every map that has parts in `lists`, which must be whole. Maps whose shape bends
  /// lines get none. `scene` must be placed for maps.
  void draw(const SceneBuffers& scene, const DrawLists& lists, const MapTargets& maps, const DrawnMaps& drawn,
            int map_count) noexcept;
  /// Binds the images to the unit of stored texels, whose filters have none.
  void bind() const noexcept;
  [[nodiscard]] std::uint64_t bytes() const noexcept;
  [[nodiscard]] std::uint64_t scratch_bytes() const noexcept;

 private:
  struct EdgeRange {
    std::uint32_t first = 0, count = 0;  ///< indices
  };
  /// Adds a command for each caster of a part.
  void add_commands(const SceneBuffers& scene, const DrawLists& lists, const DrawnPart& part);

  Program program_;
  Buffer edges_, command_buffer_;
  std::size_t command_capacity_ = 0;
  std::vector<EdgeRange> edges_of_;  ///< by primitive
  std::vector<DrawCommand> commands_;
  Texture points_, depth_;
  Framebuffer fbo_;
  Sampler sampler_ = make_sampler();
  int width_ = 0, height_ = 0, layers_ = 0;
};

}  // namespace gnomon::render
