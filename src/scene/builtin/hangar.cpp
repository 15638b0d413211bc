// An open steel hall: columns, trusses and purlins cast nested thin shadows on a floor with crates.
#include <cmath>
#include <numbers>

#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr double kSpan = 30.0, kBay = 6.0, kEaves = 8.0, kRise = 3.0, kDepth = 1.6;  // metres
constexpr int kBays = 10, kPanels = 12;

// Height of the roof's upper edge over the floor at x in [-span/2, span/2].
double upper(double x) {
  return kEaves + kDepth + kRise * (1.0 - std::abs(x) / (kSpan / 2.0));
}
double lower(double x) {
  return upper(x) - kDepth;
}

MeshBuilder roof_frame() {
  MeshBuilder out;
  for (const double x : {-kSpan / 2.0, kSpan / 2.0}) {
    // An H section: two flanges and a web.
    out.box({x - 0.15, 0.0, -0.15}, {x - 0.13, upper(x), 0.15});
    out.box({x + 0.13, 0.0, -0.15}, {x + 0.15, upper(x), 0.15});
    out.box({x - 0.13, 0.0, -0.01}, {x + 0.13, upper(x), 0.01});
    out.box({x - 0.3, 0.0, -0.3}, {x + 0.3, 0.04, 0.3});
  }
  const double step = kSpan / kPanels;
  for (int i = 0; i < kPanels; ++i) {
    const double a = -kSpan / 2.0 + i * step, b = a + step;
    out.bar({a, upper(a), 0.0}, {b, upper(b), 0.0}, 0.14);
    out.bar({a, lower(a), 0.0}, {b, lower(b), 0.0}, 0.12);
    out.bar({a, lower(a), 0.0}, {a, upper(a), 0.0}, 0.07);
    const bool rising = i < kPanels / 2;
    out.bar({a, rising ? upper(a) : lower(a), 0.0}, {b, rising ? lower(b) : upper(b), 0.0}, 0.06);
  }
  return out;
}

MeshBuilder purlins() {
  MeshBuilder out;
  for (int i = 0; i <= 2 * kPanels; ++i) {
    const double x = -kSpan / 2.0 + i * kSpan / (2.0 * kPanels), y = upper(x) + 0.07;
    out.box({x - 0.04, y, 0.0}, {x + 0.04, y + 0.16, kBay});
  }
  for (const double x : {-kSpan / 2.0, kSpan / 2.0}) {
    for (int i = 1; i <= 4; ++i) out.box({x - 0.05, i * 1.8, 0.15}, {x + 0.05, i * 1.8 + 0.1, kBay - 0.15});
  }
  return out;
}

MeshBuilder bracing() {
  MeshBuilder out;
  for (const double x : {-kSpan / 2.0, kSpan / 2.0}) {
    out.bar({x + 0.02, 0.3, 0.1}, {x + 0.02, kEaves, kBay - 0.1}, 0.025);
    out.bar({x - 0.02, kEaves, 0.1}, {x - 0.02, 0.3, kBay - 0.1}, 0.025);
  }
  return out;
}

// Roof sheets with a gap each: strips of light on the floor.
MeshBuilder sheets() {
  MeshBuilder out;
  const double step = kSpan / kPanels;
  for (int i = 0; i < kPanels; i += 3) {
    const double a = -kSpan / 2.0 + i * step, b = a + step, h = 0.24, t = 0.03;
    const glm::dvec3 p[4] = {{a, upper(a) + h, kBay - 0.3},
                             {b, upper(b) + h, kBay - 0.3},
                             {b, upper(b) + h, 0.3},
                             {a, upper(a) + h, 0.3}};
    const glm::dvec3 up(0.0, t, 0.0);
    out.quad(p[0] + up, p[1] + up, p[2] + up, p[3] + up);
    out.quad(p[3], p[2], p[1], p[0]);
    for (int k = 0; k < 4; ++k) {
      const int n = (k + 1) % 4;
      out.quad(p[k], p[n], p[n] + up, p[k] + up);
    }
  }
  return out;
}

MeshBuilder crate() {
  MeshBuilder out;
  out.box({-0.6, 0.0, -0.6}, {0.6, 1.1, 0.6});
  for (const double y : {0.05, 0.95}) {
    for (const double s : {-1.0, 1.0}) {
      out.box({-0.63, y, s > 0 ? 0.6 : -0.63}, {0.63, y + 0.1, s > 0 ? 0.63 : -0.6});
      out.box({s > 0 ? 0.6 : -0.63, y, -0.6}, {s > 0 ? 0.63 : -0.6, y + 0.1, 0.6});
    }
  }
  return out;
}

void add_crates(GlbWriter& writer, int wood, int blue) {
  const int box = writer.mesh("crate", crate(), wood);
  MeshBuilder drum;
  drum.cylinder({0.0, 0.0, 0.0}, {0.0, 0.9, 0.0}, 0.3, 0.3, 24);
  const int barrel = writer.mesh("drum", drum, blue);
  Random random(5);
  for (int pile = 0; pile < 14; ++pile) {
    const glm::dvec3 at(random.uniform(-12.0, 12.0), 0.0, random.uniform(-26.0, 26.0));
    const double turn = random.uniform(0.0, 1.5);
    const int high = 1 + static_cast<int>(random.uniform(0.0, 3.0));
    for (int level = 0; level < high; ++level) {
      writer.node(box, placed(at + glm::dvec3(0.0, level * 1.1, 0.0), turn + level * 0.12));
    }
    writer.node(barrel, placed(at + glm::dvec3(1.5, 0.0, 0.4)));
    writer.node(barrel, placed(at + glm::dvec3(1.4, 0.0, 1.1)));
  }
}

}  // namespace

std::string build_hangar() {
  GlbWriter writer("hangar");
  const int concrete = writer.material("concrete", {0.40, 0.39, 0.37}),
            steel = writer.material("steel", {0.22, 0.30, 0.34});
  const int zinc = writer.material("zinc", {0.50, 0.52, 0.54}),
            roofing = writer.material("roofing", {0.46, 0.17, 0.11});
  const int wood = writer.material("wood", {0.46, 0.29, 0.13}),
            blue = writer.material("blue", {0.07, 0.18, 0.42});
  add_ground(writer, 120.0, 8, concrete);
  const int truss = writer.mesh("frame", roof_frame(), steel), bay = writer.mesh("purlins", purlins(), zinc);
  const int brace = writer.mesh("bracing", bracing(), zinc), sheet = writer.mesh("sheets", sheets(), roofing);
  for (int i = 0; i <= kBays; ++i) {
    const glm::dvec3 at(0.0, 0.0, (i - kBays / 2.0) * kBay);
    writer.node(truss, placed(at));
    if (i == kBays) break;
    writer.node(bay, placed(at));
    if (i % 3 == 0) writer.node(brace, placed(at));
    if (i % 2 == 0) writer.node(sheet, placed(at));
  }
  add_crates(writer, wood, blue);
  return writer.glb();
}

}  // namespace gnomon::detail
