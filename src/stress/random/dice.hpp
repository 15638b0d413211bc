// Random numbers that are the same everywhere, and what the parts of a random case are placed by.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/random.hpp"

namespace gnomon::stress {

/// Random numbers without the C library's functions, whose last bits differ from one to the next.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double unit() { return random_.unit(); }
  double between(double low, double high) { return random_.between(low, high); }
  int pick(int count) { return random_.pick(count); }
  bool chance(double share) { return unit() < share; }
  /// 2 to a power between these, up to the shape between whole powers.
  double power(double low, double high) {
    const double exponent = between(low, high), whole = std::floor(exponent);
    return std::ldexp(1.0 + (exponent - whole), static_cast<int>(whole));
  }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// In a cube from -1 to 1.
  glm::dvec3 vector() {
    const double x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(-1.0, 1.0);
    return {x, y, z};
  }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v = vector();
      const double square = glm::dot(v, v);
      if (square > 0.01 && square < 1.0) return v / std::sqrt(square);
    }
  }
  glm::dvec3 axis() {
    glm::dvec3 v(0.0);
    v[pick(3)] = sign();
    return v;
  }
  template <std::size_t N>
  std::string_view name(const std::string_view (&names)[N]) {
    return names[static_cast<std::size_t>(pick(static_cast<int>(N)))];
  }

 private:
  Random random_;
};

/// What the parts of a case are placed by.
struct Stage {
  glm::dvec3 eye{0.0}, forward{0.0, 0.0, -1.0}, right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0};
  bool orthographic = false;
  double left = -1.0, right_edge = 1.0, bottom = -1.0, top = 1.0;
  double near_depth = 0.1, far_depth = 100.0;
  bool stiff = false;
  glm::dvec3 light{0.0};  ///< its position, or the unit way that it travels
  bool parallel = true;
  double range = 0.0;
};

/// The options of a plan, as a case file has them.
[[nodiscard]] nlohmann::ordered_json draw_options(Dice& dice, const Stage& stage);

}  // namespace gnomon::stress
