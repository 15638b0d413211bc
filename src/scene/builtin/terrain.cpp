// A kilometre of hills under grazing light: every slope is a receiver and a caster.
#include <cmath>
#include <glm/geometric.hpp>

#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr int kQuads = 256, kTiles = 8;  // per side
constexpr double kSide = 1024.0;         // metres
constexpr double kStep = kSide / kQuads;

double lattice(int x, int z, std::uint32_t seed) {
  Random random((static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32u) ^
                (static_cast<std::uint64_t>(static_cast<std::uint32_t>(z)) * 0x9e3779b97f4a7c15ull) ^ seed);
  return random.uniform(-1.0, 1.0);
}

// Value noise with a quintic fade: continuous slope and curvature, so that shading shows no grid.
double noise(double x, double z, std::uint32_t seed) {
  const double fx = std::floor(x), fz = std::floor(z);
  const int ix = static_cast<int>(fx), iz = static_cast<int>(fz);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const double u = fade(x - fx), v = fade(z - fz);
  const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
  return mix(mix(lattice(ix, iz, seed), lattice(ix + 1, iz, seed), u),
             mix(lattice(ix, iz + 1, seed), lattice(ix + 1, iz + 1, seed), u), v);
}

glm::dvec3 terrain_normal(double x, double z) {
  const double dx = terrain_height(x + 0.5, z) - terrain_height(x - 0.5, z);
  const double dz = terrain_height(x, z + 0.5) - terrain_height(x, z - 0.5);
  return glm::normalize(glm::dvec3(-dx, 1.0, -dz));
}

MeshBuilder tile(int tx, int tz) {
  constexpr int kPerTile = kQuads / kTiles;
  MeshBuilder out;
  for (int j = 0; j <= kPerTile; ++j) {
    for (int i = 0; i <= kPerTile; ++i) {
      const double x = (tx * kPerTile + i) * kStep - kSide / 2.0,
                   z = (tz * kPerTile + j) * kStep - kSide / 2.0;
      out.vertex({x, terrain_height(x, z), z}, terrain_normal(x, z), {x / kSide + 0.5, z / kSide + 0.5});
    }
  }
  for (int j = 0; j < kPerTile; ++j) {
    for (int i = 0; i < kPerTile; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (kPerTile + 1) + i), b = a + 1;
      const std::uint32_t c = a + kPerTile + 1, d = c + 1;
      out.triangle(a, c, d);
      out.triangle(a, d, b);
    }
  }
  return out;
}

}  // namespace

double terrain_height(double x, double z) {
  double height = 0.0, amplitude = 42.0, scale = 1.0 / 260.0;
  for (std::uint32_t octave = 0; octave < 5; ++octave) {
    height += amplitude * noise(x * scale, z * scale, 77u + octave);
    amplitude *= 0.42;
    scale *= 2.1;
  }
  return std::max(height + 30.0, 0.0) +
         0.02 * std::min(height + 30.0, 0.0);  // valleys silt up to nearly level
}

std::string build_terrain() {
  GlbWriter writer("terrain");
  const int meadow = writer.material("meadow", {0.22, 0.27, 0.12}),
            rock = writer.material("rock", {0.34, 0.32, 0.29});
  const int stone = writer.material("standing stone", {0.48, 0.46, 0.42});
  for (int z = 0; z < kTiles; ++z) {
    for (int x = 0; x < kTiles; ++x) {
      writer.node(writer.mesh("tile " + std::to_string(x) + "," + std::to_string(z), tile(x, z), meadow));
    }
  }
  Random random(23);
  int lumps[3];
  for (int& lump : lumps) {
    MeshBuilder mesh;
    mesh.boulder({0.0, 0.0, 0.0}, 1.0, 0.18, 8, 12, random);
    lump = writer.mesh("boulder", mesh, rock);
  }
  for (int i = 0; i < 60; ++i) {
    const double x = random.uniform(-480.0, 480.0), z = random.uniform(-480.0, 480.0);
    const double size = random.uniform(0.8, 5.0);
    writer.node(lumps[i % 3], placed({x, terrain_height(x, z) + size * 0.3, z}, random.uniform(0.0, 6.0),
                                     {size, size * random.uniform(0.6, 1.0), size}));
  }
  MeshBuilder pillar;
  pillar.bar({0.0, -1.0, 0.0}, {0.15, 4.5, 0.0}, 0.9);
  const int menhir = writer.mesh("standing stone", pillar, stone);
  for (int i = 0; i < 16; ++i) {
    const double angle = i * 0.3927, x = 60.0 + 22.0 * std::cos(angle), z = 40.0 + 22.0 * std::sin(angle);
    writer.node(menhir, placed({x, terrain_height(x, z), z}, angle));
  }
  return writer.glb();
}

}  // namespace gnomon::detail
