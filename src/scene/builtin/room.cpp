// A room behind windows with blinds: contacts of furniture, light through slats, most of it in shadow.
#include "builtin.hpp"
#include "glb_writer.hpp"

namespace gnomon::detail {

namespace {

constexpr double kHalfWide = 5.0, kHalfDeep = 3.5, kCeiling = 2.8,
                 kThick = 0.25;  // half sides, height, metres

/// A wall in the plane z = 0 from -half to half, with two windows; outside at +z.
MeshBuilder window_wall(double half) {
  constexpr double kSill = 0.9, kLintel = 2.3, kPier = 0.4;
  MeshBuilder out;
  out.box({-half, 0.0, 0.0}, {half, kSill, kThick});
  out.box({-half, kLintel, 0.0}, {half, kCeiling, kThick});
  for (const double x : {-half, -kPier / 2.0, half - kPier})
    out.box({x, kSill, 0.0}, {x + kPier, kLintel, kThick});
  for (double x = -half + 1.3; x < half - 0.5; x += 0.9)
    if (x < -kPier || x > kPier) out.box({x, kSill, 0.1}, {x + 0.04, kLintel, 0.14});
  return out;
}

/// Slats of one window, 3 mm thick.
MeshBuilder blinds(double width) {
  MeshBuilder out;
  for (int i = 0; i < 14; ++i) {
    const double y = 2.28 - 0.06 * i;
    out.box({0.0, y, 0.0}, {width, y + 0.003, 0.05});
  }
  for (const double x : {0.2, width - 0.2}) out.bar({x, 1.5, 0.025}, {x, 2.3, 0.025}, 0.003);
  return out;
}

MeshBuilder table() {
  MeshBuilder out;
  out.box({-0.8, 0.72, -0.4}, {0.8, 0.75, 0.4});
  for (const double x : {-0.76, 0.72})
    for (const double z : {-0.36, 0.32}) out.box({x, 0.0, z}, {x + 0.04, 0.72, z + 0.04});
  return out;
}

MeshBuilder chair() {
  MeshBuilder out;
  out.box({-0.2, 0.44, -0.2}, {0.2, 0.47, 0.2});
  for (const double x : {-0.2, 0.175})
    for (const double z : {-0.2, 0.175}) out.box({x, 0.0, z}, {x + 0.025, 0.44, z + 0.025});
  for (int i = 0; i < 4; ++i) out.box({-0.2 + 0.125 * i, 0.47, 0.18}, {-0.175 + 0.125 * i, 0.9, 0.2});
  out.box({-0.2, 0.86, 0.175}, {0.2, 0.92, 0.2});
  return out;
}

MeshBuilder shelf() {
  MeshBuilder out;
  for (const double x : {-0.9, 0.87}) out.box({x, 0.0, -0.15}, {x + 0.03, 2.0, 0.15});
  for (int i = 0; i < 5; ++i) out.box({-0.87, 0.1 + 0.4 * i, -0.15}, {0.87, 0.12 + 0.4 * i, 0.15});
  return out;
}

void add_furniture(GlbWriter& writer, int wood, int paper) {
  const int of_table = writer.mesh("table", table(), wood), of_chair = writer.mesh("chair", chair(), wood),
            of_shelf = writer.mesh("shelf", shelf(), wood);
  const glm::dvec3 tables[] = {{-2.0, 0.0, 1.2}, {1.4, 0.0, 1.6}, {2.6, 0.0, -0.6}};
  for (const glm::dvec3& at : tables) {
    writer.node(of_table, placed(at, 0.1 * at.x));
    for (const double side : {-0.75, 0.75}) {
      for (const double x : {-0.4, 0.4})
        writer.node(of_chair, placed(at + glm::dvec3(x, 0.0, side), side > 0.0 ? 0.0 : 3.141592653589793));
    }
  }
  MeshBuilder book;
  book.box({0.0, 0.0, -0.1}, {0.035, 0.26, 0.1});
  const int of_book = writer.mesh("book", book, paper);
  Random random(7);
  for (const double x : {-3.6, -1.6, 0.4}) {
    writer.node(of_shelf, placed({x, 0.0, -3.3}));
    for (int board = 0; board < 4; ++board) {
      for (int i = 0; i < 12; ++i)
        writer.node(of_book, placed({x - 0.8 + 0.05 * i + 0.4 * (i / 7), 0.12 + 0.4 * board, -3.3}, 0.0,
                                    random.uniform(0.85, 1.1)));
    }
  }
  // Things that touch what they stand on.
  MeshBuilder box, bowl, lamp;
  box.box({-0.12, 0.0, -0.09}, {0.12, 0.06, 0.09});
  bowl.cylinder({0.0, 0.0, 0.0}, {0.0, 0.05, 0.0}, 0.05, 0.12, 24);
  lamp.cylinder({0.0, 0.0, 0.0}, {0.0, 0.02, 0.0}, 0.09, 0.09, 24);
  lamp.cylinder({0.0, 0.02, 0.0}, {0.0, 0.35, 0.0}, 0.006, 0.006, 8);
  lamp.cylinder({0.0, 0.33, 0.0}, {0.0, 0.48, 0.0}, 0.13, 0.08, 24);
  const int of_box = writer.mesh("box", box, paper), of_bowl = writer.mesh("bowl", bowl, paper),
            of_lamp = writer.mesh("lamp", lamp, wood);
  for (const glm::dvec3& at : tables) {
    writer.node(of_box, placed(at + glm::dvec3(-0.4, 0.75, 0.1), 0.4));
    writer.node(of_bowl, placed(at + glm::dvec3(0.1, 0.75, 0.05)));
    writer.node(of_lamp, placed(at + glm::dvec3(0.55, 0.75, -0.15)));
  }
}

}  // namespace

std::string build_room() {
  GlbWriter writer("room");
  const int concrete = writer.material("concrete", {0.40, 0.36, 0.30}),
            plaster = writer.material("plaster", {0.72, 0.70, 0.66}),
            wood = writer.material("wood", {0.45, 0.29, 0.16}),
            paper = writer.material("paper", {0.6, 0.52, 0.4});
  add_ground(writer, 24.0, 8, concrete);
  writer.node(writer.mesh("long wall", window_wall(kHalfWide), plaster), placed({0.0, 0.0, kHalfDeep}));
  const double turn = 1.5707963267948966;  // outside at +x
  writer.node(writer.mesh("short wall", window_wall(kHalfDeep), plaster),
              placed({kHalfWide, 0.0, 0.0}, turn));
  MeshBuilder solid, roof;
  solid.box({-kHalfWide - kThick, 0.0, -kHalfDeep - kThick}, {kHalfWide + kThick, kCeiling, -kHalfDeep});
  solid.box({-kHalfWide - kThick, 0.0, -kHalfDeep}, {-kHalfWide, kCeiling, kHalfDeep + kThick});
  solid.box({kHalfWide, 0.0, kHalfDeep}, {kHalfWide + kThick, kCeiling, kHalfDeep + kThick});
  roof.box({-kHalfWide - 0.6, kCeiling, -kHalfDeep - 0.6},
           {kHalfWide + 0.6, kCeiling + 0.3, kHalfDeep + 0.6});
  writer.node(writer.mesh("walls", solid, plaster));
  writer.node(writer.mesh("roof", roof, plaster));
  const int of_blinds = writer.mesh("blinds", blinds(4.3), wood);
  for (const double x : {-4.5, 0.25}) writer.node(of_blinds, placed({x, 0.0, kHalfDeep - 0.08}));
  add_furniture(writer, wood, paper);
  return writer.glb();
}

}  // namespace gnomon::detail
