// What the papers on filters show, measured on scenes of our own: each figure as a table and as pictures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stage.hpp"

namespace gnomon::tool {

/// How large pictures and maps are. Small ones tell the same orders of filters, in seconds.
struct FigureSize {
  int width = 400, height = 300;  ///< of a picture
  int wide_map = 2048;            ///< texels along a side: of large scenes
  int narrow_map = 512;           ///< of small ones
  int true_map = 4096;            ///< that the truth is taken from
};

struct Panel {
  std::string caption;
  Image image;
  std::vector<float> off = {};  ///< light beyond that of the truth, by pixel; empty: not compared
};

struct Figure {
  std::string name, title;
  std::vector<std::string> columns;  ///< the first is that of the labels
  struct Row {
    std::string label;
    std::vector<double> values;
  };
  std::vector<Row> rows;
  std::vector<Panel> panels;

  /// The rectangle of the pictures, a fifth of their sides, in which the panels differ from the truth by
  /// most.
  struct Window {
    int x = 0, y = 0, width = 0, height = 0;  ///< pixels from the upper left corner; 0: nothing compared
  };
  [[nodiscard]] Window worst_window() const;
  /// The value of the first row of this label. Throws std::out_of_range.
  [[nodiscard]] double value(const std::string& label, std::size_t column = 0) const;
};

using CameraOf = std::function<Camera(int width, int height)>;

/// Near enough to the truth: the mean of 4 x 4 hard samples a pixel, out of a large map. -1 where no map
/// serves one of them.
[[nodiscard]] std::vector<float> true_visibility(FilterStage& stage, const CameraOf& camera,
                                                 const FigureSize& size);
/// Root of the mean squared difference, over the pixels that a map serves in both.
[[nodiscard]] double rms(const std::vector<float>& a, const std::vector<float>& b);

// After Annen et al., "Convolution Shadow Maps", 2007: figures 6, 9 and 10.
[[nodiscard]] Figure convolution_orders(const FigureSize& size);
[[nodiscard]] Figure bleeding_bars(const FigureSize& size);
[[nodiscard]] Figure bleeding_fence(const FigureSize& size);
[[nodiscard]] Figure minification(const FigureSize& size);
// After Annen et al., "Exponential Shadow Maps", 2008: table 3, figure 7, memory.
[[nodiscard]] Figure exponential_failures(const FigureSize& size);
[[nodiscard]] Figure matching_samples(const FigureSize& size);
[[nodiscard]] Figure memory_of_filters();
// After Gumbau et al., "Improving Shadow Map Filtering with Statistical Analysis", 2011: figures 3 and 2.
[[nodiscard]] Figure contacts(const FigureSize& size);
[[nodiscard]] Figure overlaps(const FigureSize& size);
/// Power law, variance and exponentials out of maps of half the resolution, with kernels as wide.
[[nodiscard]] Figure half_resolution(const FigureSize& size);
[[nodiscard]] Figure bits(const FigureSize& size);
/// All filters on one scene.
[[nodiscard]] Figure one_scene(const std::string& scene, const FigureSize& size);

}  // namespace gnomon::tool
