// Coloured panes before each other: a gallery whose walls and roof let light through. Tests what shadow maps
// know of light that is not stopped.
#include <array>
#include <cmath>
#include <numbers>

#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr double kWide = 1.5, kHigh = 2.4;  // metres of a pane
constexpr int kPanes = 10;                  // in a wall

/// A pane upright on y = 0, seen from +Z.
MeshBuilder pane(double wide, double high) {
  MeshBuilder out;
  out.quad({-0.5 * wide, 0.0, 0.0}, {0.5 * wide, 0.0, 0.0}, {0.5 * wide, high, 0.0},
           {-0.5 * wide, high, 0.0});
  return out;
}

MeshBuilder level_pane(double side) {
  MeshBuilder out;
  const double h = 0.5 * side;
  out.quad({-h, 0.0, h}, {h, 0.0, h}, {h, 0.0, -h}, {-h, 0.0, -h});
  return out;
}

MeshBuilder window_frame() {
  MeshBuilder out;
  const double length = kWide * kPanes;
  for (int i = 0; i <= kPanes; ++i) {
    const double x = i * kWide - 0.5 * length;
    out.box({x - 0.03, 0.0, -0.03}, {x + 0.03, 0.3 + kHigh, 0.03});
  }
  return out;
}

}  // namespace

std::string build_glass() {
  GlbWriter writer("glass");
  const int meadow = writer.material("meadow", {0.55, 0.53, 0.48}),
            steel = writer.material("steel", {0.3, 0.32, 0.34}),
            stone = writer.material("stone", {0.62, 0.60, 0.56});
  const std::array<int, 4> tints = {writer.glass_material("red glass", {0.9, 0.12, 0.08}, 0.8),
                                    writer.glass_material("green glass", {0.15, 0.8, 0.25}, 0.8),
                                    writer.glass_material("blue glass", {0.12, 0.25, 0.95}, 0.8),
                                    writer.glass_material("amber glass", {0.95, 0.65, 0.1}, 0.9)};
  const int smoke = writer.blend_material("smoke glass", {0.2, 0.2, 0.2}, 0.6);
  add_ground(writer, 48.0, 8, meadow);

  std::array<int, 4> upright{};
  for (std::size_t i = 0; i < tints.size(); ++i)
    upright[i] = writer.mesh("pane", pane(kWide - 0.06, kHigh), tints[i]);
  const int bars = writer.mesh("frame", window_frame(), steel);
  // Walls behind each other, so that light from the side passes one, two or three of them.
  for (int wall = 0; wall < 3; ++wall) {
    const double z = 3.0 - 2.5 * wall;
    writer.node(bars, placed({0.0, 0.0, z}));
    for (int i = 0; i < kPanes; ++i) {
      const double x = (i + 0.5) * kWide - 0.5 * kWide * kPanes;
      writer.node(upright[static_cast<std::size_t>((i + wall) % 4)], placed({x, 0.3, z}));
    }
  }
  const int roof = writer.mesh("roof pane", level_pane(2.4), smoke);
  for (int i = 0; i < 6; ++i) writer.node(roof, placed({-6.25 + 2.5 * i, 3.4, -4.0}));
  MeshBuilder block, pillar;
  block.box({-0.4, 0.0, -0.4}, {0.4, 0.9, 0.4});
  pillar.cylinder({0.0, 0.0, 0.0}, {0.0, 3.3, 0.0}, 0.12, 0.1, 16);
  const int seat = writer.mesh("block", block, stone), column = writer.mesh("pillar", pillar, stone);
  for (int i = 0; i < 7; ++i) {
    writer.node(seat, placed({-6.0 + 2.0 * i, 0.0, 1.7 - 2.4 * (i % 3)}, 0.3 * i));
    writer.node(column, placed({-7.5 + 2.5 * i, 0.0, -5.4}));
  }
  return writer.glb();
}

}  // namespace gnomon::detail
