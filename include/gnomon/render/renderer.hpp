// Draws a scene with the shadow maps of a plan, and measures them pixel by pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/bias.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/light_clusters.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/prune.hpp"
#include "gnomon/render/depth_layer.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/filter_fit.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::render {

/// The passes of a frame, in the order of reports. Surfaces are drawn before prefilter, which looks at them.
enum class Pass : std::uint8_t {
  shadow_maps,
  prefilter,
  surfaces,
  mask,
  accumulate,
  shade,
  aliasing,
  heat_map,
  cascade_tint,
  panes
};
inline constexpr std::size_t kPassCount = 10;
[[nodiscard]] std::string_view to_string(Pass pass) noexcept;

/// The things that Renderer::prepare_identifiers numbers.
enum class IdentifierOf : std::uint8_t {
  instance,  ///< instances of the scene: nothing of an instance shadows another part of it
  triangle,  ///< triangles of instances
};

/// A shadow test by who is nearest to the light, in place of how near: no depth is compared, and no bias is
/// needed. Based on: Hourcade, Nicolas, "Algorithms for Antialiased Cast Shadows", 1985.
struct IdentifierTest {
  IdentifierOf of = IdentifierOf::instance;  ///< what a map's texel names
  /// A surface is lit where its texel holds its own identifier, or one at most so many texels to either side
  /// does, 0..kMostIdentifierNeighbours. Larger: less false shadow where a texel shows several triangles, and
  /// shadows that shrink by as many texels.
  int neighbours = 0;
};
inline constexpr int kMostIdentifierNeighbours = 4;  ///< of IdentifierTest::neighbours

/// A filter whose program is compiled; only Renderer::prepare and its relatives make one.
struct PreparedFilter {
  FilterSettings settings;  ///< that the program is compiled for
  std::size_t program = 0;  ///< index within the renderer
  bool irregular = false;   ///< exact shadows by lists of pixels: Renderer::prepare_irregular
  int samples = 1;          ///< of a pixel, where `irregular`
  std::optional<IdentifierTest> identifiers = {};  ///< shadows by them: Renderer::prepare_identifiers
};

/// Most samples of a pixel that Renderer::prepare_irregular takes: a list has 16 bytes for each.
inline constexpr int kMostFacetSamples = 64;

/// Transition between cascades, over the blend band ShadowMap::overlap (SplitOptions::overlap).
enum class SplitTransition : std::uint8_t {
  cut,     ///< at the split
  blend,   ///< both maps are read and mixed: twice the reads over the transition
  dither,  ///< either map, by a noise from pixel to pixel
};

/// Noise that turns the sample patterns of filters and dithers between maps, from pixel to pixel.
enum class SampleNoise : std::uint8_t {
  still,     ///< interleaved gradient noise, the same in every frame
  gradient,  ///< the same noise, moved from frame to frame
  blue,      ///< blue noise over tiles of 64 x 64 pixels, other values in every frame
};

/// Accumulates the mask over frames by re-projection: hard edges converge to the exact ones where the maps'
/// grids move from frame to frame (jitter.hpp). A moving view keeps no history where texels and kernel are as
/// small as a pixel. A pixel's history restarts where the box of a caster that moved shadows it, before or
/// after the move (move_instance(), apply_pose(), FrameOptions::moved_world). The light must be at rest: set
/// `restart` in the first frame after it moved, and after a cut.
struct Accumulation {
  bool on = false;  ///< off: each frame's mask is its own
  /// The weight of a frame's result is its confidence to this power, 0..64. The confidence falls from 1 at a
  /// texel's centre to 0 at its border. Larger: sharper edges from more frames. 0: all frames count alike,
  /// for filters whose samples turn with the noise.
  double confidence_power = 4.0;
  /// Frames that the history counts as at most, 1..4096. Larger: less noise and slower changes.
  double memory = 64.0;
  /// The history of a pixel is rejected where its view depth is off that of the surface's plane by more than
  /// this share, 0..1.
  double depth_tolerance = 0.01;
  bool restart = false;  ///< forgets the history
};

/// Bytes beside each texel of a map that panes take (Renderer::add_panes).
inline constexpr double kPaneTexelBytes = 40.0;

/// How the maps of a plan are drawn. Every bit of their depths is the same.
///
/// Pages: `each` draws every page by itself, the others draw neighbouring pages of a level together. Pages
/// have the same bits whichever neighbours are drawn with them; from those of `each` they differ by rounding,
/// and a pool keeps no page from one way to the other.
enum class MapPasses : std::uint8_t {
  each,       ///< one pass for each map
  layered,    ///< one pass for all maps of one size that are drawn whole, if the driver can (Probe::layers)
  automatic,  ///< the one expected to be faster; software drivers: each (docs/performance.md)
};

/// Pictures to draw besides the lit one.
struct FrameOptions {
  SplitTransition transition = SplitTransition::cut;  ///< between cascades
  SampleNoise noise = SampleNoise::still;             ///< of sample patterns and of dithered transitions
  std::uint32_t frame_index = 0;                      ///< counts frames, for noise that moves; may wrap round
  Accumulation accumulation;                          ///< of the mask over frames
  /// The surface whose depth the maps store. A frame with another one than the last frame's draws all maps.
  /// Maps whose shape bends lines always store the first.
  DepthLayer depth_layer = DepthLayer::front;
  /// DepthLayer::dual: the farthest that it stores behind the first surface, in texels at the centre of the
  /// map's body, >= 0. Larger: less acne, wider gaps at contacts.
  double dual_limit_texels = 4.0;
  /// Maps store depths that grow evenly along each ray of the light, under local lights and warps too: z of
  /// clip space without the division by w, over its largest in the map (even_depth_scale). A float then has
  /// the same steps near the light and far from it. Casters write their depth in the fragment shader, which
  /// takes longer. Frames of pages and of many lights, and shadows by identifiers, store depths divided by w.
  /// Based on: Brabec, Annen, Seidel, "Practical Shadow Mapping", 2002; Martin, Tan, "Anti-aliasing and
  /// Continuity with Trapezoidal Shadow Maps", 2004.
  bool linear_depth = false;
  /// How maps of a ShadowPlan are drawn. Maps of which only parts are drawn, that are peeled, whose shape
  /// bends lines, or whose depths are linear have a pass of their own in any case. Pages that are peeled are
  /// drawn by themselves, and with `each` PruneRule::static_casters has no effect on pages.
  MapPasses map_passes = MapPasses::automatic;
  /// Filters compare each texel with the receiver's plane at that texel. False: with the receiver's own
  /// depth, as look-ups without the plane do; BiasOptions must then cover the slope over the whole kernel.
  bool receiver_plane = true;
  /// The spot or point light at whose cone and range the picture fades out; the mask is the plan's alone.
  /// nullptr: none.
  const Light* light = nullptr;
  bool aliasing = true;      ///< the error per pixel
  bool heat_map = true;      ///< the same as colours; needs `aliasing`
  bool cascade_tint = true;  ///< the picture tinted by map
  /// Waits for each pass to end and takes its wall-clock time. Costs the overlap of passes.
  bool time_passes = true;
  /// Work that may be omitted; rules that the plan applies have no effect here. Maps are cached for the next
  /// frame in any case.
  PruneRules prune = default_prune_rules();
  /// PruneRule::small_casters: the most texels of a map, as a share of all, that omitted casters may cover,
  /// 0..1. Larger: fewer draws, and small shadows disappear.
  double lost_shadow_share = 1e-4;
  /// Frames of many lights: clusters of the image, each with a list of the lights that reach it. With a
  /// tile_pixels of 0 every light has passes of its own, as where the driver has no storage buffers in
  /// fragment shaders.
  ClusterOptions light_clusters;
  /// Bounds of casters that the caller says have changed since the last frame, where they were and where they
  /// are, world space. Cached maps and pages are drawn again where a box reaches them. Instances moved by
  /// Renderer::move_instance and Renderer::apply_pose are known already.
  std::span<const Box> moved_world = {};
};

/// Work of one map, or of the surfaces pass, in one frame.
struct MapStats {
  std::uint32_t instances = 0;  ///< drawn into this map, after culling
  std::uint32_t draws = 0;      ///< draw commands: runs of instances of one primitive
  std::uint64_t triangles = 0;  ///< drawn
  std::uint64_t texels = 0;     ///< rasterized into: width times height; of cached maps, those redrawn
  std::uint64_t copied = 0;     ///< texels copied from static casters' depths (PruneRule::static_casters)
  bool held = false;            ///< cached: nothing drawn, nothing filtered
  bool scrolled = false;        ///< moved by whole texels and drawn where it was not in the map before
  int age = 0;                  ///< frames since all of it was drawn
};

/// Work of one frame.
struct FrameStats {
  std::array<double, kPassCount> milliseconds{};  ///< by Pass; 0 where not drawn or not timed
  /// The time of one pass, milliseconds.
  [[nodiscard]] double ms(Pass pass) const noexcept { return milliseconds[static_cast<std::size_t>(pass)]; }
  /// The time of shadows after their plan: maps, prefilter and look-up, milliseconds.
  [[nodiscard]] double shadow_ms() const noexcept {
    return ms(Pass::shadow_maps) + ms(Pass::prefilter) + ms(Pass::mask);
  }
  std::array<MapStats, kMaxMaps> map{};              ///< by index of the map in the plan
  int map_count = 0;                                 ///< entries of `map` that are used
  MapStats camera;                                   ///< the surfaces pass; its texels are pixels
  std::uint64_t texels = 0;                          ///< over all maps
  std::array<PruneSaving, kPruneRuleCount> saved{};  ///< by PruneRule, the plan's own included
  int layered_maps = 0;                              ///< drawn in one pass (MapPasses)
  std::uint32_t layered_draws = 0;  ///< draw commands of that pass; MapStats::draws are those without it
  int prefilter_passes = 0;         ///< over all maps: what the filter stores, blurs, sums and shrinks
  /// Texels that the filter stored and blurred, in whole tiles; needs FrameOptions::time_passes, else 0.
  std::uint64_t filtered_texels = 0;
  bool irregular =
      false;  ///< the mask is exact; false after prepare_irregular: the frame was too large for lists
  bool identified = false;  ///< the mask is by identifiers; false after prepare_identifiers: maps are bent
  int maps_read_back = 0;   ///< by filters that choose for each map from its depths
  int pages = 0;            ///< resident, of a PagePlan
  int lights_drawn = 0;     ///< of a LightPlan: lights whose maps were drawn; the pool kept those of others
  int lights_tinted = 0;    ///< of a LightPlan: lights that panes tint, each added by a pass of its own
  int pages_drawn = 0;      ///< of them; the others were kept from earlier frames (PruneRule::held_maps)
  int pages_composed = 0;   ///< of pages_drawn: only moving casters drawn (PruneRule::static_casters)
  std::uint64_t pane_texels = 0;  ///< of pane maps and pages: cleared and drawn; the others were kept
  /// Depth maps and everything that the filter keeps besides for its look-ups.
  std::uint64_t map_bytes = 0;
  /// Used while maps are filtered, free for other passes after that: images of one layer, lists of tiles.
  std::uint64_t scratch_bytes = 0;
};

/// One light of Renderer::draw for many lights.
struct DrawnLight {
  Light light;  ///< the picture fades out at its cone and range
  /// The plan its maps were drawn by last: this frame's where they are due. nullptr, or no maps: no shadow.
  const ShadowPlan* plan = nullptr;
  glm::vec3 color{1.0f};  ///< brightness by channel, >= 0; 1: as bright as the sun of other frames
};

/// Holds a scene on the GPU and the images of the last frame drawn. The context it was made in must be
/// current in every call and at destruction.
class Renderer {
 public:
  /// Uploads the scene and compiles the programs. Throws RenderError.
  explicit Renderer(const Scene& scene);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Compiles the filter's programs, once. Throws RenderError with shader file and line.
  [[nodiscard]] PreparedFilter prepare(const FilterSettings& settings);
  /// The same with the filter's default settings.
  [[nodiscard]] PreparedFilter prepare(const Filter& filter) { return prepare(default_settings(filter)); }

  /// Draws one frame at camera.width x camera.height. The plan must be one of this camera and of this scene's
  /// boxes (Scene::instances' bounds_world as casters). A plan without maps leaves everything lit. Images are
  /// reallocated when the frame or the maps grow.
  FrameStats draw(const ShadowPlan& plan, const Camera& camera, const PreparedFilter& filter,
                  const FrameOptions& options = {}) noexcept;

  /// Panes that colour the light which passes them (split_translucent): frames draw maps of what they absorb
  /// beside the shadow maps, multiply the light with what is left of it, and show the panes before the
  /// picture. The renderer's scene is then the opaque part; plans take both parts' boxes as casters. Surfaces
  /// behind all panes, or among two, get the product of what is before them; among more, the middle of what
  /// moments allow. With exact shadows (prepare_irregular) all are exact. Panes move by move_pane() and
  /// apply_pane_pose() alone. Maps whose shape bends lines have no panes, but for exact shadows. With many
  /// lights, each that panes tint draws its pane maps in every frame, in a mask pass of its own
  /// (FrameStats::lights_tinted, Pass::mask). A scene without instances takes them away. Throws RenderError.
  /// Costs kPaneTexelBytes for each texel of the maps, or of the pages that panes reach, these at most 256
  /// MiB; with exact shadows 12 for each sample instead. Where memory does not take them, nothing is tinted.
  void add_panes(const Scene& panes);
  /// Places an instance of the panes elsewhere, as move_instance() does. Pane maps that are the last frame's
  /// (the same texels and light) are drawn where it was and where it is alone, with the bits of a whole
  /// drawing, where FrameOptions::prune has PruneRule::held_maps. False where there is no such instance or
  /// its bounds are empty.
  bool move_pane(std::size_t instance, const Instance& to);
  /// The same for all panes, as apply_pose() does: pose_of_part() of a pose of the whole scene.
  bool apply_pane_pose(const Pose& pose);
  /// Channels "r", "g", "b" of the last frame with panes: the share of the light that passes them, 0..1. With
  /// many lights: that of the last one that panes tint, where it lights, and 1 where panes tint none.
  [[nodiscard]] FloatImage transmittance() const;

  /// Exact hard shadows in place of a filter: an irregular z-buffer. The pixels of a frame are listed by the
  /// texels of the plan's maps, and each caster's triangle is tested against the pixels of the texels that it
  /// touches. The maps only sort: any plan has the same mask, and no depth map is drawn. Alpha-masked casters
  /// are tested by the finest level of their image. A frame with more pixels than the driver's storage
  /// buffers hold is drawn by `filters::hard` (FrameStats::irregular). Pass::mask is the time of listing,
  /// Pass::shadow_maps that of the casters. No blending between maps, no accumulation. Throws RenderError
  /// where the driver has no storage buffers in fragment shaders.
  /// `samples`, 1..kMostFacetSamples, others the nearest of these: 1 has the edges of one point per pixel;
  /// with more the mask is the share of light on the facet that the pixel shows, for as many times the memory
  /// and work. Based on: Pan et al., "Fast, Sub-pixel Antialiased Shadow Maps", 2009.
  [[nodiscard]] PreparedFilter prepare_irregular(int samples = 1);
  /// Pixels in each list of the last such frame, in no order; lists without pixels are skipped. Reads them
  /// back; throws RenderError as image().
  [[nodiscard]] std::vector<std::uint32_t> list_lengths() const;

  /// Hard shadows by identifiers in place of depths: maps hold the number of the caster that the light sees
  /// first, and a surface is lit where that is its own. FrameOptions::depth_layer has no effect, and
  /// BiasOptions but for the normal offset has none. A frame whose maps have a shape that bends lines is
  /// drawn by `filters::hard` (FrameStats::identified). Frames of pages and of many lights do not take it; no
  /// accumulation. Maps that change are drawn whole. Costs 4 bytes for each texel more. Throws
  /// RenderError where the driver has no storage buffers in fragment shaders.
  [[nodiscard]] PreparedFilter prepare_identifiers(const IdentifierTest& test = {});

  /// Compiles the filter's programs for pages, once. Throws RenderError as prepare, and with the words of
  /// page_filter_refusal. Filters that store texels do so within each page's slot, once for each drawing.
  [[nodiscard]] PreparedFilter prepare_pages(const FilterSettings& settings);
  /// Places an instance elsewhere: `to.world_from_object`, `to.mirrored` and `to.bounds_world`; its primitive
  /// stays. Plans must be given its new bounds. False where there is no such instance or its bounds are
  /// empty.
  bool move_instance(std::size_t instance, const Instance& to);
  /// Places instances and vertices as posed (pose()), by move_instance() where they differ from the last
  /// pose. Plans must be given the new bounds. The next frames are those of a renderer of the posed scene
  /// (apply_pose()), bit for bit as long as the scene's diagonal does not pass a power of two. False, and
  /// nothing moved, where the pose names instances or vertices that the scene does not have.
  bool apply_pose(const Pose& pose);
  /// The same frame with the pages of a plan: each is drawn with its own casters into a pool. Pages that the
  /// pool holds from earlier frames are not drawn again where `options.prune` has PruneRule::held_maps
  /// (keep_pages); a frame with maps empties the pool. `filter` must come from prepare_pages, and the plan's
  /// border must hold its kernel (set_margin). The mask's channel "map" is the index of the page. No picture
  /// of the error or of maps is drawn; FrameStats::map[0] is the sum over all pages.
  FrameStats draw(const PagePlan& plan, const Camera& camera, const PreparedFilter& filter,
                  const FrameOptions& options = {}) noexcept;

  /// Compiles the filter's program for many lights, once. Throws RenderError as prepare_pages.
  [[nodiscard]] PreparedFilter prepare_lights(const FilterSettings& settings);
  /// Draws the picture of many lights. Maps of due lights are drawn into their places in one pool, those of
  /// the others stay. Then one pass over the image adds up the light of those that reach a pixel's cluster
  /// (cluster_lights, FrameOptions::light_clusters), each through its shadow. Lights without a receiver in
  /// view, and local lights whose range is not above 0, are skipped. A pool whose texels are lost (other
  /// frames in between, another size or depth layer) is drawn whole.
  ///
  /// `lights`: one for each light of the plan; fewer are drawn as far as they go. `filter` must come from
  /// prepare_lights, and the plans' border must hold its kernel (set_margin). Maps of other shapes than
  /// linear, or more than the light has places, count as none. No accumulation, and no picture of the error
  /// or of maps. mask() is that of the last light that reaches the pixel. Pass::mask is the time of masks and
  /// light together, FrameStats::map[0] the sum over all maps.
  FrameStats draw(const LightPlan& plan, std::span<const DrawnLight> lights, const Camera& camera,
                  const PreparedFilter& filter, const FrameOptions& options = {}) noexcept;
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
  /// light.
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
