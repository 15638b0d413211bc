// Solids out of triangles: what builtin scenes are made of. Counter-clockwise outside, flat or smooth
// normals.
#include "mesh_builder.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gnomon::detail {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Two axes at right angles to `along` and each other, with across x side = along.
struct Frame {
  glm::dvec3 across, side;
};
Frame frame_about(const glm::dvec3& along) {
  const glm::dvec3 helper = std::abs(along.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(helper, along));
  return {across, glm::cross(along, across)};
}

}  // namespace

std::uint32_t MeshBuilder::vertex(const glm::dvec3& position, const glm::dvec3& normal,
                                  const glm::dvec2& texcoord) {
  positions.emplace_back(position);
  normals.emplace_back(normal);
  texcoords.emplace_back(texcoord);
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void MeshBuilder::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const glm::dvec3 normal = glm::normalize(glm::cross(c - a, d - b));
  const std::uint32_t i = vertex(a, normal, {0.0, 1.0});
  vertex(b, normal, {1.0, 1.0});
  vertex(c, normal, {1.0, 0.0});
  vertex(d, normal, {0.0, 0.0});
  triangle(i, i + 1, i + 2);
  triangle(i, i + 2, i + 3);
}

void MeshBuilder::box(const glm::dvec3& min, const glm::dvec3& max) {
  const auto p = [&](int x, int y, int z) {
    return glm::dvec3(x ? max.x : min.x, y ? max.y : min.y, z ? max.z : min.z);
  };
  quad(p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  quad(p(1, 0, 0), p(0, 0, 0), p(0, 1, 0), p(1, 1, 0));
  quad(p(1, 0, 1), p(1, 0, 0), p(1, 1, 0), p(1, 1, 1));
  quad(p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  quad(p(0, 1, 1), p(1, 1, 1), p(1, 1, 0), p(0, 1, 0));
  quad(p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
}

void MeshBuilder::bar(const glm::dvec3& a, const glm::dvec3& b, double width) {
  const auto [across, side] = frame_about(glm::normalize(b - a));
  const glm::dvec3 x = across * (width / 2.0), y = side * (width / 2.0);
  const glm::dvec3 corner[4] = {-x - y, x - y, x + y, -x + y};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    quad(a + corner[i], a + corner[j], b + corner[j], b + corner[i]);
  }
  quad(b + corner[0], b + corner[1], b + corner[2], b + corner[3]);
  quad(a + corner[3], a + corner[2], a + corner[1], a + corner[0]);
}

void MeshBuilder::cylinder(const glm::dvec3& a, const glm::dvec3& b, double ra, double rb, int sides) {
  const glm::dvec3 along = glm::normalize(b - a);
  const auto [across, side] = frame_about(along);
  const double length = glm::length(b - a);
  const auto ring = static_cast<std::uint32_t>(positions.size());
  for (int i = 0; i <= sides; ++i) {
    const double angle = kTurn * (i % sides) / sides, u = static_cast<double>(i) / sides;
    const glm::dvec3 out = across * std::cos(angle) + side * std::sin(angle);
    const glm::dvec3 normal = glm::normalize(out * length + along * (ra - rb));
    vertex(a + out * ra, normal, {u, 1.0});
    vertex(b + out * rb, normal, {u, 0.0});
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
    const std::uint32_t k = ring + 2 * i;
    triangle(k, k + 2, k + 3);
    if (rb > 0.0) triangle(k, k + 3, k + 1);
  }
  for (const bool top : {false, true}) {
    if (top && rb <= 0.0) continue;
    const glm::dvec3 center = top ? b : a, normal = top ? along : -along;
    const double radius = top ? rb : ra;
    const std::uint32_t hub = vertex(center, normal, {0.5, 0.5});
    for (int i = 0; i < sides; ++i) {
      const double angle = kTurn * i / sides;
      vertex(center + (across * std::cos(angle) + side * std::sin(angle)) * radius, normal, {0.5, 0.5});
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
      const std::uint32_t next = (i + 1) % static_cast<std::uint32_t>(sides);
      top ? triangle(hub, hub + 1 + i, hub + 1 + next) : triangle(hub, hub + 1 + next, hub + 1 + i);
    }
  }
}

void MeshBuilder::boulder(const glm::dvec3& center, double radius, double rough, int rings, int sides,
                          Random& random) {
  std::vector<std::vector<glm::dvec3>> grid;
  for (int r = 0; r <= rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    const bool pole = r == 0 || r == rings;
    std::vector<glm::dvec3> row;
    for (int s = 0; s < sides; ++s) {
      const double azimuth = kTurn * s / sides;
      const double reach = radius * (1.0 + (pole ? 0.0 : random.uniform(-rough, rough)));
      row.push_back(center + reach * glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                                std::sin(polar) * std::sin(azimuth)));
    }
    if (pole)
      row.assign(static_cast<std::size_t>(sides), center + glm::dvec3(0.0, r == 0 ? radius : -radius, 0.0));
    grid.push_back(row);
  }
  const auto face = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const std::uint32_t i = vertex(a, normal, {0.0, 0.0});
    vertex(b, normal, {1.0, 0.0});
    vertex(c, normal, {0.0, 1.0});
    triangle(i, i + 1, i + 2);
  };
  for (std::size_t r = 0; r < static_cast<std::size_t>(rings); ++r) {
    for (std::size_t s = 0; s < static_cast<std::size_t>(sides); ++s) {
      const std::size_t t = (s + 1) % static_cast<std::size_t>(sides);
      if (r > 0) face(grid[r][s], grid[r][t], grid[r + 1][s]);
      if (r + 1 < static_cast<std::size_t>(rings)) face(grid[r][t], grid[r + 1][t], grid[r + 1][s]);
    }
  }
}

void MeshBuilder::gable(const glm::dvec3& min, const glm::dvec3& max, double height) {
  const double y = min.y, mid = (min.x + max.x) / 2.0;
  const glm::dvec3 a(min.x, y, max.z), b(max.x, y, max.z), c(max.x, y, min.z), d(min.x, y, min.z);
  const glm::dvec3 front(mid, y + height, max.z), back(mid, y + height, min.z);
  quad(b, c, back, front);
  quad(d, a, front, back);
  quad(a, d, c, b);
  const auto end = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& top, double z) {
    const std::uint32_t i = vertex(p, {0.0, 0.0, z}, {0.0, 1.0});
    vertex(q, {0.0, 0.0, z}, {1.0, 1.0});
    vertex(top, {0.0, 0.0, z}, {0.5, 0.0});
    triangle(i, i + 1, i + 2);
  };
  end(a, b, front, 1.0);
  end(c, d, back, -1.0);
}

glm::dmat4 placed(const glm::dvec3& at, double turn_radians, const glm::dvec3& scale) {
  const double c = std::cos(turn_radians), s = std::sin(turn_radians);
  return {{c * scale.x, 0.0, -s * scale.x, 0.0},
          {0.0, scale.y, 0.0, 0.0},
          {s * scale.z, 0.0, c * scale.z, 0.0},
          {at.x, at.y, at.z, 1.0}};
}

glm::dmat4 placed(const glm::dvec3& at, double turn_radians, double scale) {
  return placed(at, turn_radians, glm::dvec3(scale));
}

}  // namespace gnomon::detail
