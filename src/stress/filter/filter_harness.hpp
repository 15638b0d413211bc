// Asks a filter's shader and its CPU reference the same questions, through the passes that the renderer runs.
#pragma once

#include <cstdint>
#include <vector>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// A depth map of made-up depths.
struct TestMap {
  int width = 0, height = 0;
  std::vector<float> depth;
  std::vector<glm::vec2> silhouette = {};                ///< FilterLookup::silhouette; empty: none anywhere
  [[nodiscard]] double at(int x, int y) const noexcept;  ///< 1 outside
  [[nodiscard]] glm::dvec2 silhouette_at(int x, int y) const noexcept;
};
struct Question {
  glm::vec2 position{0.0f};
  float depth = 0.0f;
  glm::vec2 depth_gradient{0.0f};
  float rotation = 0.0f;
  glm::vec2 pixel{0.0f};  ///< FilterLookup::pixel
  glm::vec2 ends_below{0.0f}, ends_above{0.0f}, longer_below{0.0f}, longer_above{0.0f};  ///< of FilterLookup
};

/// Every question stands in a parallel light, 10 world units of depth over the map's range, 8 texels to a
/// unit.
inline constexpr double kTestDepthRange = 10.0, kTestTexelsPerWorld = 8.0;
[[nodiscard]] FilterLookup lookup_of(const FilterSettings& settings, const TestMap& map,
                                     const Question& question);

/// Random depths and questions whose numbers are short binary fractions: float and double then compute the
/// same, and every comparison must turn out the same, ties too.
[[nodiscard]] TestMap random_map(int width, int height, unsigned seed);
/// At least `rim` texels inside of the map; negative: some outside, where everything is lit.
[[nodiscard]] std::vector<Question> random_questions(const TestMap& map, int count, unsigned seed,
                                                     int rim = -4);

/// The shader's answers: the map goes through everything that the filter stores and blurs.
[[nodiscard]] std::vector<float> ask_shader(const FilterSettings& settings, const TestMap& map,
                                            const std::vector<Question>& questions);
/// The shader's answers when the lookup finds these texels, one per question.
[[nodiscard]] std::vector<float> ask_shader(const FilterSettings& settings,
                                            const std::vector<StoredTexel>& texels,
                                            const std::vector<Question>& questions);
/// The shader's shadow_store of these depths and slopes.
[[nodiscard]] std::vector<StoredTexel> stored_by_shader(const FilterSettings& settings,
                                                        const std::vector<float>& depths,
                                                        const std::vector<glm::vec2>& slopes);

/// What the reference stores: what the format holds, or the very numbers, which no format does.
enum class Storing : std::uint8_t { rounded, exact };

/// The same by the CPU reference, in double, rounded to the stored format where the passes round, unless the
/// exact answer is asked for. Without mip-maps.
class Reference {
 public:
  Reference(const FilterSettings& settings, const TestMap& map, Storing storing = Storing::rounded);
  [[nodiscard]] StoredTexel texel(const glm::dvec2& position) const;  ///< as a lookup there finds it
  [[nodiscard]] double answer(const Question& question) const;
  /// How far the shader may be off: what the answer changes by when each channel and the receiver's depth do
  /// by what storing, adding up and the hardware's weights round.
  [[nodiscard]] double bound(const Question& question) const;

 private:
  struct Weighed {
    const StoredTexel* texel = nullptr;
    double weight = 0.0;
    glm::dvec2 position{0.0};  ///< of its centre
  };
  /// The question, where its receiver's plane passes a texel.
  [[nodiscard]] Question moved_to(const Weighed& corner, Question question) const;
  /// The four texels about a place, with their bilinear weights.
  [[nodiscard]] std::array<Weighed, 4> corners(const glm::dvec2& position) const;
  /// bound(), where the look-up finds `here`.
  [[nodiscard]] double bound_of(const StoredTexel& here, const Question& question) const;
  [[nodiscard]] StoredTexel stored(int x, int y) const;
  [[nodiscard]] StoredTexel rounded(StoredTexel texel) const noexcept;
  void join(StoredTexel& sum, const StoredTexel& texel, double weight) const;
  [[nodiscard]] StoredTexel nothing() const;
  [[nodiscard]] StoredTexel mean_of_box(const glm::dvec2& position, const glm::dvec2& half_sides) const;
  /// `change`: added to every further texel that the lookup finds.
  [[nodiscard]] double value(const StoredTexel& texel, const Question& question,
                             const StoredTexel& change) const;

  FilterSettings settings_;
  const TestMap& map_;
  bool exact_;
  std::vector<StoredTexel> blurred_;
};
[[nodiscard]] std::vector<double> ask_reference(const FilterSettings& settings, const TestMap& map,
                                                const std::vector<Question>& questions);

/// "NAME:KEY=VALUE,.."; throws std::runtime_error where it is not understood.
[[nodiscard]] FilterSettings settings_from(std::string_view text);

/// The value of an option, to be set to one that text cannot say; throws std::runtime_error where the filter
/// has none of that name.
[[nodiscard]] double& option_named(FilterSettings& settings, std::string_view name);

}  // namespace gnomon::render
