// What does a map still hold from earlier frames, and what is left to draw into it?
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "casters/caster_culling.hpp"
#include "gnomon/motion.hpp"
#include "maps/dirty_texels.hpp"
#include "maps/drawn_maps.hpp"

namespace gnomon::render {

/// Casters to be drawn into a rectangle of a map, by instance: 1 or 0.
struct MapPart {
  TexelRect rectangle;
  bool clear = true;  ///< false: what the rectangle holds stays right
  std::span<const std::uint8_t> draws;
};
/// What of a map is somewhere else in it now: `kept`, where it is to go.
struct MapMove {
  int shift_x = 0, shift_y = 0;  ///< texels
  TexelRect kept;
  [[nodiscard]] bool any() const noexcept { return shift_x != 0 || shift_y != 0; }
};
/// What is to be done with a map: first what it holds is moved, then rectangles are copied from the map of
/// its static casters, then the parts are drawn. None of them: the map is as it was.
struct MapWork {
  /// Rectangles in which all casters are drawn again; each costs draws.
  static constexpr std::size_t kMaxRedrawn = DirtyTexels::kMost;
  /// Two strips or rectangles of moved casters, and what came into reach anywhere.
  static constexpr std::size_t kMaxParts = kMaxRedrawn + 1;
  MapMove move;
  std::span<const TexelRect> copies;
  std::array<MapPart, kMaxParts> part;
  std::size_t part_count = 0;
  std::uint64_t texels = 0;  ///< that drawing touches, at most
  int age = 0;               ///< frames since all of it was drawn

  [[nodiscard]] std::span<const MapPart> parts() const noexcept { return {part.data(), part_count}; }
  void add(const MapPart& of) noexcept { part[part_count++] = of; }
  [[nodiscard]] bool any() const noexcept { return move.any() || !copies.empty() || part_count > 0; }
};
/// The same where static casters may have a map of their own beneath that of all casters.
struct LayeredWork {
  bool has_beneath = false;  ///< false: there is none, and `map` is all there is to do
  /// The map beneath begins as a copy of the map of all casters.
  bool adopts = false;
  MapWork beneath;
  MapWork map;
};

/// A frame's map, and what culling left of its casters.
struct CachedDraw {
  const CullingJob& job;
  const DrawnMaps& drawn;
  std::size_t index = 0;
  std::span<const std::uint8_t> casters;
};

/// A map of the plan in the clip space that the renderer draws in, kOpenGlZeroToOne.
[[nodiscard]] ShadowMap drawn_form(const ShadowPlan& plan, std::size_t index) noexcept;

class MapCache {
 public:
  /// `culling` finds the casters of a strip; it must outlive the cache.
  MapCache(const SceneBuffers& scene, CasterCulling& culling);

  /// The maps from this index on hold nothing any more.
  void forget(std::size_t first = 0) noexcept;
  /// What to draw so that the map is as if drawn whole. Records what the map holds after that. Valid until
  /// the next call.
  [[nodiscard]] LayeredWork update(const CachedDraw& draw, PruneSavings& saved);

 private:
  struct Cached {
    bool valid = false;
    int age = 0;  ///< frames since it was drawn whole
    glm::dvec3 origin_world{0.0};
    DrawnMap drawn;
    ShadowMap map;                    ///< in the clip space that it was drawn in
    std::vector<std::uint8_t> holds;  ///< by instance
  };
  /// Brings a map up to date by the casters in draws_. `moved_world`: bounds where any of them changed.
  [[nodiscard]] MapWork bring_up(const CachedDraw& draw, std::span<const Box> moved_world, Cached& cached,
                                 PruneSavings& saved);
  /// The same with static casters beneath and moving ones on top.
  [[nodiscard]] LayeredWork compose(const CachedDraw& draw, PruneSavings& saved);
  /// Where the map beneath, which was that of all casters, changes once these move.
  [[nodiscard]] std::span<const Box> adoption_bounds(const CullingJob& job);
  /// Marks the moving casters to draw over the copies, in over_, and forgets those that copies erase. Returns
  /// how many texels they and the copies touch at most.
  double draw_over(const CachedDraw& draw, const ShadowMap& map, Cached& cached, PruneSavings& saved);
  /// Counts the static casters that would be drawn again without the rule.
  void count_static(const CachedDraw& draw, const ShadowMap& map, PruneSavings& saved);
  /// Lists the copies and what is drawn over them, and counts.
  void finish(LayeredWork& work, double texels, const ShadowMap& map, PruneSavings& saved);
  [[nodiscard]] double texels_shown(const ShadowMap& map, std::uint32_t instance) const noexcept;
  // `map`: in the clip space that it is drawn in.
  [[nodiscard]] MapWork draw_whole(const ShadowMap& map, Cached& cached);
  /// For an unchanged map: the casters that it does not hold yet.
  [[nodiscard]] MapWork hold(const ShadowMap& map, Cached& cached, PruneSavings& saved);
  /// Rectangles that are drawn anew, and the texels that move before.
  struct Parts {
    std::span<const TexelRect> rectangles;
    MapMove move;
    PruneRule rule;                 ///< that saves the others
    std::uint64_t whole_triangles;  ///< that drawing the map whole would take besides
  };
  /// Whole where that is cheaper.
  [[nodiscard]] MapWork draw_parts(const ShadowMap& map, const Parts& parts, Cached& cached,
                                   PruneSavings& saved);
  /// For an unchanged map: rectangles of moved casters, and the casters that it does not hold yet.
  [[nodiscard]] MapWork redraw(const ShadowMap& map, const DirtyTexels& dirty, Cached& cached,
                               PruneSavings& saved);
  /// Casters that a cleared rectangle is drawn with: all of the map's there.
  void fill(const ShadowMap& map, const TexelRect& rectangle, Cached& cached,
            std::vector<std::uint8_t>& draws, PruneSaving& drawn);
  /// The strips that came into the map, and casters that the rest of it does not hold yet.
  [[nodiscard]] MapWork scroll(const CullingJob& job, const ShadowMap& map, const MapReuse& moved,
                               Cached& cached, PruneSavings& saved);
  /// Removes the casters that `cached` holds from draws_. Returns how many texels the others touch at most.
  [[nodiscard]] std::uint64_t skip_held(const ShadowMap& map, Cached& cached, PruneSaving& saved);
  [[nodiscard]] bool draws_any() const noexcept;

  const SceneBuffers& scene_;
  CasterCulling& culling_;
  std::vector<std::uint8_t> draws_;  ///< of the map at hand, by instance
  std::array<std::vector<std::uint8_t>, MapWork::kMaxRedrawn> part_draws_;
  std::vector<std::uint8_t> over_;  ///< moving casters, and static ones that came into reach, by instance
  std::vector<Box> adopted_;        ///< scratch of adoption_bounds
  std::array<DirtyShapes, kMaxMaps> dirty_;
  std::vector<TexelRect> copied_;
  std::array<Cached, kMaxMaps> cached_, beneath_;  ///< of all casters, and of static ones
};

}  // namespace gnomon::render
