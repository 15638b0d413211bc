// Two kilometres of streets: many instances of few meshes, near pavements and far towers in one view.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr double kPlate = 2000.0, kPitch = 100.0, kBlock = 78.0;  // metres; the rest of the pitch is street
constexpr int kBlocks = 20;                                       // per side
constexpr double kFloor = 3.4;                                    // metres
constexpr double kKerb = 0.15;                                    // height of the pavement over the street

struct Building {
  MeshBuilder body, glass;
};

// Storeys on the rectangle of half sizes hx, hz: a core, window bands, a ledge per floor and pilasters.
void add_storeys(Building& to, double hx, double hz, double from, int floors, double bay) {
  const double top = from + floors * kFloor;
  to.body.box({-hx, from, -hz}, {hx, top + 0.9, hz});
  for (int f = 0; f < floors; ++f) {
    const double y = from + f * kFloor;
    to.glass.box({-hx - 0.05, y + 1.0, -hz - 0.05}, {hx + 0.05, y + 2.6, hz + 0.05});
    to.body.box({-hx - 0.2, y + 2.9, -hz - 0.2}, {hx + 0.2, y + 3.1, hz + 0.2});
  }
  const auto pilasters = [&](double half, const auto& place) {
    const int count = std::max(1, static_cast<int>(std::lround(2.0 * half / bay)));
    for (int i = 0; i <= count; ++i) place(-half + i * 2.0 * half / count);
  };
  pilasters(hx, [&](double x) {
    for (const double z : {-hz, hz}) to.body.box({x - 0.25, from, z - 0.35}, {x + 0.25, top, z + 0.35});
  });
  pilasters(hz - bay / 2.0, [&](double z) {
    for (const double x : {-hx, hx}) to.body.box({x - 0.35, from, z - 0.25}, {x + 0.35, top, z + 0.25});
  });
}

Building tower(double hx, double hz, int low, int high) {
  Building out;
  add_storeys(out, hx, hz, 0.0, low, 7.0);
  const double y = low * kFloor;
  add_storeys(out, hx * 0.72, hz * 0.72, y, high, 7.0);
  const double top = y + high * kFloor + 0.9;
  out.body.box({-3.0, top, -2.0}, {3.0, top + 3.0, 4.0});
  out.body.cylinder({0.0, top + 3.0, 1.0}, {0.0, top + 15.0, 1.0}, 0.35, 0.08, 10);
  return out;
}

Building office(double hx, double hz, int floors) {
  Building out;
  add_storeys(out, hx, hz, 0.0, floors, 6.0);
  const double top = floors * kFloor + 0.9;
  for (const double x : {-0.5, 0.3})
    out.body.box({x * hx, top, -0.4 * hz}, {x * hx + 3.5, top + 2.2, 0.1 * hz});
  return out;
}

Building gabled(double hx, double hz, int floors) {
  Building out;
  add_storeys(out, hx, hz, 0.0, floors, 8.0);
  const double eaves = floors * kFloor + 0.9;
  out.body.gable({-hx - 0.5, eaves, -hz - 0.5}, {hx + 0.5, eaves, hz + 0.5}, hx * 0.7);
  for (const double z : {-0.6, 0.5}) {
    out.body.box({hx * 0.3, eaves, z * hz}, {hx * 0.3 + 0.9, eaves + hx * 0.7 + 0.6, z * hz + 0.9});
  }
  return out;
}

MeshBuilder street_lamp() {
  MeshBuilder out;
  out.cylinder({0.0, 0.0, 0.0}, {0.0, 8.0, 0.0}, 0.11, 0.06, 10);
  out.bar({0.0, 7.9, 0.0}, {1.8, 8.2, 0.0}, 0.08);
  out.box({1.3, 8.08, -0.15}, {2.2, 8.2, 0.15});
  return out;
}

struct Kit {
  int buildings[6], pavement, lamp, tree;
};

Kit make_kit(GlbWriter& writer) {
  const int glass = writer.material("glass", {0.09, 0.13, 0.17});
  const glm::dvec3 colors[6] = {{0.50, 0.50, 0.51}, {0.44, 0.38, 0.31}, {0.60, 0.56, 0.48},
                                {0.40, 0.20, 0.14}, {0.64, 0.52, 0.34}, {0.52, 0.28, 0.19}};
  const Building buildings[6] = {tower(14.0, 14.0, 14, 14), tower(11.0, 16.0, 12, 7), office(17.0, 17.0, 8),
                                 office(8.0, 17.0, 6),      gabled(7.5, 16.0, 4),     gabled(6.0, 8.0, 2)};
  Kit kit{};
  for (int i = 0; i < 6; ++i) {
    const int wall = writer.material("wall " + std::to_string(i), colors[i]);
    kit.buildings[i] = writer.mesh("building " + std::to_string(i),
                                   {{&buildings[i].body, wall}, {&buildings[i].glass, glass}});
  }
  MeshBuilder slab, foliage, trunk;
  slab.box({-kBlock / 2.0, -0.2, -kBlock / 2.0}, {kBlock / 2.0, kKerb, kBlock / 2.0});
  kit.pavement = writer.mesh("pavement", slab, writer.material("pavement", {0.38, 0.37, 0.35}));
  kit.lamp = writer.mesh("lamp", street_lamp(), writer.material("steel", {0.16, 0.17, 0.18}));
  Random random(9);
  foliage.boulder({0.0, 4.6, 0.0}, 2.2, 0.14, 7, 10, random);
  trunk.cylinder({0.0, 0.0, 0.0}, {0.0, 3.2, 0.0}, 0.2, 0.14, 8);
  kit.tree = writer.mesh("tree", {{&trunk, writer.material("bark", {0.17, 0.12, 0.08})},
                                  {&foliage, writer.material("leaves", {0.11, 0.21, 0.07})}});
  return kit;
}

// Four lots to a block, 18 m from its middle each way; a lot holds what its distance from the centre makes
// likely.
void add_block(GlbWriter& writer, const Kit& kit, const glm::dvec3& center, Random& random) {
  writer.node(kit.pavement, placed(center));
  const double from_centre = glm::length(center) / 1000.0;
  const glm::dvec3 ground = center + glm::dvec3(0.0, kKerb, 0.0);
  const double kind = random.uniform(0.0, 1.0) + 0.55 * from_centre;
  const int first = kind < 0.35 ? 0 : kind < 0.7 ? 2 : 4;
  const bool park = kind > 1.3;
  for (int lot = 0; lot < 4; ++lot) {
    const double x = lot % 2 == 0 ? -18.5 : 18.5, z = lot < 2 ? -18.5 : 18.5;
    const glm::dvec3 at = ground + glm::dvec3(x, 0.0, z);
    const int pick = first + static_cast<int>(random.uniform(0.0, 2.0));
    if (!park && random.uniform(0.0, 1.0) < 0.72) {
      const int quarters = static_cast<int>(random.uniform(0.0, 4.0));
      writer.node(kit.buildings[pick], placed(at, quarters * std::numbers::pi / 2.0));
    } else {
      const glm::dvec3 off(random.uniform(-12.0, 12.0), 0.0, random.uniform(-12.0, 12.0));
      writer.node(kit.tree, placed(at + off, random.uniform(0.0, 6.0), random.uniform(0.8, 1.5)));
    }
  }
  writer.node(kit.lamp, placed(ground + glm::dvec3(38.0, 0.0, -20.0)));
  writer.node(kit.lamp, placed(ground + glm::dvec3(-38.0, 0.0, 20.0), std::numbers::pi));
}

}  // namespace

std::string build_city() {
  GlbWriter writer("city");
  add_ground(writer, kPlate, 8, writer.material("asphalt", {0.15, 0.15, 0.16}));
  const Kit kit = make_kit(writer);
  Random random(2027);
  for (int x = 0; x < kBlocks; ++x) {
    for (int z = 0; z < kBlocks; ++z) {
      add_block(writer, kit, {(x + 0.5) * kPitch - kPlate / 2.0, 0.0, (z + 0.5) * kPitch - kPlate / 2.0},
                random);
    }
  }
  return writer.glb();
}

}  // namespace gnomon::detail
