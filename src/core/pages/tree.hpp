// Which pages lessen the expected error by more than they cost?
#pragma once

#include "pages/base.hpp"

namespace gnomon {

/// Chooses the pages of whole octaves for which the expected error and a price for each page are least
/// together. The coarsest level is taken to be open.
class PageTree {
 public:
  /// Takes samples of the visible points, unless context.memory holds them already.
  explicit PageTree(PageContext& context) noexcept;

  /// Sum of the weights of all samples: 1 for each visible point at a shadow edge.
  [[nodiscard]] double weight() const noexcept;
  /// Writes the pages to memory.pages, finest first, as far as there is room. Returns how many they are.
  std::size_t choose(double price) noexcept;

 private:
  // Depths of a tree: the root, and one for each octave.
  static constexpr int kDepths = 21;
  static_assert((kMaxVirtualTexels / kLeastPageTexels) >> (kDepths - 1) == 1);

  struct Range {
    std::size_t first, last;
  };
  /// Of a node, by the depth of the finest page that is open above it. Left open where no caller reads them.
  struct Costs {
    std::array<double, kDepths> least;   ///< error and price, with the pages that make them least
    std::array<double, kDepths> beside;  ///< error without any, where each sample counts by 1 / excess
  };

  [[nodiscard]] static std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] std::uint32_t level(std::uint32_t base, int depth) const noexcept {
    return base * kLadder + static_cast<std::uint32_t>(depth * c_.steps);
  }
  void take_samples() noexcept;
  void add_sample(const PagePoint& point, const glm::dvec2& place, bool edge) noexcept;
  [[nodiscard]] int depth_of(const Range& range) const noexcept;
  [[nodiscard]] int depth_of_leaf(const Range& range) const noexcept;
  [[nodiscard]] Range first_child(const Range& range, int depth) const noexcept;
  void add_errors(const Range& range, int first, int last, Costs& costs) const noexcept;
  [[nodiscard]] double cost_of_page(const Costs& costs, int depth, int above) const noexcept;
  void weigh(const Range& range, int last, Costs& costs) noexcept;
  void open(Range range, int above) noexcept;
  void open_page(const Range& range, int depth) noexcept;

  PageContext& c_;
  std::span<PageSample> samples_;
  std::size_t one_of_[2] = {1, 1};  // so many points has a sample: off edges, and at edges
  double weight_[2] = {};           // of a sample
  double side_pixels_ = 0.0;        // of the square for which a sample stands
  int deepest_ = 0;
  std::array<double, kDepths> root_shrink_{};  // of a sample's error at a depth
  double least_ = 0.0;                         // error of samples that have the target
  double price_ = 0.0;
  std::size_t pages_ = 0;
};

}  // namespace gnomon
