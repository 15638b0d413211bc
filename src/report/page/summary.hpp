// Rows gathered per scene and technique: what the charts and tables show.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/report/row.hpp"

namespace gnomon::report {

/// A number that the report can show of a technique. All are to be made small.
struct Measure {
  std::string_view key;     ///< in CSV and in the page's data
  std::string_view name;    ///< for people
  std::string_view unit;    ///< "%" for shares, which files hold as 0..1; "" for ratios
  std::string_view column;  ///< short, for the table's head
  bool is_cost = false;     ///< else it is an error
  double (*of)(const Row& row) = nullptr;
  /// How frames are gathered, and then scenes.
  enum class Gather : std::uint8_t { mean, largest } frames = Gather::mean;

  /// The value in `unit`.
  [[nodiscard]] double shown(double value) const noexcept { return unit == "%" ? 100.0 * value : value; }
  /// The value as text, with its percent sign where it is a share.
  [[nodiscard]] std::string text(double value) const;
};
[[nodiscard]] const std::vector<Measure>& measures();
/// Index into measures(). The key must be one of them.
[[nodiscard]] std::size_t measure_index(std::string_view key);

/// Views and scenes of fewer evaluated pixels decide nothing: one pixel would be a thousandth of all.
inline constexpr std::uint64_t kFewestPixels = 1000;

/// One technique on one scene.
struct Cell {
  bool measured = false;
  std::uint64_t pixels = 0;    ///< evaluated, of the frame that has the most
  std::vector<double> values;  ///< by measure
};

struct Summary {
  std::vector<std::string> scenes;  ///< the first stands for all of them together
  std::vector<std::string> titles;  ///< the same for people: files without folders, cameras without numbers
  std::vector<Technique> techniques;
  std::vector<std::vector<Cell>> cells;           ///< [scene][technique]
  std::vector<std::vector<std::size_t>> rows_of;  ///< [scene][row numbers], by frame; none for the first
  std::vector<std::string> filters, kinds;        ///< in the order they appear

  /// The number of a technique's filter, and of its kind.
  [[nodiscard]] std::size_t filter_of(const Technique& technique) const;
  [[nodiscard]] std::size_t kind_of(const Technique& technique) const;
  /// Techniques of a scene that no other beats in this error and cost, by rising cost.
  [[nodiscard]] std::vector<std::size_t> front(std::size_t scene, std::size_t error, std::size_t cost) const;
};

/// Errors of a scene are means over all of its evaluated pixels. Of all scenes together, errors are the mean
/// of the scenes and costs their geometric mean, over techniques that were measured on all of them. Scenes
/// with fewer than kFewestPixels have no part in it, unless all are such.
[[nodiscard]] Summary summarize(const std::vector<Row>& rows);

/// "church" for "../models/church/scene.gltf", and "far.json" for "path far.json 0123456789abcdef".
[[nodiscard]] std::string short_scene_name(const std::string& scene);

/// How a technique lays its maps, for people: its name without the filter.
[[nodiscard]] std::string parametrization_of(Technique technique);
/// The same text for rows of one plan. Filters share plans: what a plan left out counts with the first of
/// them.
[[nodiscard]] std::string plan_of(const Row& row);

inline constexpr std::string_view kDefaultError = "wrong", kDefaultCost = "total_ms";

}  // namespace gnomon::report
