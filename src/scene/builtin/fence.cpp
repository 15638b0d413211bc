// Thin things before solid ones: a wire mesh fence, a picket fence, a bench, boxes and walls. Tests what a
// map texel wider than a wire does.
#include <cmath>
#include <numbers>

#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr double kPanel = 2.5;   // metres from post to post
constexpr double kHeight = 1.8;  // metres
constexpr double kWire = 0.004;  // 4 mm wire
constexpr double kMesh = 0.125;  // from wire to wire, measured along the ground

MeshBuilder wire_panel() {
  MeshBuilder out;
  const int count = static_cast<int>(std::lround(kPanel / kMesh)),
            rise = static_cast<int>(std::lround(kHeight / kMesh));
  // Two families of diagonals: each runs up until it meets the top or the end of the panel.
  for (int i = -rise; i < count; ++i) {
    const int first = std::max(i, 0), last = std::min(i + rise, count);
    if (last <= first) continue;
    const auto at = [&](int k, double z) { return glm::dvec3(k * kMesh, 0.08 + (k - i) * kMesh, z); };
    out.bar(at(first, 0.002), at(last, 0.002), kWire);
    const auto mirrored = [&](int k, double z) {
      return glm::dvec3(kPanel - k * kMesh, 0.08 + (k - i) * kMesh, z);
    };
    out.bar(mirrored(first, -0.002), mirrored(last, -0.002), kWire);
  }
  out.bar({0.0, 0.06, 0.0}, {kPanel, 0.06, 0.0}, 0.012);
  out.bar({0.0, kHeight + 0.1, 0.0}, {kPanel, kHeight + 0.1, 0.0}, 0.02);
  out.cylinder({0.0, 0.0, 0.0}, {0.0, kHeight + 0.2, 0.0}, 0.012, 0.012, 10);
  return out;
}

MeshBuilder picket_panel() {
  MeshBuilder out;
  for (int i = 0; i < 20; ++i) {
    const double x = 0.04 + i * kPanel / 20.0;
    out.box({x, 0.05, -0.009}, {x + 0.07, 1.05, 0.009});
    out.gable({x, 1.05, -0.009}, {x + 0.07, 1.05, 0.009}, 0.06);
  }
  out.box({0.0, 0.25, -0.045}, {kPanel, 0.31, -0.009});
  out.box({0.0, 0.8, -0.045}, {kPanel, 0.86, -0.009});
  return out;
}

MeshBuilder bench() {
  MeshBuilder out;
  for (int i = 0; i < 4; ++i) out.box({-0.9, 0.43, -0.25 + i * 0.12}, {0.9, 0.46, -0.15 + i * 0.12});
  for (int i = 0; i < 3; ++i) out.box({-0.9, 0.56 + i * 0.13, -0.3}, {0.9, 0.66 + i * 0.13, -0.27});
  for (const double x : {-0.75, 0.75}) {
    out.bar({x, 0.0, 0.18}, {x, 0.43, 0.18}, 0.05);
    out.bar({x, 0.0, -0.24}, {x, 0.95, -0.33}, 0.05);
    out.bar({x, 0.4, -0.24}, {x, 0.4, 0.2}, 0.04);
  }
  return out;
}

MeshBuilder lamp() {
  MeshBuilder out;
  out.cylinder({0.0, 0.0, 0.0}, {0.0, 0.3, 0.0}, 0.09, 0.06, 12);
  out.cylinder({0.0, 0.3, 0.0}, {0.0, 3.4, 0.0}, 0.035, 0.03, 12);
  out.bar({0.0, 3.35, 0.0}, {0.7, 3.5, 0.0}, 0.03);
  out.cylinder({0.7, 3.35, 0.0}, {0.7, 3.5, 0.0}, 0.16, 0.03, 12);
  return out;
}

void add_fences(GlbWriter& writer, int steel, int white) {
  const int wire = writer.mesh("wire panel", wire_panel(), steel);
  const int picket = writer.mesh("picket panel", picket_panel(), white);
  for (int i = 0; i < 10; ++i) writer.node(wire, placed({-12.5 + i * kPanel, 0.0, 2.0}));
  for (int i = 0; i < 4; ++i)
    writer.node(wire, placed({12.5, 0.0, 2.0 - i * kPanel}, std::numbers::pi / 2.0));
  for (int i = 0; i < 8; ++i) writer.node(picket, placed({-10.0 + i * kPanel, 0.0, -7.0}));
}

}  // namespace

std::string build_fence() {
  GlbWriter writer("fence");
  const int grass = writer.material("grass", {0.16, 0.24, 0.09}),
            paving = writer.material("paving", {0.42, 0.40, 0.37});
  const int steel = writer.material("steel", {0.35, 0.37, 0.39}),
            white = writer.material("paint", {0.78, 0.77, 0.72});
  const int plaster = writer.material("plaster", {0.66, 0.57, 0.44}),
            brick = writer.material("brick", {0.42, 0.16, 0.10});
  const int wood = writer.material("wood", {0.36, 0.21, 0.10}),
            red = writer.material("red", {0.55, 0.09, 0.06});
  add_ground(writer, 48.0, 8, grass);

  MeshBuilder path, wall, house, roof, crate;
  path.box({-14.0, -0.10, -1.6}, {14.0, 0.03, 1.0});
  writer.node(writer.mesh("path", path, paving));
  wall.box({-14.0, 0.0, -4.2}, {6.0, 2.6, -3.9});
  wall.box({-14.1, 2.6, -4.3}, {6.1, 2.7, -3.8});
  writer.node(writer.mesh("wall", wall, plaster));
  house.box({8.0, 0.0, -15.0}, {16.0, 4.2, -8.5});
  writer.node(writer.mesh("house", house, brick));
  roof.gable({7.5, 4.2, -15.5}, {16.5, 4.2, -8.0}, 2.6);
  writer.node(writer.mesh("roof", roof, red));
  add_fences(writer, steel, white);

  const int seat = writer.mesh("bench", bench(), wood);
  for (const double x : {-9.0, -3.0, 3.0}) writer.node(seat, placed({x, 0.03, -1.2}));
  const int light = writer.mesh("lamp", lamp(), steel);
  for (const double x : {-11.0, -6.0, 0.0, 6.0, 11.0})
    writer.node(light, placed({x, 0.0, 1.3}, std::numbers::pi / 2.0));
  crate.box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5});
  const int box = writer.mesh("crate", crate, wood);
  Random random(11);
  for (int i = 0; i < 14; ++i) {
    const glm::dvec3 at(random.uniform(-12.0, 11.0), 0.0, random.uniform(-3.0, -2.4));
    writer.node(box, placed(at, random.uniform(0.0, 1.5), random.uniform(0.3, 0.8)));
  }
  return writer.glb();
}

}  // namespace gnomon::detail
