// Two charts of the survey, drawn from plans that this library makes: how far techniques get without a scene.
#pragma once

#include <filesystem>
#include <vector>

#include "gnomon/extend/warp.hpp"
#include "gnomon/options.hpp"

namespace gnomon::report {

/// Maps over the whole view of a square camera, 60 degrees, far over near 1000, measured.
/// Based on: Scherzer, Wimmer, Purgathofer, "A Survey of Real-Time Hard Shadow Mapping Methods", 2011, Figure
/// 18; after Lloyd et al., "Logarithmic Perspective Shadow Maps", 2008.
struct StorageFigure {
  /// How one line divides the view, and whether it warps.
  struct Scheme {
    const char* name;     ///< as in the legend
    Partition partition;  ///< view_depth: logarithmic splits; frustum_faces: side faces in logarithmic slices
    const Warp* warp;     ///< of each map; nullptr: the limit of one logarithmic perspective map
  };
  /// Storage by number of maps.
  struct Point {
    int maps;        ///< that the plan has
    double storage;  ///< texels per screen pixel at which no texel covers more than one pixel
  };
  /// A scheme's line, by increasing number of maps; one point where the number is not to choose.
  /// frustum_faces has a point for each number of slices (SplitOptions::face_slices) that gives another
  /// number of maps.
  struct Line {
    Scheme scheme;              ///< that the points are of
    std::vector<Point> points;  ///< at least one
  };
  std::vector<Line> overhead;  ///< the light comes from above
  std::vector<Line> behind;    ///< the light comes from behind the viewer, along the view
};
/// Plans and measures, a second of work.
[[nodiscard]] StorageFigure storage_figure();

/// The error along the view under an overhead light, dp/ds, of four warps: the textbook's curve and what the
/// metric says of planned maps. Both are relative to the same unit: the unwarped map's textbook error at the
/// near plane counts (far - near) / near.
/// Based on: the same survey, section 3 and Figure 12.
struct ErrorCurves {
  /// One warp's error.
  struct Curve {
    const char* name;              ///< as in the legend
    std::vector<double> textbook;  ///< by depth
    std::vector<double> measured;  ///< by depth; empty: no such map can be planned
  };
  double near_depth, far_depth;  ///< world units
  std::vector<double> depth;     ///< view depths, world units
  std::vector<Curve> curves;     ///< uniform, psm, lispsm, logarithmic
};
/// Plans and measures.
[[nodiscard]] ErrorCurves error_curves();

/// Writes into `folder`, which is made where it is missing,
///   storage_overhead.svg, storage_behind.svg, storage.csv   the storage factor by number of maps,
///   error_by_depth.svg, error_by_depth.csv                  dp/ds by depth.
/// Files that are there already are replaced, each as a whole. Throws ReportError. Returns the files.
std::vector<std::filesystem::path> write_figures(const std::filesystem::path& folder);

}  // namespace gnomon::report
