// How large a map's square must be so that its slice fits from every direction.
#include "gnomon/options.hpp"
#include "gnomon/study/formulas.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "geometry/vector.hpp"

namespace gnomon {

namespace {

constexpr std::array<std::string_view, 4> kFitNames = {"tight", "rotated", "stable", "warped_stable"};

}  // namespace

std::string_view to_string(Fit fit) noexcept {
  return kFitNames[static_cast<std::size_t>(fit)];
}

bool fit_from_name(std::string_view name, Fit& fit) noexcept {
  for (std::size_t i = 0; i < kFitNames.size(); ++i) {
    if (kFitNames[i] != name) continue;
    fit = static_cast<Fit>(i);
    return true;
  }
  return false;
}

double longest_chord(double left, double right, double bottom, double top, bool orthographic, double begin,
                     double end) noexcept {
  const double near_scale = orthographic ? 1.0 : begin, far_scale = orthographic ? 1.0 : end;
  const double width = right - left, height = top - bottom;
  // Chords within the far plane, and between opposite corners of the near and far plane.
  double longest = far_scale * std::sqrt(width * width + height * height);
  const double xs[2] = {left, right}, ys[2] = {bottom, top};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double dx = far_scale * xs[j & 1] - near_scale * xs[i & 1];
      const double dy = far_scale * ys[j >> 1] - near_scale * ys[i >> 1];
      const double dz = end - begin;
      longest = max_of(longest, std::sqrt(dx * dx + dy * dy + dz * dz));
    }
  }
  return longest;
}

}  // namespace gnomon
