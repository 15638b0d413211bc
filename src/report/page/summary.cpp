// Rows gathered per scene and technique: what the charts and tables show.
#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "text.hpp"

namespace gnomon::report {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kMicrosecondsPerNanosecond = 1e-3, kMebibytesPerByte = 1.0 / (1 << 20);

template <class Values, class Value>
std::size_t place_of(Values& known, const Value& value) {
  const auto at = std::find(known.begin(), known.end(), value);
  if (at != known.end()) return static_cast<std::size_t>(at - known.begin());
  known.push_back(value);
  return known.size() - 1;
}

double gathered(const Measure& measure, const std::vector<const Row*>& rows) {
  double sum = 0.0, largest = 0.0, weights = 0.0;
  for (const Row* row : rows) {
    const double value = measure.of(*row);
    if (std::isnan(value)) continue;  // measured before there was such a number
    // A frame that shows hardly a pixel must not decide.
    const double weight =
        measure.is_cost ? 1.0 : static_cast<double>(std::max<std::uint64_t>(row->errors.pixels, 1));
    sum += weight * value;
    weights += weight;
    largest = std::max(largest, value);
  }
  if (weights == 0.0) return kNotMeasured;
  return measure.frames == Measure::Gather::largest ? largest : sum / weights;
}

Cell cell_of(const std::vector<const Row*>& rows) {
  Cell cell;
  if (rows.empty()) return cell;
  cell.measured = true;
  for (const Row* row : rows) cell.pixels = std::max(cell.pixels, row->errors.pixels);
  for (const Measure& measure : measures()) cell.values.push_back(gathered(measure, rows));
  return cell;
}

/// The same technique over all scenes.
Cell all_scenes(const std::vector<std::vector<Cell>>& cells, std::size_t technique) {
  Cell all;
  for (std::size_t scene = 1; scene < cells.size(); ++scene) {
    if (!cells[scene][technique].measured) return all;
  }
  all.measured = true;
  std::vector<std::size_t> counted;
  for (std::size_t scene = 1; scene < cells.size(); ++scene) {
    all.pixels = std::max(all.pixels, cells[scene][technique].pixels);
    if (cells[scene][technique].pixels >= kFewestPixels) counted.push_back(scene);
  }
  if (counted.empty())
    for (std::size_t scene = 1; scene < cells.size(); ++scene) counted.push_back(scene);
  for (std::size_t m = 0; m < measures().size(); ++m) {
    std::vector<double> values;
    for (const std::size_t scene : counted) values.push_back(cells[scene][technique].values[m]);
    constexpr double kLeastCost = 1e-6;  // of a pass that did not run
    double sum = 0.0;
    for (const double value : values) sum += value / static_cast<double>(values.size());
    // One that was not measured everywhere makes the sum no number.
    all.values.push_back(measures()[m].is_cost && !std::isnan(sum) ? geometric_mean(values, kLeastCost)
                                                                   : sum);
  }
  return all;
}

/// The value of rows whose maps are known: masks of others say nothing of them and of parts of their time.
double of_maps(const Row& row, double value) {
  return row.is_masks() ? kNotMeasured : value;
}
/// A part of the time, where maps were timed.
double of_time(const Row& row, double value) {
  return row.times.known() ? of_maps(row, value) : kNotMeasured;
}
/// The value where the filter's kernel is known.
double of_kernel(const Row& row, double value) {
  return row.truth == "none" ? kNotMeasured : value;
}

/// What a row's scene goes by: the view's name, else the scene, with its camera and edits where the rows have
/// several.
class SceneNames {
 public:
  explicit SceneNames(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      cameras_[row.scene].insert(row.camera);
      edits_[row.scene].insert(row.edits);
    }
  }
  [[nodiscard]] std::string of(const Row& row) const {
    if (!row.view.empty()) return row.view;
    std::string name = row.scene;
    if (!row.camera.empty() && cameras_.at(row.scene).size() > 1) name += ", " + row.camera;
    if (!row.edits.empty() && edits_.at(row.scene).size() > 1) name += ", " + row.edits;
    return name;
  }

 private:
  std::map<std::string, std::set<std::string>> cameras_, edits_;
};

}  // namespace

const std::vector<Measure>& measures() {
  using Gather = Measure::Gather;
  static const std::vector<Measure> all{
      {"wrong", "misclassified pixels (false light + false shadow)", "%", "misclassified", false,
       [](const Row& r) { return r.errors.false_lit + r.errors.false_shadow; }},
      {"false_lit", "false light", "%", "false light", false,
       [](const Row& r) { return r.errors.false_lit; }},
      {"false_shadow", "false shadow", "%", "false shadow", false,
       [](const Row& r) { return r.errors.false_shadow; }},
      {"pixel_error", "pixel error against the light over whole pixels", "%", "pixel error", false,
       [](const Row& r) { return r.pixel ? r.pixel->error : kNotMeasured; }},
      {"pixel_error_one_surface", "pixel error where a pixel shows one surface", "%", "of one surface", false,
       [](const Row& r) { return r.pixel ? r.pixel->one_surface : kNotMeasured; }},
      {"mean_error", "mean error against the ideal filter", "%", "mean error", false,
       [](const Row& r) { return of_kernel(r, r.errors.mean_error); }},
      {"leaking", "light leaking deep in shadow", "%", "leaking", false,
       [](const Row& r) { return of_kernel(r, r.errors.leaking); }},
      {"darkening", "darkening of lit surfaces", "%", "darkening", false,
       [](const Row& r) { return of_kernel(r, r.errors.darkening); }},
      {"too_dark", "acne: lit surfaces darker by over a tenth", "%", "too dark", false,
       [](const Row& r) { return of_kernel(r, r.errors.too_dark); }},
      {"too_light", "leaks: deep shadow brighter by over a tenth", "%", "too light", false,
       [](const Row& r) { return of_kernel(r, r.errors.too_light); }},
      {"flips", "flicker (excess flips per pixel and frame)", "%", "flicker", false,
       [](const Row& r) { return r.flips; }},
      {"twinkle", "twinkling (pixels that change more than the light over them)", "%", "twinkling", false,
       [](const Row& r) { return r.pixel ? r.pixel->twinkle : kNotMeasured; }},
      {"twinkle_tracked", "twinkling of points that the eye follows", "%", "followed", false,
       [](const Row& r) { return r.pixel ? r.pixel->twinkle_tracked : kNotMeasured; }},
      {"m_p95", "aliasing error m, 95th percentile", "pixels per texel", "m p95", false,
       [](const Row& r) { return of_maps(r, r.aliasing.p95); }, Gather::largest},
      {"share_undersampled", "share of pixels with m > 1", "%", "m > 1", false,
       [](const Row& r) { return of_maps(r, r.aliasing.share_undersampled); }},
      {"total_ms", "shadow time per frame", "ms", "time, ms", true,
       [](const Row& r) { return r.times.known() ? r.times.total_ms.median : kNotMeasured; }},
      {"ratio", "time relative to one unwarped map with hard shadows", "", "x baseline", true,
       [](const Row& r) { return of_time(r, r.times.ratio()); }},
      {"plan_us", "planning", "\xC2\xB5s", "plan, \xC2\xB5s", true,
       // The maps of a capture were planned elsewhere.
       [](const Row& r) {
         return r.technique.is_given() ? kNotMeasured
                                       : of_time(r, r.times.plan_ns.median * kMicrosecondsPerNanosecond);
       }},
      {"depth_ms", "drawing depths", "ms", "depth, ms", true,
       [](const Row& r) { return of_time(r, r.times.depth_ms.median); }},
      {"prefilter_ms", "prefilter", "ms", "prefilter, ms", true,
       [](const Row& r) { return of_time(r, r.times.prefilter_ms.median); }},
      {"shade_ms", "look-up", "ms", "look-up, ms", true,
       [](const Row& r) { return of_time(r, r.times.shade_ms.median); }},
      {"draws", "draw calls", "", "draws", true,
       [](const Row& r) { return of_maps(r, static_cast<double>(r.costs.draws)); }},
      {"triangles", "triangles drawn", "", "triangles", true,
       [](const Row& r) { return of_maps(r, static_cast<double>(r.costs.triangles)); }},
      {"map_mib", "memory of the maps", "MiB", "maps, MiB", true,
       [](const Row& r) { return of_maps(r, static_cast<double>(r.costs.map_bytes) * kMebibytesPerByte); },
       Gather::largest}};
  return all;
}

std::string Measure::text(double value) const {
  return short_number(shown(value)) + (unit == "%" && std::isfinite(value) ? " %" : "");
}

std::size_t measure_index(std::string_view key) {
  const std::vector<Measure>& all = measures();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Measure& m) { return m.key == key; });
  return static_cast<std::size_t>(at - all.begin());
}

std::vector<std::size_t> Summary::front(std::size_t scene, std::size_t error, std::size_t cost) const {
  std::vector<Choice> choices;
  std::vector<std::size_t> of;
  for (std::size_t t = 0; t < techniques.size(); ++t) {
    const Cell& cell = cells[scene][t];
    if (!cell.measured) continue;
    choices.push_back({cell.values[cost], cell.values[error]});
    of.push_back(t);
  }
  std::vector<std::size_t> best = pareto_front(choices);
  for (std::size_t& i : best) i = of[i];
  return best;
}

std::size_t Summary::filter_of(const Technique& technique) const {
  return static_cast<std::size_t>(std::find(filters.begin(), filters.end(), technique.filter) -
                                  filters.begin());
}

std::size_t Summary::kind_of(const Technique& technique) const {
  return static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), technique.kind()) - kinds.begin());
}

Summary summarize(const std::vector<Row>& rows) {
  Summary s;
  const SceneNames names(rows);
  s.scenes.emplace_back("all scenes");
  std::vector<std::vector<std::vector<const Row*>>> gathered_rows;  // [scene - 1][technique]
  for (const Row& row : rows) {
    (void)place_of(s.techniques, row.technique);
    (void)place_of(s.filters, row.technique.filter);
    (void)place_of(s.kinds, row.technique.kind());
  }
  s.rows_of.emplace_back();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // The first entry is all of them together, whatever a scene may be called.
    const auto known = std::find(s.scenes.begin() + 1, s.scenes.end(), names.of(rows[i]));
    const auto scene = static_cast<std::size_t>(known - s.scenes.begin());
    if (known == s.scenes.end()) {
      s.scenes.push_back(names.of(rows[i]));
      s.rows_of.emplace_back();
      gathered_rows.emplace_back(s.techniques.size());
    }
    gathered_rows[scene - 1][place_of(s.techniques, rows[i].technique)].push_back(&rows[i]);
    s.rows_of[scene].push_back(i);
  }
  for (const std::string& scene : s.scenes) s.titles.push_back(short_scene_name(scene));
  for (std::size_t i = 0; i < s.titles.size(); ++i) {
    // Two of one short name keep their own.
    const std::string title = s.titles[i];
    if (std::count(s.titles.begin(), s.titles.end(), title) < 2) continue;
    for (std::size_t k = i; k < s.titles.size(); ++k)
      if (s.titles[k] == title) s.titles[k] = s.scenes[k];
  }
  s.cells.emplace_back();
  for (const auto& by_technique : gathered_rows) {
    s.cells.emplace_back();
    for (const auto& of_technique : by_technique) s.cells.back().push_back(cell_of(of_technique));
  }
  for (std::size_t t = 0; t < s.techniques.size(); ++t) s.cells.front().push_back(all_scenes(s.cells, t));
  for (std::vector<std::size_t>& numbers : s.rows_of)
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::size_t a, std::size_t b) { return rows[a].frame < rows[b].frame; });
  return s;
}

std::string short_scene_name(const std::string& scene) {
  const std::size_t comma = scene.find(", ");
  std::string name = scene.substr(0, comma), camera = comma == std::string::npos ? "" : scene.substr(comma);
  const std::filesystem::path file(name);
  const std::string extension = file.extension().string();
  if (extension == ".gltf" || extension == ".glb") {
    name = file.stem().string();
    if ((name == "scene" || name == "model") && file.parent_path().has_filename())
      name = file.parent_path().filename().string();
  }
  constexpr std::size_t kHash = 16;
  const std::size_t space = camera.rfind(' ');
  const bool has_hash = space != std::string::npos && camera.size() - space - 1 == kHash &&
                        camera.find_first_not_of("0123456789abcdef", space + 1) == std::string::npos;
  if (has_hash) camera.resize(space);
  for (const std::string_view word : {", path ", ", capture "})
    if (camera.starts_with(word)) camera = ", " + camera.substr(word.size());
  return name + camera;
}

std::string parametrization_of(Technique technique) {
  technique.filter.clear();
  const std::string name = technique.name();
  return name.substr(0, name.rfind(" / "));
}

std::string plan_of(const Row& row) {
  return row.scene + "\n" + row.light + "\n" + std::to_string(row.frame) + "\n" +
         parametrization_of(row.technique);
}

}  // namespace gnomon::report
