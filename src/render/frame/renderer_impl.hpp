// The parts a Renderer is made of.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "casters/draw_list.hpp"
#include "casters/moving_casters.hpp"
#include "casters/scene_buffers.hpp"
#include "filter/stored_maps.hpp"
#include "filter/stored_pages.hpp"
#include "frame/frame_block.hpp"
#include "frame/mask_history.hpp"
#include "frame/pane_pass.hpp"
#include "frame/target.hpp"
#include "gl/gl_object.hpp"
#include "gl/pass_timer.hpp"
#include "gnomon/render/renderer.hpp"
#include "maps/depth_peel.hpp"
#include "maps/layered_maps.hpp"
#include "maps/silhouettes.hpp"
#include "source/identifier_pass.hpp"
#include "source/light_pass.hpp"
#include "source/page_pool.hpp"
#include "source/pixel_lists.hpp"

namespace gnomon::render {

/// Programs that no filter takes part in.
struct CommonPrograms {
  Program depth, depth_masked, depth_even, depth_even_masked, copy_depth, surfaces, shade, aliasing, heat,
      tint;
  CommonPrograms();
};

/// A pass over the pixels that looks maps up: compiled for linear maps by the first use, and once more by the
/// first frame whose maps have another shape. Software renderers run the places of all shapes.
class MapPass {
 public:
  explicit MapPass(ShaderName shader) : shader_(std::move(shader)) {}
  void prepare(bool shaped);
  [[nodiscard]] const Program& program(bool shaped) const noexcept {
    return shaped && shaped_ ? shaped_ : linear_;
  }

 private:
  ShaderName shader_;
  Program linear_, shaped_;
};

/// Programs for maps whose shape bends lines: compiled with the first such map.
struct BentPrograms {
  Program opaque, masked;
  BentPrograms();
};

/// Programs that draw casters, and where they take what differs from batch to batch.
struct CasterPrograms {
  const Program& opaque;
  const Program& masked;
  GLint wrap_location = -1;  ///< of the mask's image; -1: its sampler says it
  bool apart = false;        ///< sheets, solids and mirrored ones in draws of their own
};

/// How the casters of a frame become the depths of its maps.
struct DepthDraw {
  bool alpha_test_where_masked = true;
  DepthLayer layer = DepthLayer::front;
  double dual_limit_texels = 0.0;
  float even_scale = 0.0f;  ///< DrawnMap::even_scale of the map that is drawn
  /// The same for one map.
  [[nodiscard]] DepthDraw of(const DrawnMap& map) const noexcept;
  /// What a peeled map of the plan stores.
  [[nodiscard]] PeeledDepth peeled(const ShadowPlan& plan, const ShadowMap& map) const noexcept;
};

[[nodiscard]] DepthDraw depth_draw(const FrameOptions& options) noexcept;

struct Renderer::Impl {
  explicit Impl(const Scene& scene);

  void fit_maps(const ShadowPlan& plan);
  /// Makes both blocks those that all shaders read.
  void upload(const FrameBlock& frame, const FilterBlock& filtering) noexcept;
  /// Positions of the scene near the camera and near the maps' origin; matrices of the plan's maps from
  /// there.
  [[nodiscard]] DrawnMaps place_scene(const ShadowPlan& plan, const glm::dvec3& camera_world);
  /// Adds what the caller says has moved; casters are culled by where they are now.
  void take_moved(std::span<const Box> moved_world);
  /// The caches hold nothing any more, so that nothing that moved matters.
  void forget_moved() noexcept;
  /// Whether static casters have depths of their own in this frame.
  [[nodiscard]] bool tells_apart(const FrameOptions& options) const noexcept;
  /// By instance, 1 where it moves; nothing where no caster is drawn apart.
  [[nodiscard]] std::span<const std::uint8_t> moves(const FrameOptions& options) const noexcept;
  void move(std::size_t instance, const Instance& to);
  void draw_map_part(const DrawnPart& part, const DrawnMap& map, const DepthDraw& how) noexcept;
  void draw_casters(const DrawnPart& part, const glm::mat4& clip_from_position,
                    const DepthDraw& how) noexcept;
  /// Culls the faces that the layer does not store; `mirrored`: is_mirrored() of what `set_place` sets.
  template <class SetPlace>
  void draw_layer(const DrawnPart& part, const CasterPrograms& by, bool mirrored, const DepthDraw& how,
                  SetPlace&& set_place) noexcept;
  /// The maps that the draw lists joined, in one pass.
  void draw_layered_maps(const DrawnMaps& drawn, const DepthDraw& how) noexcept;
  /// What the context and the options allow; compiles the programs with the first frame that needs them.
  [[nodiscard]] LayeredRule layered_rule(const FrameOptions& options) noexcept;
  /// Into a map whose shape bends lines: the first surface, whatever the layer.
  void draw_bent_casters(const DrawnPart& part, const DrawnMap& map, bool alpha_test_where_masked) noexcept;
  /// Draws what lies behind the first surface, which DepthPeel::begin() took.
  void draw_casters_behind(const DrawnPart& part, const glm::mat4& clip_from_position,
                           const DepthDraw& how) noexcept;
  /// From the first surface, which the texels hold, to what the layer stores.
  void peel(const DrawnPart& part, const TexelRect& at, int layer, const glm::mat4& clip_from_position,
            const DepthDraw& how, const PeeledDepth& depth) noexcept;
  /// `set_place` sets the uniforms that say where casters go, of the program that is in use; `set_batch`,
  /// with CasterPrograms::apart, what differs between sheets, solids and mirrored ones.
  template <class SetPlace, class SetBatch>
  void draw_casters(const DrawnPart& part, const CasterPrograms& by, bool alpha_test_where_masked,
                    SetPlace&& set_place, SetBatch&& set_batch) noexcept;
  /// Takes the layer for the next maps; those of another one are not reused.
  void take_layer(DepthLayer layer, double dual_limit_texels, bool linear = false) noexcept;
  /// Makes room for the outlines that the filter reads. Maps drawn without them are not reused.
  void take_silhouettes(const FilterSettings& settings);
  /// Compiles the filter's programs for maps that are not linear, with the first frame that has one.
  void take_shapes(const ShadowPlan& plan, const PreparedFilter& filter, bool accumulated) noexcept;
  /// The frame with exact shadows: pixels are listed, and casters are tested against them.
  FrameStats draw_irregular(const ShadowPlan& plan, const Camera& camera, const PreparedFilter& filter,
                            const FrameOptions& options) noexcept;
  void draw_casters_on_lists(const ShadowPlan& plan, bool alpha_test_where_masked) noexcept;
  /// Whether the frame's shadows are found by identifiers.
  [[nodiscard]] bool takes_identifiers(const ShadowPlan& plan, const PreparedFilter& filter) const noexcept;
  /// Takes what the next maps number; those that number something else are not reused.
  void take_identifiers(std::optional<IdentifierOf> of) noexcept;
  /// The frame with shadows by identifiers.
  FrameStats draw_identified(const ShadowPlan& plan, const Camera& camera, const PreparedFilter& filter,
                             const FrameOptions& options) noexcept;
  void draw_identified_maps(const DrawnMaps& drawn, bool alpha_test_where_masked) noexcept;
  void draw_identified_casters(const DrawnPart& part, const glm::mat4& clip_from_position,
                               bool alpha_test_where_masked) noexcept;
  /// The pictures that are drawn once the mask is there.
  void draw_pictures(const PassTimer& timed, const FrameOptions& options,
                     const std::function<void()>& shade) noexcept;
  /// Of the draw lists; peeled maps draw them twice.
  [[nodiscard]] MapStats work_of_map(int map) const noexcept;
  /// What the draw lists of this plan held.
  void count_work(const ShadowPlan& plan, FrameStats& stats) const noexcept;
  /// The same of pages, with what their images take.
  void count_pages(const PagePlan& plan, FrameStats& stats) const noexcept;
  void draw_shadow_maps(const ShadowPlan& plan, const DrawnMaps& drawn, const DepthDraw& how) noexcept;
  /// Brings the maps of static casters up to date; whole copies go to the maps of all casters.
  void draw_static_maps(const DrawnMaps& drawn, const DepthDraw& how) noexcept;
  /// Draws static depths into the layer that is attached; the viewport is left as it is here.
  void copy_static(const DrawLists::Copies& copies, int layer, glm::ivec2 viewport) noexcept;
  /// `block`: with the options that the filter chooses for each map, on return.
  void prefilter(const ShadowPlan& plan, const PreparedFilter& filter, FilterBlock& block,
                 bool unread_tiles) noexcept;
  /// Whether a pass over the pixels costs less than what it saves.
  [[nodiscard]] bool pays_to_mark(const FilterPrograms& filter, bool unread_tiles) const noexcept;
  /// For maps whose depths are not those of the last frame; the others keep what was chosen then.
  void adapt_filter(const FilterSettings& settings, FilterBlock& block) noexcept;
  /// Of the last frame's map, row by row.
  void read_depths(int map, std::span<float> depths) const noexcept;
  /// `of_light`: the plan that says how the light's depths run; `block_side`: texels of a PageBlock.
  void draw_pages(const ShadowPlan& of_light, const DepthDraw& how, int block_side) noexcept;
  /// Runs [first, last) of the pool, each into a layer of the stage, and from there into the pool.
  void draw_page_runs(std::size_t first, std::size_t last, const DepthDraw& how) noexcept;
  /// Each page by itself, into its slot: what lies behind its first surface is found there.
  void draw_each_page(const ShadowPlan& of_light, const DepthDraw& how) noexcept;
  /// Maps of lights that are due, or all where the pool lost them, to be drawn into the pool.
  void list_pool_maps(const LightPlan& plan, std::span<const DrawnLight> lights,
                      const glm::dvec3& camera_world, FrameStats& stats);
  void draw_pool_maps(std::span<const DrawnLight> lights, const DepthDraw& how) noexcept;
  /// The sum of all lights: in one pass by clusters, else by a mask for each.
  void add_lights(const LightPlan& plan, std::span<const DrawnLight> lights, const Camera& camera,
                  const PreparedFilter& filter, const FrameOptions& options) noexcept;
  /// False, with nothing drawn, where lists cannot be made or are not wanted.
  [[nodiscard]] bool add_clustered_lights(const LightPlan& plan, std::span<const DrawnLight> lights,
                                          const Camera& camera, const PreparedFilter& filter,
                                          const FrameOptions& options);
  /// Adds one light to the sum, through a mask of its own; `tinted`: panes colour it.
  void add_light(const LightMaps& maps, const DrawnLight& light, bool tinted, const Camera& camera,
                 const PreparedFilter& filter, const FrameOptions& options);
  /// Finds the lights that panes tint.
  void mark_tinted(const LightPlan& plan, std::span<const DrawnLight> lights, const Camera& camera);
  /// The picture from that sum, behind panes.
  void draw_sum_of_lights(const Camera& camera, std::span<const DrawnLight> lights,
                          const FrameOptions& options);
  /// `program` writes at least what programs.surfaces writes.
  void draw_surfaces(GLuint fbo, const Program& program) noexcept;
  void draw_mask(const Program& program, GLuint fbo, bool from_pages = false) noexcept;
  void draw_contacts(const ShadowPlan& plan, const FilterSettings& settings, GLuint fbo) noexcept;
  void draw_accumulated(const Camera& camera, const FrameOptions& options, const FrameBlock& block) noexcept;
  /// Makes the noise tile at the first frame that reads it.
  void bind_noise(SampleNoise noise) noexcept;
  /// The picture; with panes, in the light that they leave, and behind them.
  void draw_shade(const FrameBlock& block, const glm::dvec3& camera_world);
  /// What the panes leave of the light at each pixel, once the mask is there. `drawn`: of the plan's maps.
  void draw_transmittance(const ShadowPlan& plan, const DrawnMaps& drawn, const Camera& camera,
                          const FrameOptions& options, FrameStats& stats);
  /// The same for a part of the image.
  void draw_transmittance(const ShadowPlan& plan, const DrawnMaps& drawn, const Camera& camera,
                          const TexelRect& part, const PanePass::MapDraw& how);
  /// The same from pages. `origin_world`: that casters are drawn from.
  void draw_transmittance(const PagePlan& plan, const glm::dvec3& origin_world, const Camera& camera);
  /// The same exactly, once the pixels are listed.
  void draw_listed_transmittance(const ShadowPlan& plan, const Camera& camera);
  void draw_aliasing() noexcept;
  void draw_heat_map() noexcept;
  void draw_cascade_tint() noexcept;
  [[nodiscard]] const Framebuffer& framebuffer_of(Picture picture) const noexcept;
  /// The images of the surfaces pass, for shaders that read them.
  void bind_surfaces() const noexcept;
  /// Draws over all of `fbo` with `program`; the images of the surfaces pass are bound.
  void fullscreen(GLuint fbo, const Program& program) const noexcept;

  SceneBuffers scene;
  DrawLists lists;
  CommonPrograms programs;
  std::optional<BentPrograms> bent;  ///< none until a map needs them, and where the context was lost by then
  std::optional<LayeredPrograms> layered;    ///< likewise
  bool can_layer = false, software = false;  ///< of the context
  std::vector<FilterPrograms> filter_programs;
  StoredMaps stored;
  FrameTargets targets;
  MaskHistory history;
  Texture noise_tile;  ///< blue noise
  MapTargets maps;
  DepthPeel depth_peel;
  DepthLayer drawn_layer = DepthLayer::front;     ///< that maps and pages hold
  double drawn_limit_texels = 0.0;                ///< the same, of DepthLayer::dual
  bool drawn_linear = false;                      ///< their depths are even along the light
  std::optional<IdentifierOf> drawn_identifiers;  ///< that the last frame's maps hold
  std::optional<Silhouettes> silhouettes;         ///< made when a filter that reads them is first prepared
  bool drew_silhouettes = false;                  ///< into the maps that are held
  MapPass contacts{"pass/mask/contacts.frag"}, accumulate{"pass/mask/accumulate.frag"};
  bool shaped = false;  ///< a map of the frame is not linear
  PagePool pages;
  PageStage page_stage;
  StoredPages stored_pages;
  bool reads_pages = false;                   ///< a filter was prepared for them
  std::optional<LightPass> light_pass;        ///< made when many lights are first prepared
  std::optional<PanePass> panes;              ///< made by Renderer::add_panes
  std::optional<PixelLists> pixel_lists;      ///< made when they are first prepared
  std::optional<IdentifierPass> identifiers;  ///< the same
  MovingCasters movers;
  Pose posed;       ///< the last one applied; empty: none, or instances moved since
  Pose pane_posed;  ///< the same of panes
  Buffer frame_buffer, filter_buffer;
  VertexArray no_vertices;
  std::array<glm::ivec2, kMaxMaps> map_size{};  ///< of the last frame
  int map_count = 0;
  /// What the filter chose for each map from its depths, and what it was told when it did.
  struct Adapted {
    bool valid = false;
    FilterSettings told, own;
  };
  std::array<Adapted, kMaxMaps> adapted;
  int maps_read_back = 0;            ///< in the last frame
  std::array<int, 2> screen_size{};  ///< of the default framebuffer, as last shown
};

}  // namespace gnomon::render
