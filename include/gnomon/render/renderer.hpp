// Draws a scene with the shadow maps of a plan, and measures them pixel by pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/filter_fit.hpp"
#include "gnomon/render/frame_options.hpp"
#include "gnomon/render/frame_stats.hpp"
#include "gnomon/render/shadows.hpp"
#include "gnomon/render/source.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/scene.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {

/// A filter whose programs are compiled for a source; only Renderer::prepare makes one.
struct PreparedFilter {
  FilterSettings settings;  ///< that the programs are compiled for
  std::size_t program = 0;  ///< index within the renderer
  Source source;            ///< that they read
};

/// Bytes beside each texel of a map that panes take (Renderer::add_panes).
inline constexpr double kPaneTexelBytes = 40.0;

/// Holds a scene on the GPU and the images of the last frame drawn. The context it was made in must be
/// current in every call and at destruction.
class Renderer {
 public:
  /// Uploads the scene and compiles the programs. Throws RenderError.
  explicit Renderer(const Scene& scene);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Compiles the filter's programs for a source of shadows, once. Source::irregular and Source::identifiers
  /// read no filter: it draws the frames that they cannot draw. Throws RenderError with shader file and line,
  /// where the driver lacks what the source needs, and for pages and lights with page_filter_refusal.
  [[nodiscard]] PreparedFilter prepare(const FilterSettings& settings, const Source& source = Source::maps);
  /// The same with the filter's default settings.
  [[nodiscard]] PreparedFilter prepare(const Filter& filter, const Source& source = Source::maps) {
    return prepare(default_settings(filter), source);
  }

  /// Draws one frame at camera.width x camera.height, from a plan of this camera and of this scene's boxes
  /// (Scene::instances' bounds_world as casters). `filter` must come from prepare() for the plan's kind. A
  /// plan of pages or lights with another one leaves everything lit, as do plans without maps or pages. The
  /// plan's border must hold the filter's kernel (set_margin). Images are reallocated when the frame or the
  /// maps grow.
  /// FrameStats::ignored lists the options that the source of the shadows does not honour.
  ///
  /// Depths are kept from frame to frame where `options.prune` has PruneRule::held_maps: unchanged maps, and
  /// pages that the pool holds (keep_pages). A frame of another kind of plan loses them.
  ///
  /// Pages: the mask's channel "map" is the index of the page. FrameStats::map[0] is the sum over all pages.
  ///
  /// Lights: maps of due lights are drawn into their places in one pool, those of the others stay. Then one
  /// pass over the image adds up the light of those that reach a pixel's cluster (cluster_lights,
  /// FrameOptions::light_clusters), each through its shadow. Lights without a receiver in view, and local
  /// lights whose range is not above 0, are skipped. A pool whose texels are lost (other frames in between,
  /// another size or depth layer) is drawn whole. Maps whose shape bends lines, or more than the light has
  /// places, count as none. mask() is that of the last light that reaches the pixel. Pass::mask is the time
  /// of masks and light together, FrameStats::map[0] the sum over all maps.
  FrameStats draw(const Shadows& shadows, const Camera& camera, const PreparedFilter& filter,
                  const FrameOptions& options = {}) noexcept;

  /// Panes that colour the light which passes them (split_translucent). Frames draw maps of what they absorb
  /// beside the shadow maps, and multiply the light with what is left of it. The panes show before the
  /// picture. The renderer's scene is then the opaque part; plans take both parts' boxes as casters. Surfaces
  /// behind all panes, or among two, get the product of what is before them; among more, the middle of what
  /// moments allow. With exact shadows (Source::irregular) all are exact. Panes move by move_pane() and
  /// apply_pane_pose() alone. With many lights, each that panes tint draws its pane maps in every frame, in a
  /// mask pass of its own (FrameStats::lights_tinted, Pass::mask). A scene without instances takes them away.
  /// Throws RenderError.
  /// Costs kPaneTexelBytes for each texel of the maps, or of the pages that panes reach, these at most 256
  /// MiB. With exact shadows it costs 12 bytes for each sample instead. Where memory does not take them,
  /// nothing is tinted.
  void add_panes(const Scene& panes);
  /// Places an instance of the panes elsewhere, as move_instance() does. With PruneRule::held_maps in
  /// FrameOptions::prune, pane maps of the last frame's texels and light are drawn where it was and where it
  /// is alone. They have the bits of a whole drawing. False where there is no such instance or its bounds are
  /// empty.
  bool move_pane(std::size_t instance, const Instance& to);
  /// The same for all panes, as apply_pose() does: pose_of_part() of a pose of the whole scene.
  bool apply_pane_pose(const Pose& pose);
  /// Channels "r", "g", "b" of the last frame with panes: the share of the light that passes them, 0..1. With
  /// many lights: that of the last one that panes tint, where it lights, and 1 where panes tint none.
  [[nodiscard]] FloatImage transmittance() const;

  /// Pixels in each list of the last frame by Source::irregular, in no order; lists without pixels are
  /// skipped. Reads them back; throws RenderError as image().
  [[nodiscard]] std::vector<std::uint32_t> list_lengths() const;

  /// Places an instance elsewhere: `to.world_from_object`, `to.mirrored` and `to.bounds_world`; its primitive
  /// stays. Plans must be given its new bounds. False where there is no such instance or its bounds are
  /// empty.
  bool move_instance(std::size_t instance, const Instance& to);
  /// Places instances and vertices as posed (pose()), by move_instance() where they differ from the last
  /// pose. Plans must be given the new bounds. The next frames are those of a renderer of the posed scene
  /// (apply_pose()). They have the same bits as long as the diagonal round most of the scene passes no power
  /// of two. False, and nothing moved, where the pose names instances or vertices that the scene does not
  /// have.
  bool apply_pose(const Pose& pose);
  /// Channels "r", "g", "b" of the last frame of many lights: what they reflect, without sky and air, linear.
  [[nodiscard]] FloatImage light_sum() const;

  /// The last frame's pictures, rows top to bottom. They, and all that follow, throw RenderError where the
  /// driver has reset the context since.
  [[nodiscard]] Image image() const;
  /// The aliasing error as colours (heat_color).
  [[nodiscard]] Image heat_map() const;
  /// The lit picture, tinted by map.
  [[nodiscard]] Image cascade_tint() const;
  /// Channels "visibility" (1 lit .. 0 in shadow) and "map" (-1: none).
  [[nodiscard]] FloatImage mask() const;
  /// Channels "m_max", "m_s", "m_t", "map". Map -1: sky, or no map serves the point. All m 0: turned from the
  /// light, or edge-on to it within a cosine of 0.001.
  [[nodiscard]] FloatImage aliasing() const;
  /// Channels "x", "y", "z" relative to the camera, "depth" along the view.
  [[nodiscard]] FloatImage positions() const;
  /// Channels "x", "y", "z" of the triangles' normals, turned to the viewer, and "surface": 1, or 0 for sky.
  [[nodiscard]] FloatImage normals() const;
  /// Channel "depth" of one map of the last frame: 0 near the light .. 1; row 0 is texel row 0 of the map
  /// (ndc y = -1).
  [[nodiscard]] FloatImage depth_map(int map) const;
  /// The same of one page of the last frame, border included, by its index in the plan.
  [[nodiscard]] FloatImage page_depths(std::size_t page) const;
  /// Whether the last frame with pages drew this page of its plan. False: it was kept from an earlier frame,
  /// or there is none of that index.
  [[nodiscard]] bool drew_page(std::size_t page) const noexcept;
  /// The last frame's maps, which were drawn for this plan, as fit_filter wants them: reads them all back.
  [[nodiscard]] std::vector<DrawnDepths> drawn_depths(const FilterSettings& settings,
                                                      const ShadowPlan& plan) const;

  /// Which of the last frame's pictures to show in a window.
  enum class Picture : std::uint8_t { lit, heat_map, cascade_tint };
  /// Copies a picture to the default framebuffer of this size.
  void show(Picture picture, int width, int height) const noexcept;
  /// Copies a picture to the lower left corner of a framebuffer object (its OpenGL name), pixel by pixel.
  void copy(Picture picture, std::uint32_t framebuffer) const noexcept;
  /// Copies an image to the lower left corner of the default framebuffer.
  void show_overlay(const Image& image) const;
  /// The content of the default framebuffer where show() last drew: the whole picture as on screen.
  [[nodiscard]] Image screen() const;

  /// Texture names (OpenGL) of the last frame's depth array, for passes of one's own and for tests.
  [[nodiscard]] std::uint32_t depth_array() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::render
