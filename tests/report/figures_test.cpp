// The survey's charts: do plans give the textbook's curves, and does storage fall as published?
#include "gnomon/report/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "gnomon/options.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::report {
namespace {

const StorageFigure::Line& line_of(const std::vector<StorageFigure::Line>& lines, Partition partition,
                                   const Warp* warp) {
  for (const StorageFigure::Line& line : lines) {
    if (line.scheme.partition == partition && line.scheme.warp == warp) return line;
  }
  throw std::runtime_error("no such line");
}

TEST(Figures, the_metric_gives_the_textbook_curves) {
  const ErrorCurves curves = error_curves();
  ASSERT_EQ(curves.curves.size(), 4u);
  int measured = 0;
  for (const ErrorCurves::Curve& curve : curves.curves) {
    ASSERT_EQ(curve.textbook.size(), curves.depth.size()) << curve.name;
    measured += !curve.measured.empty();
    for (std::size_t i = 0; i < curve.measured.size(); ++i)
      EXPECT_NEAR(curve.measured[i] / curve.textbook[i], 1.0, 1e-6)
          << curve.name << " at " << curves.depth[i];
  }
  EXPECT_EQ(measured, 3);
}

TEST(Figures, more_cascades_and_warps_need_less_storage) {
  const StorageFigure figure = storage_figure();
  for (const auto* lines : {&figure.overhead, &figure.behind}) {
    const auto &plain = line_of(*lines, Partition::view_depth, &warps::none).points,
               &warped = line_of(*lines, Partition::view_depth, &warps::optimal).points;
    ASSERT_EQ(plain.size(), static_cast<std::size_t>(kMaxMaps));
    ASSERT_EQ(warped.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_EQ(plain[i].maps, static_cast<int>(i) + 1);
      EXPECT_LE(warped[i].storage, plain[i].storage * 1.001) << i + 1;
      if (i > 0) {
        EXPECT_LT(plain[i].storage, plain[i - 1].storage);
      }
    }
  }
  // Overhead the one face that the light enters by is divided as cascades are; behind, three of four side
  // faces.
  for (const Warp* warp : {&warps::none, &warps::optimal}) {
    const auto &faces = line_of(figure.overhead, Partition::frustum_faces, warp).points,
               &cascades = line_of(figure.overhead, Partition::view_depth, warp).points;
    ASSERT_EQ(faces.size(), cascades.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      EXPECT_EQ(faces[i].maps, cascades[i].maps);
      EXPECT_NEAR(faces[i].storage / cascades[i].storage, 1.0, 0.02) << i;
    }
    const auto& behind = line_of(figure.behind, Partition::frustum_faces, warp).points;
    ASSERT_EQ(behind.size(), 2u);
    // Five faces pay with warps alone.
    EXPECT_EQ(behind[0].maps, warp == &warps::none ? 1 : 5);
    EXPECT_EQ(behind[1].maps, kMaxMaps);
    EXPECT_LT(behind[1].storage, 0.9 * behind[0].storage);
    EXPECT_GT(behind[1].storage, line_of(figure.behind, Partition::view_depth, warp).points.back().storage);
  }
  // Overhead one warped map needs about far over near, an unwarped one its square; the logarithmic map bounds
  // them all.
  const double limit = line_of(figure.overhead, Partition::view_depth, nullptr).points.front().storage;
  EXPECT_LT(line_of(figure.overhead, Partition::view_depth, &warps::optimal).points.front().storage, 2000.0);
  EXPECT_GT(line_of(figure.overhead, Partition::view_depth, &warps::none).points.front().storage, 1e6);
  for (const StorageFigure::Line& line : figure.overhead) {
    for (const StorageFigure::Point& point : line.points) EXPECT_GE(point.storage, limit) << line.scheme.name;
  }
  // Behind the viewer a map for each face of the frustum takes the part of warps.
  EXPECT_LT(line_of(figure.behind, Partition::frustum_faces, &warps::optimal).points.front().storage,
            0.01 * line_of(figure.behind, Partition::view_depth, &warps::optimal).points.front().storage);
}

TEST(Figures, are_written_and_refused_where_they_cannot_be) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "gnomon_figures";
  std::filesystem::remove_all(folder);
  const auto files = write_figures(folder);
  EXPECT_EQ(files.size(), 5u);
  for (const auto& file : files) EXPECT_GT(std::filesystem::file_size(file), 500u) << file;
  std::ofstream(folder / "file") << "in the way";
  EXPECT_THROW(write_figures(folder / "file" / "below"), ReportError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gnomon::report
