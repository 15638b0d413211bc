// The pictures in the page: which there is room for, how they are shown, and the data that the script reads.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "charts.hpp"
#include "file.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kRoom = 16u << 20;  ///< bytes of base64: a page that opens at once

/// Reads each file once, however many techniques share its content.
class Shelf {
 public:
  Shelf(const std::filesystem::path& folder, PagePictures& pictures) : folder_(folder), pictures_(pictures) {}

  std::size_t put(const std::string& name) {
    std::string text = base64(read_picture(inside(folder_, name)));
    const auto [at, is_new] = known_.try_emplace(text, pictures_.base64.size());
    if (is_new) {
      bytes_ += text.size();
      pictures_.base64.push_back(std::move(text));
    }
    return at->second;
  }
  [[nodiscard]] bool full() const { return bytes_ >= kRoom; }

 private:
  const std::filesystem::path& folder_;
  PagePictures& pictures_;
  std::map<std::string, std::size_t> known_;
  std::size_t bytes_ = 0;
};

std::string figure(const PagePictures& pictures, std::size_t picture, const std::string& caption) {
  return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
         pictures.base64[picture] + "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string viewer(const PageInput& input, const PagePictures& pictures, std::size_t scene) {
  const PagePictures::OfScene& of = pictures.scenes[scene];
  const PagePictures::OfTechnique& first = of.of.at(of.first);
  const std::string name = input.summary.techniques[of.first].name();
  std::string out =
      "<h3>" + escaped(input.summary.titles[scene]) + ", frame " + std::to_string(of.frame) + "</h3>\n";
  out +=
      "<div class=\"viewer\" data-scene=\"" + std::to_string(scene) +
      "\">\n<div class=\"script\"><div class=\"bar\"><label>technique <select "
      "class=\"technique\"></select></label>"
      "<label>left <select class=\"left\"></select></label><label>right <select "
      "class=\"right\"></select></label>"
      "</div>\n<div class=\"stage\"><img class=\"under\" alt=\"\"><img class=\"over\" alt=\"\"><div "
      "class=\"edge\"></div></div>\n<input class=\"wipe\" type=\"range\" min=\"0\" max=\"100\" value=\"50\" "
      "aria-label=\"border between the left and the right picture\"></div>\n<div class=\"pair plainly\">\n";
  out += figure(pictures, of.truth, "exact shadow") + figure(pictures, first.mask, name) +
         figure(pictures, first.difference, "difference: " + name) +
         figure(pictures, first.heat, "aliasing error m: " + name);
  return out + "</div>\n</div>\n";
}

Json viewer_json(const PagePictures::OfScene& of) {
  if (!of.any) return nullptr;
  Json json{{"truth", of.truth}, {"image", of.image}, {"first", of.first}, {"of", Json::object()}};
  for (const auto& [technique, p] : of.of)
    json["of"][std::to_string(technique)] = {
        {"mask", p.mask}, {"difference", p.difference}, {"heat", p.heat}};
  return json;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

PagePictures page_pictures(const PageInput& input) {
  const Summary& summary = input.summary;
  PagePictures pictures;
  pictures.scenes.resize(summary.scenes.size());
  Shelf shelf(input.folder, pictures);
  struct Wanted {
    std::size_t scene, technique, rank;
    const Row* row;
  };
  std::vector<Wanted> wanted;
  const std::size_t error = measure_index(kDefaultError);
  for (std::size_t scene = 1; scene < summary.scenes.size(); ++scene) {
    const std::vector<std::size_t> front = notable(summary, scene, summary.techniques.size());
    for (const std::size_t i : summary.rows_of[scene]) {
      const Row& row = input.rows[i];
      if (row.pictures.mask.empty()) continue;
      const auto technique = static_cast<std::size_t>(
          std::find(summary.techniques.begin(), summary.techniques.end(), row.technique) -
          summary.techniques.begin());
      const auto on_front = std::find(front.begin(), front.end(), technique);
      std::size_t rank = static_cast<std::size_t>(on_front - front.begin());
      if (on_front == front.end()) {  // behind the front, by error
        for (const Cell& other : summary.cells[scene])
          rank +=
              other.measured && other.values[error] < summary.cells[scene][technique].values[error] ? 1 : 0;
      }
      wanted.push_back({scene, technique, rank, &row});
    }
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Wanted& a, const Wanted& b) { return a.rank < b.rank; });
  for (const Wanted& w : wanted) {
    PagePictures::OfScene& of = pictures.scenes[w.scene];
    if (shelf.full() && of.any) {
      ++pictures.left_out;
      continue;
    }
    const Pictures& files = w.row->pictures;
    if (!of.any) {
      of.any = true;
      of.frame = w.row->frame;
      of.first = w.technique;
      of.truth = shelf.put(files.truth);
      of.image = shelf.put(files.image);
    }
    of.of[w.technique] = {shelf.put(files.mask), shelf.put(files.difference), shelf.put(files.heat)};
  }
  return pictures;
}

std::string section_viewers(const PageInput& input, const PagePictures& pictures) {
  std::string out =
      "<section id=\"s3\">\n<h2>3. Pictures</h2>\n<p>The exact shadow, the technique's shadow, their "
      "difference, and the aliasing error m. The slider moves the border between the left and the right "
      "picture.</p>\n<p class=\"key "
      "note\"><span "
      "class=\"lit\"></span>false light<span class=\"dark\"></span>false shadow<span "
      "class=\"open\"></span>not evaluated<span class=\"turned\"></span>facing away from the light</p>\n";
  bool any = false;
  for (std::size_t scene = 1; scene < pictures.scenes.size(); ++scene) {
    if (!pictures.scenes[scene].any) continue;
    any = true;
    out += viewer(input, pictures, scene);
  }
  if (!any) out += "<p class=\"note\">No pictures were written.</p>\n";
  if (pictures.left_out > 0) {
    out += "<p class=\"note\">Not in this page: the pictures of " + counted(pictures.left_out, "technique") +
           ". The folder pictures beside it has them.</p>\n";
  }
  return out + "</section>\n";
}

std::string page_data(const PageInput& input, const PagePictures& pictures) {
  const Summary& summary = input.summary;
  Json data{{"start", input.start_scene}, {"scenes", summary.titles}};
  data["measures"] = Json::array();
  for (const Measure& m : measures())
    data["measures"].push_back(
        {{"key", m.key}, {"name", m.name}, {"unit", m.unit}, {"column", m.column}, {"cost", m.is_cost}});
  data["techniques"] = Json::array();
  for (const Technique& t : summary.techniques)
    data["techniques"].push_back({{"name", t.name()},
                                  {"color", color_class(summary.filter_of(t))},
                                  {"mark", summary.kind_of(t) % kMarks}});
  data["marks"] = Json::array();
  for (std::size_t kind = 0; kind < kMarks; ++kind) data["marks"].push_back(mark_path(kind));
  data["cells"] = Json::array();
  for (const std::vector<Cell>& cells : summary.cells) {
    Json of_scene = Json::array();
    for (const Cell& cell : cells) {
      Json values = Json::array();
      for (std::size_t m = 0; m < cell.values.size(); ++m)
        values.push_back(number(measures()[m].shown(cell.values[m])));
      of_scene.push_back(cell.measured ? values : Json(nullptr));
    }
    data["cells"].push_back(of_scene);
  }
  data["pictures"] = Json::array();
  for (const PagePictures::OfScene& of : pictures.scenes) data["pictures"].push_back(viewer_json(of));
  data["images"] = pictures.base64;
  return data.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace gnomon::report
