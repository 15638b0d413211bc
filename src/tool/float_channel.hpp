// Channels of an image, as a list of its pixels.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/scene/image.hpp"

namespace gnomon::tool {

/// The channel `index` of each pixel, in their order.
[[nodiscard]] inline std::vector<float> channel(const FloatImage& image, std::size_t index) {
  const auto stride = static_cast<std::size_t>(image.channels);
  std::vector<float> values;
  values.reserve(image.values.size() / stride);
  for (std::size_t i = index; i < image.values.size(); i += stride) values.push_back(image.values[i]);
  return values;
}

/// The first three channels of each pixel.
[[nodiscard]] inline std::vector<glm::vec3> vectors_of(const FloatImage& image) {
  std::vector<glm::vec3> vectors;
  for (std::size_t i = 0; i < image.values.size(); i += static_cast<std::size_t>(image.channels))
    vectors.emplace_back(image.values[i], image.values[i + 1], image.values[i + 2]);
  return vectors;
}

}  // namespace gnomon::tool
