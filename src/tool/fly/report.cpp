// Tables and contact sheets.
#include "report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "base/whole_file.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/report/csv.hpp"

namespace gnomon::tool::fly {
namespace {

using render::Color;
using render::Pass;
using report::csv_field;

constexpr Color kPaper{24, 24, 28}, kInk{240, 240, 236};
constexpr int kGap = 4, kLabel = 16;  // pixels

constexpr int kLine = 12;  // pixels from one line of small text to the next

/// The text in small letters on as many lines as it takes, broken at spaces where there are some.
std::vector<std::string> broken_lines(const std::string& text, int room) {
  const int step = render::text_width("xx") - render::text_width("x");  // a glyph and its gap
  const auto longest = static_cast<std::size_t>(std::max(1, room / step));
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(begin + longest, text.size());
    const std::size_t space = text.rfind(' ', end);
    if (end < text.size() && space != std::string::npos && space > begin) end = space;
    lines.push_back(text.substr(begin, end - begin));
    begin = std::min(text.find_first_not_of(' ', end), text.size());
  }
  return lines;
}

void draw_lines(Image& image, int x, int y, const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    render::draw_text(image, x, y + static_cast<int>(i) * kLine, lines[i], kInk);
}

/// A title that is not cut off: in large letters where they fit on one line, else in small ones.
struct Heading {
  std::string large;
  std::vector<std::string> small;

  Heading(const std::string& title, int width) {
    const int room = width - 4 * kGap;
    if (render::text_width(title, 2) <= room)
      large = title;
    else
      small = broken_lines(title, room);
  }
  [[nodiscard]] int height() const {
    return small.empty() ? 2 * kLabel : kGap + static_cast<int>(small.size()) * kLine;
  }
  void draw(Image& image) const {
    render::draw_text(image, 2 * kGap, 2 * kGap, large, kInk, 2);
    draw_lines(image, 2 * kGap, kGap, small);
  }
};

std::string header(int cascades, bool software) {
  std::string line = "frame,plan_status,plan_ns,";
  for (std::size_t p = 0; p < render::kPassCount; ++p) {
    line += fmt::format("{}_{}ms,", to_string(static_cast<Pass>(p)), software ? "software_wall_clock_" : "");
  }
  line +=
      "maps,texels,m_p50,m_p95,m_max,share_undersampled,pixels_measured,pages,pages_drawn,pages_kept,camera_"
      "triangles,camera_draws,";
  for (int i = 0; i < cascades; ++i)
    line += fmt::format(
        "map{0}_triangles,map{0}_draws,map{0}_instances,map{0}_texels,map{0}_age,map{0}_m_bound,", i);
  for (const PruneRuleInfo& rule : prune_rules())
    line += fmt::format("{0}_saved_texels,{0}_saved_triangles,", rule.name);
  return line + "prefilter_passes,warps,omitted\n";
}

/// Statistics of pages, and of many lights, are those of one map.
int maps_of(const FrameRow& row) {
  return row.pages ? 0 : row.lights ? row.lights->maps : row.stats.map_count;
}

std::string line_of(const FrameRow& row, int cascades) {
  std::string line = fmt::format("{},{},{},", row.frame, to_string(row.status), row.plan_ns);
  for (const double ms : row.stats.milliseconds) line += fmt::format("{:.3f},", ms);
  line += fmt::format("{},{},", maps_of(row), row.stats.texels);
  line += row.lights ? ",,,,,"
                     : fmt::format("{:.5g},{:.5g},{:.5g},{:.5f},{},", row.aliasing.p50, row.aliasing.p95,
                                   row.aliasing.max, row.aliasing.share_undersampled, row.aliasing.pixels);
  line += row.pages ? fmt::format("{},{},{},", row.pages->resident, row.pages->drawn,
                                  row.pages->resident - row.pages->drawn)
                    : ",,,";
  line += fmt::format("{},{},", row.stats.camera.triangles, row.stats.camera.draws);
  for (int i = 0; i < cascades; ++i) {
    const render::MapStats& map = row.stats.map[static_cast<std::size_t>(i)];
    line +=
        i < row.stats.map_count
            ? fmt::format("{},{},{},{},{},{},", map.triangles, map.draws, map.instances, map.texels, map.age,
                          row.lights ? "" : fmt::format("{:.5g}", row.m_bound[static_cast<std::size_t>(i)]))
            : ",,,,,,";
  }
  for (const PruneSaving& saved : row.stats.saved)
    line += fmt::format("{},{},", saved.texels, saved.triangles);
  line += fmt::format("{},", row.stats.prefilter_passes);
  return line + csv_field(row.warps) + "," + csv_field(row.omitted) + "\n";
}

}  // namespace

report::PixelAliasing pixel_aliasing(const FloatImage& aliasing) {
  std::vector<float> m;
  m.reserve(aliasing.values.size() / 4);
  for (std::size_t i = 0; i < aliasing.values.size(); i += 4)
    m.push_back(aliasing.values[i + 3] < 0.0f ? 0.0f : aliasing.values[i]);
  return report::pixel_aliasing(m);
}

std::string warps_text(const ShadowPlan& plan) {
  std::string text;
  for (const ShadowMap& map : plan.maps()) {
    text += fmt::format("{}{} {:.4g}", text.empty() ? "" : "; ", map.warp->name, map.kappa);
  }
  return text;
}

std::string omitted_text(std::span<const Omission> omitted, const render::FrameStats& stats) {
  std::string text;
  for (const Omission& omission : omitted) {
    const OmissionText words = describe(omission);
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", words.what.data(), words.why.data());
  }
  for (const PruneRuleInfo& rule : prune_rules()) {
    const PruneSaving& saved = stats.saved[static_cast<std::size_t>(rule.rule)];
    // The plan's own omissions are listed above, map by map.
    const bool of_plan = rule.rule == PruneRule::empty_cascades ||
                         rule.rule == PruneRule::casterless_cascades || rule.rule == PruneRule::empty_faces ||
                         rule.rule == PruneRule::casterless_faces || rule.rule == PruneRule::equal_cascades ||
                         rule.rule == PruneRule::metric_resolution;
    if (of_plan || (saved.instances == 0 && saved.texels == 0)) continue;
    text += fmt::format("{}{}: {} instances, {} triangles, {} texels", text.empty() ? "" : "; ", rule.what,
                        saved.instances, saved.triangles, saved.texels);
  }
  return text;
}

PageSummary page_summary(const std::vector<FrameRow>& rows) {
  PageSummary summary;
  double resident = 0.0, cached = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].pages) continue;
    const PageCounts& pages = *rows[i].pages;
    summary.pages_per_frame += pages.resident / static_cast<double>(rows.size());
    if (i == 0) continue;  // nothing can be kept yet
    resident += pages.resident;
    cached += pages.resident - pages.drawn;
  }
  if (resident > 0.0) summary.share_cached = cached / resident;
  return summary;
}

void write_csv(const std::vector<FrameRow>& rows, int cascades, bool software,
               const std::filesystem::path& file) {
  std::string text = header(cascades, software);
  for (const FrameRow& row : rows) text += line_of(row, cascades);
  const std::string why = write_whole_file(file, text);
  if (!why.empty()) throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), why));
}

nlohmann::ordered_json frames_json(const std::vector<FrameRow>& rows) {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const FrameRow& row : rows) {
    nlohmann::ordered_json ms = nlohmann::ordered_json::object();
    for (std::size_t p = 0; p < render::kPassCount; ++p)
      ms[std::string(to_string(static_cast<Pass>(p)))] = row.stats.milliseconds[p];
    nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
    for (int i = 0; i < row.stats.map_count; ++i) bounds.push_back(row.m_bound[static_cast<std::size_t>(i)]);
    frames.push_back({{"frame", row.frame},
                      {"status", std::string(to_string(row.status))},
                      {"plan_ns", row.plan_ns},
                      {"ms", ms},
                      {"maps", maps_of(row)},
                      {"texels", row.stats.texels},
                      {"m",
                       {{"p50", row.aliasing.p50},
                        {"p95", row.aliasing.p95},
                        {"max", row.aliasing.max},
                        {"share_undersampled", row.aliasing.share_undersampled},
                        {"pixels", row.aliasing.pixels},
                        {"bounds", bounds}}},
                      {"warps", row.warps},
                      {"omitted", row.omitted}});
    if (row.pages)
      frames.back()["pages"] = {{"resident", row.pages->resident},
                                {"drawn", row.pages->drawn},
                                {"kept", row.pages->resident - row.pages->drawn},
                                {"levels", row.pages->levels},
                                {"target_m", row.pages->target_m}};
    if (row.lights) frames.back()["lights_with_maps"] = row.lights->mapped;
  }
  return frames;
}

ContactSheet::ContactSheet(int frames, int width, int height, std::vector<std::string> rows)
    : frames_(frames),
      thumb_width_(std::min(width, kColumnWidth)),
      thumb_height_(std::max(1, static_cast<int>(std::lround(1.0 * thumb_width_ * height / width)))),
      rows_(std::move(rows)) {}

bool ContactSheet::wants(int frame) const {
  const int columns = std::min(frames_, kMaxColumns);
  if (columns == 1) return frame == 0;
  for (int c = 0; c < columns; ++c) {
    if (frame == static_cast<int>(std::lround(1.0 * c * (frames_ - 1) / (columns - 1)))) return true;
  }
  return false;
}

void ContactSheet::add(int frame, const std::vector<const Image*>& pictures) {
  Column& column = columns_.emplace_back();
  column.frame = frame;
  for (const Image* picture : pictures)
    column.pictures.push_back(render::shrunk(*picture, thumb_width_, thumb_height_));
}

Image ContactSheet::sheet(const std::string& title) const {
  const int count = static_cast<int>(columns_.size());
  const int width = kGap + count * (thumb_width_ + kGap);
  const Heading title_text(title, width);
  const int heading = title_text.height();
  const int rows = static_cast<int>(rows_.size());
  Image sheet = render::blank_image(width, heading + rows * (thumb_height_ + kGap + kLabel) + kGap, kPaper);
  title_text.draw(sheet);
  for (int c = 0; c < count; ++c) {
    const Column& column = columns_[static_cast<std::size_t>(c)];
    for (int r = 0; r < rows; ++r) {
      const auto row = static_cast<std::size_t>(r);
      const int x = kGap + c * (thumb_width_ + kGap), y = heading + r * (thumb_height_ + kGap + kLabel);
      render::draw_text(sheet, x + kGap, y + kGap, fmt::format("frame {} {}", column.frame, rows_[row]),
                        kInk);
      render::paste(sheet, column.pictures[row], x, y + kLabel);
    }
  }
  return sheet;
}

void WarpStrip::add(const std::string& label, const Image& lit, const Image& heat) {
  const int width = std::min(lit.width, kMaxColumnWidth);
  const int height = std::max(1, static_cast<int>(std::lround(1.0 * width * lit.height / lit.width)));
  columns_.push_back({label, render::shrunk(lit, width, height), render::shrunk(heat, width, height)});
  if (columns_.size() == 1) render::draw_heat_legend(columns_.back().heat);  // once, in the first
}

Image WarpStrip::strip(const std::string& title) const {
  const int width = columns_.front().lit.width, height = columns_.front().lit.height;
  const int whole = kGap + static_cast<int>(columns_.size()) * (width + kGap);
  const Heading title_text(title, whole);
  std::vector<std::vector<std::string>> labels;
  std::size_t label_lines = 1;
  for (const Column& column : columns_) {
    labels.push_back(broken_lines(column.label, width - kGap));
    label_lines = std::max(label_lines, labels.back().size());
  }
  const int heading = title_text.height(), pictures = heading + kGap + static_cast<int>(label_lines) * kLine;
  Image strip = render::blank_image(whole, pictures + 2 * (height + kGap), kPaper);
  title_text.draw(strip);
  int x = kGap;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    draw_lines(strip, x + kGap, heading + kGap, labels[i]);
    render::paste(strip, columns_[i].lit, x, pictures);
    render::paste(strip, columns_[i].heat, x, pictures + height + kGap);
    x += width + kGap;
  }
  return strip;
}

}  // namespace gnomon::tool::fly
