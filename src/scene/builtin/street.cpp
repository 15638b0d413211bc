// Boxes along a street, to the numbers of the captures of engines in samples/capture: their maps can be drawn
// and held to exact rays here.
#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

std::string build_street() {
  GlbWriter writer("street");
  const int paving = writer.material("paving", {0.42, 0.41, 0.39}),
            plaster = writer.material("plaster", {0.68, 0.62, 0.52});
  // One slab from -40 to 40 and from -200 to 20, in tiles.
  constexpr int kAcross = 4, kAlong = 11;
  MeshBuilder tile;
  tile.box({0.0, -1.0, 0.0}, {80.0 / kAcross, 0.0, 220.0 / kAlong});
  const int slab = writer.mesh("slab", tile, paving);
  for (int i = 0; i < kAcross; ++i) {
    for (int k = 0; k < kAlong; ++k)
      writer.node(slab, placed({-40.0 + 80.0 / kAcross * i, 0.0, -200.0 + 220.0 / kAlong * k}));
  }
  for (int height = 2; height < 9; ++height) {
    MeshBuilder block;
    block.box({0.0, 0.0, -3.0}, {4.0, height, 0.0});
    const int house = writer.mesh("house of " + std::to_string(height), block, plaster);
    for (int i = height - 2; i < 40; i += 7)
      writer.node(house, placed({i % 2 == 0 ? -12.0 : 8.0, 0.0, -5.0 * i}));
  }
  return writer.glb();
}

}  // namespace gnomon::detail
