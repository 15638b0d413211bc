// The source that a frame reads its shadows from.
#pragma once

#include <cstdint>

namespace gnomon::render {

/// The things that identifiers number.
enum class IdentifierOf : std::uint8_t {
  instance,  ///< instances of the scene: nothing of an instance shadows another part of it
  triangle,  ///< triangles of instances
};

/// A shadow test by who is nearest to the light, in place of how near: no depth is compared, and no bias is
/// needed. Based on: Hourcade, Nicolas, "Algorithms for Antialiased Cast Shadows", 1985.
struct IdentifierTest {
  IdentifierOf of = IdentifierOf::instance;  ///< what a map's texel names
  /// A surface is lit where its texel holds its own identifier, or one at most so many texels to either side
  /// does, 0..kMaxIdentifierNeighbours. Larger: less false shadow where a texel shows several triangles, and
  /// shadows that shrink by as many texels.
  int neighbours = 0;
  /// Equal in all members.
  bool operator==(const IdentifierTest&) const = default;
};
inline constexpr int kMaxIdentifierNeighbours = 4;  ///< of IdentifierTest::neighbours

/// Most samples of a pixel in Source::irregular: a list has 16 bytes for each.
inline constexpr int kMaxFacetSamples = 64;

/// The kinds of Source.
enum class SourceKind : std::uint8_t { maps, pages, lights, irregular, identifiers };

/// The source that Renderer::prepare compiles for. docs/renderer.md has a table of the options that each
/// honours.
struct Source {
  SourceKind kind = SourceKind::maps;  ///< the other members are of one kind each
  int samples = 1;                     ///< of a pixel: irregular
  IdentifierTest test;                 ///< identifiers

  static const Source maps;    ///< the depth maps of a ShadowPlan
  static const Source pages;   ///< the pages of a PagePlan; filters store texels within each page's slot
  static const Source lights;  ///< the maps of a LightPlan, in one pool; filters that store no texels
  /// Exact hard shadows: an irregular z-buffer. The pixels of a frame are listed by the texels of the plan's
  /// maps. Each caster's triangle is tested against the pixels of the texels that it touches. The maps
  /// only sort: any ShadowPlan has the same mask, and no depth map is drawn. Alpha-masked casters are tested
  /// by the finest level of their image. Pass::mask is the time of listing, Pass::shadow_maps that of the
  /// casters. A frame with more pixels than the driver's storage buffers hold is drawn from maps, by the
  /// filter that was prepared (FrameStats::irregular).
  /// `samples`, 1..kMaxFacetSamples, others the nearest of these. 1 has the edges of one point per pixel.
  /// With more the mask is the share of light on the facet that the pixel shows. Memory and work grow as
  /// they do. Based on: Pan et al., "Fast, Sub-pixel Antialiased Shadow Maps", 2009.
  [[nodiscard]] static constexpr Source irregular(int samples = 1) noexcept {
    const int most = samples < kMaxFacetSamples ? samples : kMaxFacetSamples;
    return {SourceKind::irregular, most > 1 ? most : 1, {}};
  }
  /// Hard shadows by identifiers. Maps of a ShadowPlan hold the number of the caster that the light sees
  /// first; a surface is lit where that is its own. Depth decides for one that casts no shadow. BiasOptions
  /// but for the normal offset has no effect. Maps that change are drawn whole. Costs 4 bytes for each texel
  /// more. A frame with maps whose shape bends lines is drawn from depths, by the filter that was prepared
  /// (FrameStats::identified). IdentifierTest::neighbours out of range: the nearest.
  [[nodiscard]] static constexpr Source identifiers(const IdentifierTest& test = {}) noexcept {
    constexpr int kMost = kMaxIdentifierNeighbours;
    const int most = test.neighbours < kMost ? test.neighbours : kMost;
    return {SourceKind::identifiers, 1, {test.of, most > 0 ? most : 0}};
  }
  /// Equal in all members.
  bool operator==(const Source&) const = default;
};
inline constexpr Source Source::maps{};
inline constexpr Source Source::pages{SourceKind::pages, 1, {}};
inline constexpr Source Source::lights{SourceKind::lights, 1, {}};

}  // namespace gnomon::render
