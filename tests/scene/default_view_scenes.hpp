// Scenes as people have them, small: what a person would look at in each, and what stands around it.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "gltf_text.hpp"

namespace gnomon::test {

/// Triangles of one part, in its own frame.
struct PartMesh {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;

  std::uint32_t corner(const glm::dvec3& at) {
    for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(at[c]));
    return static_cast<std::uint32_t>(positions.size() / 3 - 1);
  }
  /// Corners counter-clockwise from its front.
  PartMesh& quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const std::uint32_t i = corner(a);
    corner(b), corner(c), corner(d);
    for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(i + k);
    return *this;
  }
  PartMesh& floor(double half, double y) {
    return quad({-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half});
  }
  /// Faces out, or in.
  PartMesh& box(const glm::dvec3& a, const glm::dvec3& b, bool inwards = false) {
    const auto first = indices.size();
    quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
    quad({b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z});
    quad({b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z});
    quad({a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z});
    quad({a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z});
    quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
    if (inwards) turn(first);
    return *this;
  }
  void turn(std::size_t first) {
    for (std::size_t i = first; i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
  }
  /// Points of a surface over [0,1] x [0,1]; its front is where d/du x d/dv points.
  PartMesh& sheet(int columns, int rows, const std::function<glm::dvec3(double, double)>& at) {
    const auto first = static_cast<std::uint32_t>(positions.size() / 3);
    for (int r = 0; r <= rows; ++r)
      for (int c = 0; c <= columns; ++c) corner(at(1.0 * c / columns, 1.0 * r / rows));
    const auto width = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(rows); ++r)
      for (std::uint32_t c = 0; c + 1 < width; ++c) {
        const std::uint32_t i = first + r * width + c;
        for (const std::uint32_t k : {0u, 1u, width + 1, 0u, width + 1, width}) indices.push_back(i + k);
      }
    return *this;
  }
  /// A dome, or a ball where `low` is -1: latitudes from asin(low) up. Faces out, or in.
  PartMesh& ball(const glm::dvec3& center, double radius, double low = -1.0, bool inwards = false) {
    const auto first = indices.size();
    sheet(24, 12, [&](double u, double v) {
      const double turn = 2.0 * std::numbers::pi * u,
                   up = std::asin(low) + (std::numbers::pi / 2 - std::asin(low)) * v;
      return center +
             radius * glm::dvec3(std::cos(up) * std::sin(turn), std::sin(up), std::cos(up) * std::cos(turn));
    });
    if (inwards) turn(first);
    return *this;
  }
  /// A post round the Y axis of this radius at each height from 0 on.
  PartMesh& lathe(const glm::dvec3& foot, double height, const std::function<double(double)>& radius) {
    return sheet(20, 12, [&](double u, double v) {
      const double turn = 2.0 * std::numbers::pi * u;
      return foot + glm::dvec3(radius(v) * std::sin(turn), height * v, radius(v) * std::cos(turn));
    });
  }
};

/// A scene to be opened without a word about the camera.
struct ViewScene {
  std::string name;
  TestGltf gltf;
  bool from_inside = false, from_outside = false;  ///< where the eye must be: within the box, out of it
  glm::dvec3 box_min{0.0}, box_max{0.0};
  glm::dvec3 place{0.0};  ///< all parts are moved by this

  ViewScene(std::string of, const glm::dvec3& at = {}) : name(std::move(of)), place(at) {
    for (const char* material : {"content", "backdrop", "content two-sided", "backdrop two-sided"}) {
      const bool shade = std::string(material).starts_with("backdrop");
      const std::vector<double> color =
          shade ? std::vector<double>{0.35, 0.5, 0.35, 1} : std::vector<double>{0.8, 0.75, 0.65, 1};
      gltf.add("materials", {{"name", material},
                             {"doubleSided", std::string(material).ends_with("two-sided")},
                             {"pbrMetallicRoughness", {{"baseColorFactor", color}}}});
    }
  }
  /// What a person would look at.
  ViewScene& content(const PartMesh& mesh, bool two_sided = false) { return add(mesh, two_sided ? 2 : 0); }
  /// A sky, a ground, a backdrop.
  ViewScene& backdrop(const PartMesh& mesh, bool two_sided = false) { return add(mesh, two_sided ? 3 : 1); }
  ViewScene& inside(const glm::dvec3& low, const glm::dvec3& high) {
    from_inside = true, box_min = low, box_max = high;
    return *this;
  }

  ViewScene& outside(const glm::dvec3& low, const glm::dvec3& high) {
    from_outside = true, box_min = low, box_max = high;
    return *this;
  }
  friend std::ostream& operator<<(std::ostream& out, const ViewScene& scene) { return out << scene.name; }

 private:
  ViewScene& add(const PartMesh& mesh, int material) {
    const int corners = gltf.positions(mesh.positions);
    glm::vec3 low(1e30f), high(-1e30f);
    for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
      const glm::vec3 p(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
      low = glm::min(low, p), high = glm::max(high, p);
    }
    gltf.document["accessors"][static_cast<std::size_t>(corners)]["min"] = {low.x, low.y, low.z};
    gltf.document["accessors"][static_cast<std::size_t>(corners)]["max"] = {high.x, high.y, high.z};
    const int indices = gltf.accessor(gltf.view(mesh.indices), kUnsignedInt, "SCALAR", mesh.indices.size());
    gltf.show({{"attributes", {{"POSITION", corners}}}, {"indices", indices}, {"material", material}},
              {{"translation", {place.x, place.y, place.z}}});
    return *this;
  }
};

/// House k of a town of 64 on a square of 100: two storeys or a tower.
inline PartMesh house(
    int k, const std::function<double(double, double)>& ground = [](double, double) { return 0.0; }) {
  const double x = (k % 8 - 3.5) * 12.5, z = (k / 8 - 3.5) * 12.5, y = ground(x, z),
               height = 5.0 + (k * 7 % 5) * 1.5 + (k % 11 == 0 ? 12.0 : 0.0), half = 3.5 + (k * 5 % 3);
  PartMesh mesh;
  mesh.box({x - half, y - 2.0, z - 3.5}, {x + half, y + height, z + 3.5});
  mesh.quad({x - half - 0.5, y + height, z + 4}, {x + half + 0.5, y + height, z + 4},
            {x + half + 0.5, y + height + 3, z}, {x - half - 0.5, y + height + 3, z});
  mesh.quad({x + half + 0.5, y + height, z - 4}, {x - half - 0.5, y + height, z - 4},
            {x - half - 0.5, y + height + 3, z}, {x + half + 0.5, y + height + 3, z});
  return mesh;
}
inline void add_town(ViewScene& scene) {
  for (int k = 0; k < 64; ++k) scene.content(house(k));
}
inline PartMesh vase(double size, const glm::dvec3& foot = {}) {
  PartMesh mesh;
  mesh.lathe(foot, size, [&](double v) { return size * (0.22 + 0.13 * std::sin(5.0 * v)); });
  return mesh;
}
inline void add_furniture(ViewScene& scene, double x, double z) {
  scene.content(PartMesh().box({x - 0.8, 0.7, z - 0.5}, {x + 0.8, 0.78, z + 0.5}));
  PartMesh legs;
  for (const double dx : {-0.7, 0.7})
    for (const double dz : {-0.4, 0.4})
      legs.box({x + dx - 0.04, 0, z + dz - 0.04}, {x + dx + 0.04, 0.7, z + dz + 0.04});
  scene.content(legs).content(vase(0.4, {x, 0.78, z}));
}
inline double hills(double x, double z) {
  return 18.0 * std::sin(x * 0.011) * std::cos(z * 0.013) + 5.0 * std::sin(x * 0.05 + z * 0.04);
}
inline PartMesh land(double half, int cells, double scale) {
  return PartMesh().sheet(cells, cells, [=](double u, double v) {
    const double x = (2 * u - 1) * half, z = (1 - 2 * v) * half;
    return glm::dvec3(x, scale * hills(x, z), z);
  });
}

/// All of them.
inline std::vector<ViewScene> default_view_scenes() {
  std::vector<ViewScene> scenes;
  const auto scene = [&scenes](const char* name, const glm::dvec3& place = {}) -> ViewScene& {
    return scenes.emplace_back(name, place);
  };
  const glm::dvec3 earth(6378137.0, 12345.0, -2345678.0);

  scene("prop").content(vase(0.5));
  scene("millimetres").content(vase(0.003)).backdrop(PartMesh().floor(0.02, 0.0));
  add_town(scene("town"));
  for (const auto& [name, place] :
       {std::pair{"town_on_plate", glm::dvec3(0.0)}, std::pair{"town_on_earth", earth}}) {
    ViewScene& s = scene(name, place);
    add_town(s);
    s.backdrop(PartMesh().floor(1000.0, 0.0));
  }
  {
    ViewScene& s = scene("town_on_plate_of_three_times");
    add_town(s);
    s.backdrop(PartMesh().floor(150.0, 0.0));
  }
  {
    ViewScene& s = scene("town_on_thick_plate_of_cells");
    add_town(s);
    s.backdrop(PartMesh().sheet(100, 100, [](double u, double v) {
      return glm::dvec3(u * 2000 - 1000, 0.02 * std::sin(900 * u * v), 1000 - v * 2000);
    }));
  }
  {
    ViewScene& s = scene("town_on_tiles");
    add_town(s);
    for (int k = 0; k < 400; ++k) {
      const double x = (k % 20 - 10) * 100.0, z = (k / 20 - 10) * 100.0;
      s.backdrop(PartMesh().quad({x, 0, z + 100}, {x + 100, 0, z + 100}, {x + 100, 0, z}, {x, 0, z}));
    }
  }
  {
    ViewScene& s = scene("town_and_plate_in_one_mesh");
    PartMesh all;
    for (int k = 0; k < 64; ++k) {
      const PartMesh one = house(k);
      const auto first = static_cast<std::uint32_t>(all.positions.size() / 3);
      all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
      for (const std::uint32_t i : one.indices) all.indices.push_back(first + i);
    }
    s.content(all.floor(1000.0, 0.0));
  }
  for (const auto& [name, radius, inwards] :
       {std::tuple{"town_under_dome", 3000.0, true}, std::tuple{"town_under_low_dome", 180.0, true},
        std::tuple{"town_in_ball_that_faces_out", 2000.0, false}}) {
    ViewScene& s = scene(name);
    add_town(s);
    s.backdrop(PartMesh().floor(radius, 0.0));
    s.backdrop(PartMesh().ball({0, 0, 0}, radius, inwards ? 0.0 : -1.0, inwards), !inwards);
  }
  {
    ViewScene& s = scene("town_with_mountains_and_clouds");
    add_town(s);
    s.backdrop(PartMesh().floor(900.0, 0.0));
    for (int k = 0; k < 24; ++k) {
      const double turn = k * std::numbers::pi / 12;
      const glm::dvec3 at(900 * std::sin(turn), 0, 900 * std::cos(turn)),
          side(120 * std::cos(turn), 0, -120 * std::sin(turn)), top(0, 160 + 40 * (k % 3), 0);
      s.backdrop(PartMesh().quad(at + side, at - side, at - side + top, at + side + top));
      const glm::dvec3 cloud = at * 0.6 + glm::dvec3(0, 400, 0);
      s.backdrop(PartMesh().quad(cloud - side, cloud + side, cloud + side * 0.9 + glm::dvec3(0, 8, 80),
                                 cloud - side + glm::dvec3(0, 8, 80)),
                 true);
    }
  }
  {
    ViewScene& s = scene("stray_vertex");
    PartMesh mesh = vase(1.0);
    mesh.corner({3e4, 5e3, -1e4});
    mesh.indices[3] = static_cast<std::uint32_t>(mesh.positions.size() / 3 - 1);
    s.content(mesh);
  }
  {
    ViewScene& s = scene("stray_pieces_far_away");
    add_town(s);
    s.backdrop(PartMesh().box({9e4, 0, 0}, {9e4 + 1, 1, 1}))
        .backdrop(PartMesh().box({0, -3e4, 2e4}, {1, -3e4 + 1, 2e4 + 1}));
  }
  {
    ViewScene& s = scene("town_on_earth_with_a_helper_at_the_origin", earth);
    add_town(s);
    s.place = glm::dvec3(0.0);
    s.backdrop(PartMesh().box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  }
  scene("backdrop_of_a_photographer")
      .content(vase(1.0))
      .backdrop(PartMesh().sheet(1, 16, [](double u, double v) {
        const double along = v * 8.0 - 4.0;
        return along < 0.0 ? glm::dvec3(u * 6 - 3, 0.0, -along - 1.5)
                           : glm::dvec3(u * 6 - 3, std::min(along, 4.0), -1.5 - 0.6 * std::min(along, 1.0));
      }));
  {
    ViewScene& s = scene("tree_on_plate");
    s.content(PartMesh().lathe({}, 4.0, [](double v) { return 0.35 - 0.2 * v; }));
    PartMesh leaves;
    for (int k = 0; k < 400; ++k) {
      const double turn = k * 2.4, up = 1.0 - 2.0 * (k + 0.5) / 400, out = 2.2 * std::sqrt(1 - up * up);
      const glm::dvec3 at(out * std::sin(turn), 5.0 + 2.2 * up, out * std::cos(turn)),
          a(0.3, 0.1 * (k % 3), 0.1), b(0.0, 0.25, 0.3);
      leaves.quad(at - a - b, at + a - b, at + a + b, at - a + b);
    }
    s.content(leaves, true).backdrop(PartMesh().floor(60.0, 0.0));
  }
  scene("terrain").content(land(600.0, 120, 2.0));
  {
    ViewScene& s = scene("village_on_land");
    for (int k = 0; k < 64; ++k) s.content(house(k, hills));
    s.backdrop(land(1000.0, 100, 1.0));
  }
  {
    ViewScene& s = scene("town_in_a_crater");
    add_town(s);
    PartMesh crater;
    s.backdrop(crater.sheet(120, 120,
                            [](double u, double v) {
                              const double x = (2 * u - 1) * 900.0, z = (1 - 2 * v) * 900.0;
                              return glm::dvec3(x, std::clamp((std::hypot(x, z) - 75.0) * 3.0, 0.0, 150.0),
                                                z);
                            }),
               true);
  }
  {
    ViewScene& s = scene("car");
    for (const double x : {-1.4, 1.4})
      for (const double z : {-0.75, 0.75}) {
        PartMesh wheel;
        wheel.sheet(20, 4, [&](double u, double v) {
          const double turn = 2 * std::numbers::pi * u, r = v < 0.3 || v > 0.8 ? 0.15 : 0.34;
          return glm::dvec3(x + r * std::cos(turn), 0.34 + r * std::sin(turn), z + (v - 0.5) * 0.25);
        });
        s.content(wheel, true);
      }
    const auto shell = [](double scale, bool inwards) {
      PartMesh body;
      body.sheet(30, 16, [=](double u, double v) {
        const double turn = 2 * std::numbers::pi * u, along = std::numbers::pi * v,
                     r = std::pow(std::sin(along), 0.35);
        const double y = std::sin(turn) * r;
        return glm::dvec3(-2.2 * scale * std::cos(along),
                          0.75 + scale * (y > 0 && std::abs(v - 0.55) < 0.22 ? 0.75 : 0.4) * y,
                          0.85 * scale * std::cos(turn) * r);
      });
      if (inwards) body.turn(0);
      return body;
    };
    s.content(shell(1.0, true), true).content(shell(0.93, false), true);
    for (const double z : {-0.4, 0.4})
      s.content(PartMesh().box({-0.2, 0.45, z - 0.25}, {0.3, 0.6, z + 0.25}), true);
    s.outside({-2.2, 0, -0.9}, {2.2, 1.6, 0.9});
  }
  {
    ViewScene& s = scene("room");
    s.content(PartMesh().box({-3, 0, -2.5}, {3, 2.7, 2.5}, true));
    add_furniture(s, 0.4, -0.8);
    s.inside({-3, 0, -2.5}, {3, 2.7, 2.5});
  }
  {
    ViewScene& s = scene("room_of_thick_walls");
    s.content(PartMesh().box({-4.2, -0.2, -3.2}, {4.2, 0, 3.2}))
        .content(PartMesh().box({-4.2, 2.8, -3.2}, {4.2, 3, 3.2}));
    for (const double side : {-1.0, 1.0}) {
      s.content(PartMesh().box({side > 0 ? 4 : -4.2, 0, -3}, {side > 0 ? 4.2 : -4, 2.8, 3}));
      s.content(PartMesh().box({-4.2, 0, side > 0 ? 3 : -3.2}, {4.2, 2.8, side > 0 ? 3.2 : -3}));
    }
    add_furniture(s, -1.5, 1.0);
    add_furniture(s, 1.8, -1.2);
    s.inside({-4, 0, -3}, {4, 2.8, 3});
  }
  {
    ViewScene& s = scene("corridor");
    s.content(PartMesh().quad({-1, 0, 20}, {1, 0, 20}, {1, 0, -20}, {-1, 0, -20}));
    s.content(PartMesh().quad({-1, 2.5, -20}, {1, 2.5, -20}, {1, 2.5, 20}, {-1, 2.5, 20}));
    s.content(PartMesh().quad({-1, 0, 20}, {-1, 0, -20}, {-1, 2.5, -20}, {-1, 2.5, 20}));
    s.content(PartMesh().quad({1, 0, -20}, {1, 0, 20}, {1, 2.5, 20}, {1, 2.5, -20}));
    for (int k = -4; k <= 4; ++k)
      s.content(PartMesh().box({-0.15, 2.4, k * 4.0 - 0.6}, {0.15, 2.46, k * 4.0 + 0.6}));
    s.inside({-1, 0, -20}, {1, 2.5, 20});
  }
  {
    ViewScene& s = scene("tunnel");
    s.content(PartMesh().sheet(16, 40, [](double u, double v) {
      const double turn = 2 * std::numbers::pi * u, along = (v - 0.5) * 1.2;
      const glm::dvec3 out(std::cos(along), 0, std::sin(along)), middle = 60.0 * out - glm::dvec3(60, -2, 0);
      return middle + 3.0 * (out * std::cos(-turn) + glm::dvec3(0, std::sin(-turn), 0));
    }));
    s.inside({-15, -1, -40}, {3, 5, 40});
  }
  {
    ViewScene& s = scene("level_of_rooms");
    for (int k = 0; k < 9; ++k) {
      const double x = (k % 3) * 9.0, z = (k / 3) * 9.0;
      s.content(PartMesh().box({x, 0, z}, {x + 8.5, 3.5, z + 8.5}, true));
      s.content(PartMesh().box({x + 3, 0, z + 4}, {x + 4, 1.2, z + 5})).content(vase(1.0, {x + 6, 0, z + 2}));
    }
    s.inside({0, 0, 0}, {26.5, 3.5, 26.5});
  }
  {
    ViewScene& s = scene("room_in_a_thin_shell_on_a_plate");
    s.content(PartMesh().box({-3, 0, -4}, {3, 2.6, 4}, true));
    s.content(PartMesh().box({-3.2, -0.2, -4.2}, {3.2, 2.8, 4.2}));
    s.content(PartMesh().box({-0.6, 0, -0.6}, {0.6, 0.75, 0.6})).backdrop(PartMesh().floor(60.0, -0.2));
    s.inside({-3, 0, -4}, {3, 2.6, 4});
  }
  {
    ViewScene& s = scene("house_on_lawn");
    s.content(PartMesh().box({-5, 0, -4}, {5, 3, 4})).backdrop(PartMesh().floor(20.0, 0.0));
    PartMesh roof;
    roof.quad({-5.5, 3, 4.5}, {5.5, 3, 4.5}, {5.5, 6, 0}, {-5.5, 6, 0})
        .quad({5.5, 3, -4.5}, {-5.5, 3, -4.5}, {-5.5, 6, 0}, {5.5, 6, 0});
    s.content(roof, true).content(PartMesh().box({-0.5, 0, 4}, {0.5, 2.1, 4.1}));
  }
  return scenes;
}

}  // namespace gnomon::test
