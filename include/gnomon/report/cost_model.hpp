// The cost model of a machine: fitted to measurements, kept in a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gnomon/study/technique.hpp"

namespace gnomon::report {

/// Predicted work and measured times of one technique on one frame.
struct Observation {
  std::string view;    ///< scene, frame and light: what errors can be compared within
  std::string filter;  ///< with its options
  bool pages = false;  ///< drawn by pages, which have costs of their own
  PlanWork work;       ///< predicted
  double megapixels = 0.0, bytes_per_texel = 4.0;  ///< of the frame; of everything that is kept
  double frame_ms = 0.0, depth_ms = 0.0, prefilter_ms = 0.0, lookup_ms = 0.0;  ///< measured, milliseconds
  double kernel_texels = 0.0;                                                  ///< FilterCost::kernel_texels
  FilterExtent extent = {};                                                    ///< FilterCost::extent
  /// The filter takes comparisons of depths, or averages them over its kernel: what expected_error counts.
  bool compares = true;
  double expected = 0.0;  ///< share of the pixels that this kernel misclassifies, predicted: expected_error
  double wrong = 0.0;     ///< share of the pixels on the wrong side of one half, measured
  double pixels = 0.0;    ///< that `wrong` is a share of: those that the light could reach
};

/// Costs of maps, or of pages.
struct StoredCosts {
  DrawingCosts drawing;  ///< milliseconds per unit of work
  /// One filter's cost, with its name.
  struct Filter {
    std::string name;  ///< with its options
    FilterCost cost;   ///< its name is empty
  };
  std::vector<Filter> filters;  ///< at least one, but where nothing was measured
  double depth_error = 0.0, prefilter_error = 0.0, lookup_error = 0.0;  ///< mean relative error of the fit
};

/// A CostModel that owns its names: the costs of maps, and beside them those of pages.
struct StoredCostModel : StoredCosts {
  std::string machine;  ///< renderer and CPU it was measured on
  StoredCosts pages;    ///< no filters: not measured

  /// Views into this object, which must outlive them. `costs` is where the filters go.
  [[nodiscard]] CostModel view(std::vector<FilterCost>& costs) const;
};

/// Least squares of relative errors, no cost below zero. error_power is the slope of log wrong over log
/// expected within views and filters. It is one for all filters that compare, as bias and relief, which
/// expected_error does not know, are common to them. Others leak as well, and have one of their own. A
/// filter's error_ratio is its mean over the views. Pages are fitted apart. Throws ReportError for fewer than
/// eight observations of maps, and for fewer than eight of pages where there are any.
[[nodiscard]] StoredCostModel fit_costs(std::span<const Observation> observations, std::string machine);

/// The time of a frame's shadows by the model, milliseconds; infinite for a filter that it does not know with
/// maps, or with pages.
[[nodiscard]] double predicted_ms(const StoredCostModel& model, const Observation& observation) noexcept;

/// Coefficients >= 0 that make sum over rows of ((features . x - value) / value)^2 least; rows whose value is
/// not above zero do not count. Each row holds one feature per coefficient.
[[nodiscard]] std::vector<double> least_squares(std::span<const std::vector<double>> rows,
                                                std::span<const double> values);

/// Throw ReportError with the file's name and what is wrong.
void save_cost_model(const StoredCostModel& model, const std::filesystem::path& file);
[[nodiscard]] StoredCostModel load_cost_model(const std::filesystem::path& file);

}  // namespace gnomon::report
