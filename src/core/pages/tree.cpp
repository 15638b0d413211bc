// Which pages lessen the expected error by more than they cost?
//
// Pages of whole octaves lie in a tree. The least cost of a node depends on the finest page open above it
// alone: it is the sum over the children, or the sum below a page of its own and the price of that. So one
// pass up from the leaves finds the cost for every depth of such a page, and one pass down opens the pages. A
// node with one child needs no page: the child's holds as many samples.
//
// Based on: Chou, Lookabaugh, Gray, "Optimal Pruning with Applications to Tree-Structured Source Coding and
// Modeling", 1989.
#include "pages/tree.hpp"

#include <algorithm>

#include "geometry/usable.hpp"
#include "geometry/z_order.hpp"

namespace gnomon {
namespace {

// Of a point where the last frame has no shadow edge: it may have missed one, and edges move.
constexpr double kOffEdges = 1.0 / 64.0;
// Most points with samples, of each kind. At an edge each has two.
constexpr std::size_t kMostPoints = kPageSamples / 3;
// Bits of a cell's column or row: a root has a few.
constexpr int kCellBits = 24;
// Share of a sample's pixels that a page as wide as its square does not hold, beside those that the places of
// samples account for: other surfaces lie between the points. 0.125 to 0.5 give about the same pictures.
constexpr double kBeside = 0.25;

/// Cell of a depth where the first cell of the root begins. So far off that products overflow, places are
/// rounding.
std::int64_t first_at(int depth, std::int64_t first_of_root) noexcept {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 40;
  return std::clamp(first_of_root, -kFarthest, kFarthest) * (std::int64_t{1} << depth);
}

bool at_edge(const PageContext& c, std::size_t index) noexcept {
  return c.history.feedback.empty() || (c.history.feedback[index] & kShadowEdge) != 0;
}

}  // namespace

PageTree::PageTree(PageContext& c) noexcept : c_(c), least_(std::sqrt(c.options.target_m)) {
  double most = 0.0;
  std::size_t count[2] = {};
  c.for_each_point([&](const PagePoint& point, std::size_t index) {
    const double excess = c.excess(point);
    if (excess < kLargest) most = max_of(most, excess);
    ++count[at_edge(c, index)];
  });
  deepest_ = std::min((c.step_for(most / c.options.target_m) + c.steps - 1) / c.steps, c.deepest / c.steps);
  for (int depth = 0; depth <= deepest_; ++depth)
    root_shrink_[at(depth)] = std::sqrt(c.shrink[level(0, depth)]);
  for (const int kind : {0, 1}) one_of_[kind] = count[kind] / kMostPoints + 1;
  weight_[0] = kOffEdges * static_cast<double>(one_of_[0]);
  weight_[1] = 0.5 * static_cast<double>(one_of_[1]);
  const double pixels = static_cast<double>(c.camera.width) * c.camera.height;
  side_pixels_ =
      std::sqrt(pixels * static_cast<double>(one_of_[1]) / max_of(static_cast<double>(c.point_count), 1.0));
  if (c.sample_count == 0) take_samples();
  samples_ = c.memory.samples.first(c.sample_count);
}

double PageTree::weight() const noexcept {
  double sum = 0.0;
  for (const PageSample& sample : samples_) sum += weight_[sample.at_edge];
  return sum;
}

void PageTree::take_samples() noexcept {
  for (int base = 0; base < c_.base_count; ++base) {
    for (int depth = 0; depth <= deepest_; ++depth) {
      const std::uint32_t of = level(static_cast<std::uint32_t>(base), depth);
      c_.memory.grids[of] = c_.grid(of);
    }
  }
  // Places in two opposite corners stand for a square: it deviates from its middle by 0.29 of its side.
  constexpr double kDeviation = 0.28867513459481287;
  const double half_page = 0.5 * c_.shrink[level(0, deepest_)];
  c_.for_each_point([&](const PagePoint& point, std::size_t index) {
    // A scattered choice: rows of pixels that are as long as a stride would be read in columns.
    const std::uint32_t scattered = static_cast<std::uint32_t>(index) * 0x9E3779B1u;
    const bool edge = at_edge(c_, index);
    if (scattered > std::numeric_limits<std::uint32_t>::max() / one_of_[edge]) return;
    const glm::dvec2 place(point.x, point.y);
    if (!edge) return add_sample(point, place, edge);
    const PageBase& base = c_.base_of(point.level);
    glm::dvec2 corner(min_of(kDeviation * side_pixels_ / point.need_x, half_page * base.side.x),
                      min_of(kDeviation * side_pixels_ / point.need_y, half_page * base.side.y));
    if ((index & 1) != 0) corner.y = -corner.y;
    add_sample(point, place - corner, edge);
    add_sample(point, place + corner, edge);
  });
  const auto taken = c_.memory.samples.first(c_.sample_count);
  // In one order: it decides the last bits of sums.
  std::sort(taken.begin(), taken.end(), [](const PageSample& a, const PageSample& b) {
    if (a.cell != b.cell) return a.cell < b.cell;
    return a.error != b.error ? a.error < b.error : a.at_edge < b.at_edge;
  });
}

void PageTree::add_sample(const PagePoint& point, const glm::dvec2& place, bool edge) noexcept {
  if (c_.sample_count == c_.memory.samples.size()) return;
  const std::uint32_t base = point.level / kLadder;
  const PageGrid &root = c_.memory.grids[level(base, 0)], &grid = c_.memory.grids[level(base, deepest_)];
  const auto cell = [&](double within, std::int32_t count, std::int64_t first, std::int64_t first_of_root) {
    const auto from_first = static_cast<std::int64_t>(clamp_to(within, 0.0, count - 1));
    const std::int64_t from_root = first + from_first - first_at(deepest_, first_of_root);
    return static_cast<std::uint64_t>(
        std::clamp(from_root, std::int64_t{0}, (std::int64_t{1} << kCellBits) - 1));
  };
  const std::uint64_t column =
      cell(place.x * grid.scale.x + grid.offset.x, grid.columns, grid.first_x, root.first_x);
  const std::uint64_t row =
      cell(place.y * grid.scale.y + grid.offset.y, grid.rows, grid.first_y, root.first_y);
  // The deepest level does not suffice for more than that, however much.
  const double most = 2.0 * least_ / root_shrink_[at(deepest_)];
  c_.memory.samples[c_.sample_count++] = {
      std::uint64_t{base} << (2 * kCellBits) | spread_bits(row) << 1 | spread_bits(column),
      static_cast<float>(min_of(std::sqrt(c_.excess(point)), most)), edge, 0};
}

/// Of the finest cell that holds all samples; below 0 where no page does.
int PageTree::depth_of(const Range& range) const noexcept {
  const std::uint64_t differ = samples_[range.first].cell ^ samples_[range.last - 1].cell;
  return deepest_ - (static_cast<int>(std::bit_width(differ)) + 1) / 2;
}

/// Samples in one cell of the deepest level: the coarsest at which all have the target.
int PageTree::depth_of_leaf(const Range& range) const noexcept {
  double most = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i) most = max_of(most, samples_[i].error);
  int depth = 0;
  while (depth < deepest_ && most * root_shrink_[at(depth)] > least_) ++depth;
  return depth;
}

/// Of a node with several children, or of the last of them.
PageTree::Range PageTree::first_child(const Range& range, int depth) const noexcept {
  const int shift = 2 * (deepest_ - depth - 1);
  const auto begin = samples_.begin() + static_cast<std::ptrdiff_t>(range.first);
  const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(range.last);
  const std::uint64_t cell = begin->cell >> shift;
  const auto last =
      std::partition_point(begin, end, [&](const PageSample& s) { return s.cell >> shift == cell; });
  return {range.first, static_cast<std::size_t>(last - samples_.begin())};
}

/// Without pages of their own, below pages of the depths first to last.
void PageTree::add_errors(const Range& range, int first, int last, Costs& costs) const noexcept {
  const double least_excess = c_.options.target_m;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double error = samples_[i].error, weight = weight_[samples_[i].at_edge];
    const double per_excess = 1.0 / max_of(error * error, least_excess);
    for (int above = first; above <= last; ++above) {
      const double there = weight * max_of(error * root_shrink_[at(above)], least_);
      costs.least[at(above)] += there;
      costs.beside[at(above)] += there * per_excess;
    }
  }
}

/// With a page of this depth. Pixels beside it have the page above.
double PageTree::cost_of_page(const Costs& costs, int depth, int above) const noexcept {
  // Half of the pixels at most, in pages that half the target suffices for: however far apart points are, a
  // page lessens the error.
  const double beside = min_of(kBeside * side_pixels_ * c_.per_page, 0.25 * c_.options.target_m);
  const double per_excess = beside / (root_shrink_[at(depth)] * root_shrink_[at(depth)]);
  return price_ + costs.least[at(depth)] + per_excess * (costs.beside[at(above)] - costs.beside[at(depth)]);
}

/// Costs below pages of the depths 0 to last.
void PageTree::weigh(const Range& range, int last, Costs& costs) noexcept {
  const int depth = depth_of(range);
  if (depth == deepest_) {
    const int fine = depth_of_leaf(range);
    const int most = std::max(last, fine);
    std::fill_n(costs.least.begin(), most + 1, 0.0);
    std::fill_n(costs.beside.begin(), most + 1, 0.0);
    add_errors(range, 0, last, costs);
    if (fine > last) add_errors(range, fine, fine, costs);
    for (int above = 0; above <= last && above < fine; ++above)
      costs.least[at(above)] = min_of(costs.least[at(above)], cost_of_page(costs, fine, above));
    return;
  }
  const int all = std::max(depth, 0);
  const Range first = first_child(range, depth);
  weigh(first, all, costs);
  for (Range child = first; child.last < range.last;) {
    child = first_child({child.last, range.last}, depth);
    Costs of_child;
    weigh(child, all, of_child);
    for (int above = 0; above <= all; ++above) {
      costs.least[at(above)] += of_child.least[at(above)];
      costs.beside[at(above)] += of_child.beside[at(above)];
    }
  }
  std::uint32_t opens = 0;
  for (int above = 0; above < depth && above <= last; ++above) {
    const double own = cost_of_page(costs, depth, above);
    if (!(own < costs.least[at(above)])) continue;
    opens |= 1u << above;
    costs.least[at(above)] = own;
  }
  // The first sample of the second child is that of no other node.
  samples_[first.last].opens = opens & ((1u << kDepths) - 1);
}

void PageTree::open(Range range, int above) noexcept {
  const int depth = depth_of(range);
  if (depth == deepest_) {
    const int fine = depth_of_leaf(range);
    if (above >= fine) return;
    Costs costs;
    for (const int d : {above, fine}) {
      costs.least[at(d)] = costs.beside[at(d)] = 0.0;
      add_errors(range, d, d, costs);
    }
    if (cost_of_page(costs, fine, above) < costs.least[at(above)]) open_page(range, fine);
    return;
  }
  Range child = first_child(range, depth);
  if ((samples_[child.last].opens >> above & 1u) != 0) {
    open_page(range, depth);
    above = depth;
  }
  for (open(child, above); child.last < range.last; open(child, above))
    child = first_child({child.last, range.last}, depth);
}

/// The page of this depth that holds all samples. Half points are counted: one at an edge has two samples.
void PageTree::open_page(const Range& range, int depth) noexcept {
  const std::uint64_t first = samples_[range.first].cell;
  const auto base = static_cast<std::uint32_t>(first >> (2 * kCellBits));
  const std::uint64_t place = first & ((std::uint64_t{1} << (2 * kCellBits)) - 1);
  const std::uint32_t of = level(base, depth);
  const PageGrid &root = c_.memory.grids[level(base, 0)], &grid = c_.memory.grids[of];
  const auto cell = [&](std::uint64_t deepest, std::int64_t first_of_root, std::int64_t first_of_level,
                        std::int32_t count) {
    const std::int64_t from_root = static_cast<std::int64_t>(deepest >> (deepest_ - depth));
    const std::int64_t from_first = from_root + first_at(depth, first_of_root) - first_of_level;
    return static_cast<std::int32_t>(std::clamp(from_first, std::int64_t{0}, std::int64_t{count} - 1));
  };
  std::size_t halves = 0;
  for (std::size_t i = range.first; i < range.last; ++i)
    halves += samples_[i].at_edge ? one_of_[1] : 2 * one_of_[0];
  if (pages_ < c_.memory.pages.size())
    c_.memory.pages[pages_] = {of, cell(gathered_bits(place), root.first_x, grid.first_x, grid.columns),
                               cell(gathered_bits(place >> 1), root.first_y, grid.first_y, grid.rows), 0,
                               static_cast<std::uint32_t>(halves)};
  ++pages_;
}

std::size_t PageTree::choose(double price) noexcept {
  price_ = price;
  pages_ = 0;
  if (samples_.empty()) return 0;
  const Range all{0, samples_.size()};
  Costs costs;
  weigh(all, 0, costs);
  open(all, 0);
  const auto chosen = c_.memory.pages.first(std::min(pages_, c_.memory.pages.size()));
  // Finest first, and bases from the last to the first, as pages of points are opened.
  const auto key = [](const Page& p) {
    return std::array<std::int64_t, 4>{p.level % kLadder, p.level, p.row, p.column};
  };
  std::sort(chosen.begin(), chosen.end(), [&](const Page& a, const Page& b) { return key(b) < key(a); });
  if (pages_ > chosen.size()) return pages_;
  // Leaves may have opened the same page, where finer ones serve them no better. Libraries sort equal ones in
  // orders of their own.
  std::size_t count = 0;
  for (const Page& page : chosen) {
    if (count > 0 && key(chosen[count - 1]) == key(page))
      chosen[count - 1].points += page.points;
    else
      chosen[count++] = page;
  }
  for (Page& page : chosen.first(count)) page.points = (page.points + 1) / 2;
  return count;
}

}  // namespace gnomon
