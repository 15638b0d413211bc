// A grove whose foliage is cut out of cards by alpha: shadows must have holes where the picture has.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr int kPicture = 256;  // pixels per side
constexpr double kTurn = 2.0 * std::numbers::pi;

// Draws one pointed leaf from `root` along `angle` into the picture; sizes in parts of the picture.
void draw_leaf(Image& picture, const glm::dvec2& root, double angle, double length, double tint) {
  const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
  for (int y = 0; y < kPicture; ++y) {
    for (int x = 0; x < kPicture; ++x) {
      const glm::dvec2 p = glm::dvec2((x + 0.5) / kPicture, (y + 0.5) / kPicture) - root;
      const double t = glm::dot(p, along) / length, s = std::abs(glm::dot(p, across)) / length;
      if (t <= 0.0 || t >= 1.0 || s > 0.36 * std::sin(std::numbers::pi * std::pow(t, 0.8))) continue;
      const double vein = s < 0.02 ? 1.25 : 1.0;
      std::uint8_t* pixel = &picture.rgba[static_cast<std::size_t>(y * kPicture + x) * 4];
      const double color[3] = {88.0 * tint * vein, 142.0 * tint * vein, 46.0 * tint};
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::clamp(color[c], 0.0, 255.0));
      pixel[3] = 255;
    }
  }
}

Image leaf_picture() {
  Image out;
  out.name = "leaves";
  out.width = out.height = kPicture;
  out.rgba.resize(static_cast<std::size_t>(kPicture) * kPicture * 4);
  // Transparent pixels carry leaf green too: filtering must not draw a dark rim.
  for (std::size_t i = 0; i < out.rgba.size(); i += 4) {
    out.rgba[i] = 80;
    out.rgba[i + 1] = 130;
    out.rgba[i + 2] = 42;
  }
  Random random(3);
  for (int i = 0; i < 46; ++i) {
    const double radius = 0.40 * std::sqrt(random.uniform(0.0, 1.0)), around = random.uniform(0.0, kTurn);
    const glm::dvec2 root(0.5 + radius * std::cos(around), 0.5 + radius * std::sin(around));
    draw_leaf(out, root, around + random.uniform(-0.9, 0.9), random.uniform(0.10, 0.17),
              random.uniform(0.7, 1.15));
  }
  return out;
}

// Cards stand about the middle of the crown, turned every way; each is one double-sided quad.
MeshBuilder crown(const glm::dvec3& center, const glm::dvec3& radii, double size, int cards, Random& random) {
  MeshBuilder out;
  for (int i = 0; i < cards; ++i) {
    const double height = random.uniform(-1.0, 1.0), around = random.uniform(0.0, kTurn);
    const double flat = std::sqrt(1.0 - height * height), reach = std::cbrt(random.uniform(0.15, 1.0));
    const glm::dvec3 outward(flat * std::cos(around), height, flat * std::sin(around));
    const glm::dvec3 at = center + outward * radii * reach;
    const double lean = random.uniform(-0.9, 0.9), turn = random.uniform(0.0, kTurn);
    const glm::dvec3 right(std::cos(turn), 0.0, std::sin(turn));
    const glm::dvec3 up(-std::sin(turn) * std::sin(lean), std::cos(lean), std::cos(turn) * std::sin(lean));
    const double half = size * random.uniform(0.4, 0.65);
    out.quad(at - right * half - up * half, at + right * half - up * half, at + right * half + up * half,
             at - right * half + up * half);
  }
  return out;
}

struct Kind {
  double trunk, radius;  // metres: height of the first fork, thickness
  glm::dvec3 radii;      // of the crown
  int cards;
  double card;  // metres
};

int tree(GlbWriter& writer, const Kind& kind, int bark, int leaves, Random& random) {
  MeshBuilder wood;
  const double top = kind.trunk + kind.radii.y;
  wood.cylinder({0.0, -0.1, 0.0}, {0.0, kind.trunk, 0.0}, kind.radius, kind.radius * 0.7, 12);
  wood.cylinder({0.0, kind.trunk, 0.0}, {0.1, top, 0.0}, kind.radius * 0.7, kind.radius * 0.25, 10);
  for (int i = 0; i < 7; ++i) {
    const double around = kTurn * i / 7.0 + random.uniform(-0.3, 0.3),
                 from = kind.trunk * random.uniform(0.75, 1.15);
    const glm::dvec3 tip(kind.radii.x * 0.7 * std::cos(around),
                         from + kind.radii.y * random.uniform(0.4, 0.9),
                         kind.radii.z * 0.7 * std::sin(around));
    wood.cylinder({0.0, from, 0.0}, tip, kind.radius * 0.35, kind.radius * 0.1, 8);
  }
  const MeshBuilder foliage =
      crown({0.0, kind.trunk + kind.radii.y * 0.75, 0.0}, kind.radii, kind.card, kind.cards, random);
  return writer.mesh("tree", {{&wood, bark}, {&foliage, leaves}});
}

}  // namespace

std::string build_trees() {
  GlbWriter writer("trees");
  const int meadow = writer.material("meadow", {0.24, 0.30, 0.12}),
            bark = writer.material("bark", {0.20, 0.13, 0.08});
  const int rock = writer.material("rock", {0.40, 0.38, 0.35});
  const int leaves = writer.mask_material("leaves", {0.9, 0.9, 0.9}, leaf_picture());
  add_ground(writer, 120.0, 8, meadow);
  Random random(41);
  const Kind kinds[] = {{2.6, 0.28, {3.0, 2.6, 3.0}, 260, 1.3},
                        {4.2, 0.34, {3.6, 4.0, 3.6}, 380, 1.5},
                        {1.6, 0.16, {1.6, 1.8, 1.6}, 120, 0.9},
                        {3.4, 0.22, {1.7, 4.2, 1.7}, 240, 1.0}};
  std::vector<int> meshes;
  for (const Kind& kind : kinds) meshes.push_back(tree(writer, kind, bark, leaves, random));
  // A jittered grid: no two trunks meet, and a lane stays free for the flight.
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      if (j == 0) continue;
      const glm::dvec3 at(i * 11.0 + random.uniform(-3.5, 3.5), 0.0, j * 11.0 + random.uniform(-3.5, 3.5));
      const auto kind = static_cast<std::size_t>(random.uniform(0.0, 4.0));
      writer.node(meshes[kind], placed(at, random.uniform(0.0, kTurn), random.uniform(0.8, 1.25)));
    }
  }
  MeshBuilder lump;
  lump.boulder({0.0, 0.0, 0.0}, 0.6, 0.15, 7, 10, random);
  const int stone = writer.mesh("stone", lump, rock);
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 at(random.uniform(-50.0, 50.0), 0.1, random.uniform(-6.0, 6.0));
    writer.node(stone, placed(at, random.uniform(0.0, kTurn), random.uniform(0.4, 1.1)));
  }
  return writer.glb();
}

}  // namespace gnomon::detail
