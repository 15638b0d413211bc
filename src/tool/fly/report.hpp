// What a flight leaves behind: one row of numbers per frame, and one sheet of all pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/report/errors.hpp"

namespace gnomon::tool::fly {

/// The aliasing error over the pixels of a frame whose surface faces the light and lies in a map.
[[nodiscard]] report::PixelAliasing pixel_aliasing(const FloatImage& aliasing);

/// Pages of a frame.
struct PageCounts {
  int resident = 0;
  int drawn = 0;  ///< of them; the others were kept from earlier frames
  int levels = 0;
  double target_m = 0.0;  ///< error that they were opened for; larger than requested where the pool is small
};

/// All lights of a file in a frame.
struct LightCounts {
  int mapped = 0;             ///< lights that have maps
  int maps = 0;               ///< of all lights
  std::vector<char> in_view;  ///< as lights_in_view() has it
};

struct FrameRow {
  int frame = 0;
  PlanStatus status{};
  std::int64_t plan_ns = 0;
  render::FrameStats stats;
  report::PixelAliasing aliasing;
  std::optional<PageCounts> pages;         ///< in place of maps
  std::optional<LightCounts> lights;       ///< where all of a file shine
  std::array<double, kMaxMaps> m_bound{};  ///< of each map, over all that is in view; of all pages at once
  std::string warps;                       ///< of each map, with its kappa
  std::string omitted;                     ///< what the plan left out, and why
};

/// Names and strengths of the maps' warps, and the plan's omissions, as text for a row.
[[nodiscard]] std::string warps_text(const ShadowPlan& plan);
[[nodiscard]] std::string omitted_text(std::span<const Omission> omitted, const render::FrameStats& stats);

/// Pages over all frames, and how many of those after the first frame were kept from earlier ones.
struct PageSummary {
  double pages_per_frame = 0.0;
  double share_cached = 0.0;  ///< 0 for flights of one frame
};
[[nodiscard]] PageSummary page_summary(const std::vector<FrameRow>& rows);

/// Writes the table with columns for `cascades` maps: beside the target first, then renamed. Throws
/// std::runtime_error.
void write_csv(const std::vector<FrameRow>& rows, int cascades, bool software,
               const std::filesystem::path& file);

/// A list of objects, one per frame, with what the table has.
[[nodiscard]] nlohmann::ordered_json frames_json(const std::vector<FrameRow>& rows);

/// Small versions of some frames' pictures, evenly chosen: a column per frame, a row per kind of picture.
class ContactSheet {
 public:
  /// `rows`: names of the pictures of a frame.
  ContactSheet(int frames, int width, int height, std::vector<std::string> rows);
  /// True where this frame has a column.
  [[nodiscard]] bool wants(int frame) const;
  /// A picture for each row.
  void add(int frame, const std::vector<const Image*>& pictures);
  [[nodiscard]] Image sheet(const std::string& title) const;

 private:
  static constexpr int kMaxColumns = 8, kColumnWidth = 320;
  struct Column {
    int frame;
    std::vector<Image> pictures;
  };
  int frames_, thumb_width_, thumb_height_;
  std::vector<std::string> rows_;
  std::vector<Column> columns_;
};

/// One frame under several warps side by side: a column per warp, the picture above the aliasing error.
class WarpStrip {
 public:
  void add(const std::string& label, const Image& lit, const Image& heat);
  [[nodiscard]] Image strip(const std::string& title) const;

 private:
  static constexpr int kMaxColumnWidth = 420;
  struct Column {
    std::string label;
    Image lit, heat;
  };
  std::vector<Column> columns_;
};

}  // namespace gnomon::tool::fly
