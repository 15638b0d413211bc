// Asks a filter's shader and its CPU reference the same questions.
#pragma once

#include <vector>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// A depth map of made-up depths.
struct TestMap {
  int width = 0, height = 0;
  std::vector<float> depth;
};
struct Question {
  glm::vec2 position{0.0f};
  float depth = 0.0f;
  glm::vec2 depth_gradient{0.0f};
};

/// Random depths and questions whose numbers are short binary fractions: float and double then compute the
/// same, and every comparison must turn out the same, ties too.
[[nodiscard]] TestMap random_map(int width, int height, unsigned seed);
[[nodiscard]] std::vector<Question> random_questions(const TestMap& map, int count, unsigned seed);

[[nodiscard]] std::vector<float> ask_shader(const Filter& filter, const FilterParameters& parameters,
                                            const TestMap& map, const std::vector<Question>& questions);
[[nodiscard]] std::vector<double> ask_reference(const Filter& filter, const FilterParameters& parameters,
                                                const TestMap& map, const std::vector<Question>& questions);

/// The shader's shadow_store for these depths, first channel.
[[nodiscard]] std::vector<float> stored_by_shader(const Filter& filter, const std::vector<float>& depths);

}  // namespace gnomon::render
