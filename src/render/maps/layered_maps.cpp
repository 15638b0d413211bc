// Which maps of a frame are drawn in one pass, and with what?
#include "maps/layered_maps.hpp"

#include "frame/target.hpp"
#include "gl/program.hpp"

namespace gnomon::render {

LayeredPrograms::LayeredPrograms()
    : opaque(make_program("pass/depth/layered.vert",
                          {"pass/depth/depth.frag", {"alpha/opaque", "depth/plain"}})),
      masked(make_program("pass/depth/layered.vert",
                          {"pass/depth/depth.frag", {"alpha/masked", "depth/plain"}})),
      fbo(depth_framebuffer()) {}

bool one_pass_is_faster(std::uint32_t draws_each, std::uint32_t draws_layered, bool software) noexcept {
  // A software driver fills the texels of one pass while it transforms the vertices of the next; in one pass
  // it cannot. Median of 48 settings: 1.16 times the time (bench_single_pass).
  if (software) return false;
  // The triangles are the same: what one pass saves are commands, and it has to save enough of them.
  return 4ull * draws_layered <= 3ull * draws_each;
}

}  // namespace gnomon::render
