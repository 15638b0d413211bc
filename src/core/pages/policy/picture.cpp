// Which pages leave the fewest pixels misclassified? Where a shadow edge passes, a share of the pixel in
// proportion to m is expected to be wrong. A page is worth opening where it lessens m at the points in it,
// together and by weight, by more than its price: finest pages first, each for the points that none before
// serves. The price rises until the pool holds the pages.

#include <algorithm>

#include "geometry/usable.hpp"
#include "pages/fill.hpp"

namespace gnomon::page_policies {
namespace {

// Of a point where the last frame has no shadow edge: it may have missed one, and edges move. One of 1 gets
// texels an eighth as long for the same price, as by policy edges.
constexpr double kOffEdges = 1.0 / 64.0;
// Points whose weights are added up, of each kind. More change the pages of no scene by much.
constexpr std::size_t kSample = kPageWeights / 4;
// PagePoint::order of a point.
constexpr std::uint32_t kUnserved = 0, kServed = 1;

/// What the points of each page of one step weigh together.
class Weights {
 public:
  explicit Weights(const PageContext& c) noexcept : c_(c), table_(c.memory.weights) {}

  void begin(int step) noexcept {
    std::fill(table_.begin(), table_.end(), PageWeight{});
    entries_ = 0;
    for (int base = 0; base < c_.base_count; ++base)
      grid_[static_cast<std::size_t>(base)] = c_.grid(static_cast<std::uint32_t>(base * kLadder + step));
  }
  void add(const PagePoint& point, double weight) noexcept {
    const std::uint32_t key = key_of(point);
    PageWeight& entry = table_[index_of(key)];
    if (entry.key == 0 && entries_++ == kMaxEntries) return void(--entries_);
    entry.key = key;
    entry.weight += static_cast<float>(weight);
  }
  /// 0 where none was added.
  [[nodiscard]] double of(const PagePoint& point) const noexcept {
    return static_cast<double>(table_[index_of(key_of(point))].weight);
  }

 private:
  /// Never 0. Two pages with one key weigh as one: of thousands, hardly any.
  [[nodiscard]] std::uint32_t key_of(const PagePoint& point) const noexcept {
    const std::uint32_t base = point.level / kLadder;
    const PageGrid& g = grid_[base];
    const auto cell = [](double at, std::int32_t count) {
      return static_cast<std::int32_t>(clamp_to(at, 0.0, count - 1));
    };
    return page_hash(base, cell(point.x * g.scale.x + g.offset.x, g.columns),
                     cell(point.y * g.scale.y + g.offset.y, g.rows)) |
           1u;
  }
  [[nodiscard]] std::size_t index_of(std::uint32_t key) const noexcept {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = (key >> 1) & mask;
    while (table_[at].key != 0 && table_[at].key != key) at = (at + 1) & mask;
    return at;
  }

  // Always some are empty, whichever points are chosen.
  static constexpr std::size_t kMaxEntries = kPageWeights / 4 * 3;

  const PageContext& c_;
  std::span<PageWeight> table_;
  std::size_t entries_ = 0;
  std::array<PageGrid, kMaxMaps> grid_{};
};

/// How much points weigh, and which stand for all of their kind.
class Kinds {
 public:
  explicit Kinds(PageContext& c) noexcept : c_(c) {
    std::size_t count[2] = {};
    c.for_each_point([&](PagePoint&, std::size_t index) { ++count[at_edge(index)]; });
    const double weight[2] = {kOffEdges, 1.0};
    for (int kind = 0; kind < 2; ++kind) {
      const auto one_of = static_cast<std::uint32_t>(count[kind] / kSample + 1);
      last_[kind] = std::numeric_limits<std::uint32_t>::max() / one_of;
      stands_for_[kind] = weight[kind] * one_of;
    }
    weight_of_all_ = static_cast<double>(count[1]) + kOffEdges * static_cast<double>(count[0]);
  }
  /// What the point stands for: 0 for most where there are many. Of a scattered choice, as rows of pixels
  /// that are as long as a stride would be read in columns.
  [[nodiscard]] double sampled_weight(std::size_t index) const noexcept {
    const bool kind = at_edge(index);
    const std::uint32_t scattered = static_cast<std::uint32_t>(index) * 0x9E3779B1u;
    return scattered <= last_[kind] ? stands_for_[kind] : 0.0;
  }
  [[nodiscard]] double weight_of_all() const noexcept { return weight_of_all_; }

 private:
  [[nodiscard]] bool at_edge(std::size_t index) const noexcept {
    return c_.history.feedback.empty() || (c_.history.feedback[index] & kShadowEdge) != 0;
  }

  PageContext& c_;
  std::uint32_t last_[2] = {};
  double stands_for_[2] = {};
  double weight_of_all_ = 0.0;
};

void assign(PageContext& c) noexcept {
  c.set_steps_by_need();
  const double target = c.options.target_m;
  if (!(c.target > target)) return;
  const Kinds kinds(c);
  // A pool's pages have this weight in the mean: it makes c.target the m of such pages.
  const double weight_of_page = kinds.weight_of_all() / c.options.capacity;
  const double price = weight_of_page * (c.shrink[0] / c.shrink[1] - 1.0) * (c.target - target);
  double most = 0.0;
  c.for_each_point([&](PagePoint& point, std::size_t) {
    point.order = kUnserved;
    const double excess = c.excess(point);
    if (excess < kLargest) most = max_of(most, excess);
  });
  Weights weights(c);
  for (int step = c.step_for(most / target); step > 0; --step) {
    const double shrink = c.shrink[static_cast<std::size_t>(step)];
    const double before = c.shrink[static_cast<std::size_t>(step - 1)];
    weights.begin(step);
    c.for_each_point([&](const PagePoint& point, std::size_t index) {
      if (point.order != kUnserved) return;
      const double excess = c.excess(point), gain = excess * before - max_of(excess * shrink, target);
      const double weight = kinds.sampled_weight(index);
      if (gain > 0.0 && weight > 0.0) weights.add(point, weight * min_of(gain, kLargest));
    });
    c.for_each_point([&](PagePoint& point, std::size_t) {
      if (point.order != kUnserved || !(weights.of(point) > price)) return;
      point.order = kServed;
      c.set_step(point, step);
    });
  }
  c.for_each_point([&](PagePoint& point, std::size_t) {
    if (point.order == kUnserved) c.set_step(point, 0);
  });
}

}  // namespace

const PagePolicy picture{
    .name = "picture",
    .summary = "what lessens the pixels that are expected to be wrong most, for each page",
    .octaves = false,
    .shares_finer = true,
    .feedback = kShadowEdge,
    .assign = assign};

}  // namespace gnomon::page_policies
