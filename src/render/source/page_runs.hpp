// Which pages are drawn together, and where?
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gl/gl_object.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/pages.hpp"

namespace gnomon::render {

/// How casters are drawn into one page or run: from positions relative to an origin, into a rectangle of a
/// layer.
struct DrawnPage {
  ShadowMap map;  ///< page_map: planes for culling
  glm::mat4 clip_from_position{1.0f};
  int layer = 0;
  TexelRect place{};  ///< in the layer, border included
  std::uint32_t slot = 0;
  bool composed = false;     ///< moving casters alone are drawn, over the static ones
  bool has_beneath = false;  ///< static casters have depths of their own in this slot
};

/// A square of pages of one level. Its pages are drawn with its matrix and viewport: a page has the same bits
/// whichever of its neighbours are drawn with it.
struct PageBlock {
  std::uint32_t level = 0;
  std::int64_t column = 0, row = 0;  ///< counted as the level's pages are, over kBlockPages
  int x = 0, y = 0;                  ///< of a page in its block, texels
};
/// Pages along a side of a block. Larger blocks share more triangles, and cover more texels that no page
/// needs: 4 is slower than no blocks where pages of 128 texels lie apart.
inline constexpr int kBlockPages = 2;
[[nodiscard]] PageBlock block_of(const PagePlan& plan, const Page& page) noexcept;

/// Pages that one draw fills.
struct PageRun {
  std::size_t begin = 0, end = 0;  ///< of the pages, in the order of group_pages()
};

/// Pages of a frame, to be grouped.
struct BlockPage {
  DrawnPage drawn;
  PageBlock block;
};

/// Sorts the pages such that those of a block lie together, composed ones apart, and appends their runs.
/// `drawn`: of each run its map and matrix, and its place in the image of its block.
void group_pages(const PagePlan& plan, const glm::dvec3& origin_world, std::vector<BlockPage>& pages,
                 std::vector<PageRun>& runs, std::vector<DrawnPage>& drawn);

/// Images of blocks, into which runs are drawn before their pages are copied into the pool.
struct PageStage {
  int side = 0, layers = 0;
  Texture depth;
  Framebuffer fbo;
  /// Makes room for as many blocks of this side, texels, as are drawn at once: at most this many.
  void fit(int new_side, std::size_t blocks);
  /// Draws go to this layer.
  void attach(int layer) const noexcept;
  [[nodiscard]] std::uint64_t bytes() const noexcept;
};

}  // namespace gnomon::render
