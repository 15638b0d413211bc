// How is a frame drawn?
#pragma once

#include <cstdint>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/light.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/options.hpp"
#include "gnomon/render/depth_layer.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {

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
/// grids move from frame to frame (motion.hpp). A moving view keeps no history where texels and kernel are as
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

/// How the maps of a plan are drawn. Every bit of their depths is the same.
///
/// Pages: `each` draws every page by itself, the others draw neighbouring pages of a level together. Pages
/// have the same bits whichever neighbours are drawn with them. From those of `each` they differ by rounding:
/// a pool keeps no page from one way to the other.
enum class MapPasses : std::uint8_t {
  each,       ///< one pass for each map
  layered,    ///< one pass for all maps of one size that are drawn whole, if the driver can (Probe::layers)
  automatic,  ///< the one expected to be faster; software drivers: each (docs/performance.md)
};

/// How one frame is drawn. No source of shadows honours all of it: FrameStats::ignored lists the options that
/// had no effect, docs/renderer.md has the table.
struct FrameOptions {
  SplitTransition transition = SplitTransition::cut;  ///< between cascades
  SampleNoise noise = SampleNoise::still;             ///< of sample patterns and of dithered transitions
  std::uint32_t frame_index = 0;                      ///< counts frames, for noise that moves; may wrap round
  Accumulation accumulation{};                        ///< of the mask over frames
  /// The surface whose depth the maps store. A frame with another one than the last frame's draws all maps.
  DepthLayer depth_layer = DepthLayer::front;
  /// DepthLayer::dual: the farthest that it stores behind the first surface, in texels at the centre of the
  /// map's body, >= 0. Larger: less acne, wider gaps at contacts.
  double dual_limit_texels = 4.0;
  /// Maps store depths that grow evenly along each ray of the light, under local lights and warps too. They
  /// are z of clip space without the division by w, over its largest in the map. A float then has
  /// the same steps near the light and far from it. Casters write their depth in the fragment shader, which
  /// takes longer. Maps that bend lines have divided depths where w grows more than 64 times across them. In
  /// z alone, rounding would show as false shadow there. Based on: Brabec, Annen, Seidel, "Practical Shadow
  /// Mapping", 2002; Martin, Tan, "Anti-aliasing and Continuity with Trapezoidal Shadow Maps", 2004.
  bool linear_depth = false;
  /// How maps of a ShadowPlan are drawn. Maps of which only parts are drawn have a pass of their own in any
  /// case. So have maps that are peeled, bend lines, or have linear depths. Pages that are peeled are
  /// drawn by themselves, and with `each` PruneRule::static_casters has no effect on pages.
  MapPasses map_passes = MapPasses::automatic;
  /// Filters compare each texel with the receiver's plane at that texel. False: with the receiver's own
  /// depth, as look-ups without the plane do; BiasOptions must then cover the slope over the whole kernel.
  bool receiver_plane = true;
  /// The spot or point light at whose cone and range the picture fades out; the mask is the plan's alone. It
  /// says where the light of a plan without maps is. nullptr: none.
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
  /// Clusters of the image, each with a list of the lights that reach it. With a tile_pixels of 0 every light
  /// has passes of its own, as where the driver has no storage buffers in fragment shaders.
  ClusterOptions light_clusters{};
  /// Bounds of casters that the caller says have changed since the last frame, where they were and where they
  /// are, world space. Cached maps and pages are drawn again where a box reaches them. Instances moved by
  /// Renderer::move_instance and Renderer::apply_pose are known already.
  std::span<const Box> moved_world = {};
};

}  // namespace gnomon::render
