// Does any text, taken for results of a sweep, become rows that are written as they were read, and a page
// that none of their words can break out of, or a refusal of one line?
#include "fuzz.hpp"
#include "gnomon/report/rows_file.hpp"
#include "sections.hpp"

namespace {

using gnomon::fuzz::require;
using gnomon::report::Row;

/// Words of rows stand in the page as text: whatever they hold, the page keeps its elements.
void check_page(std::vector<Row> rows) {
  const std::string page = whole_page(gnomon::report::page_input("/nowhere", std::move(rows)));
  const auto count = [&](std::string_view part) {
    std::size_t n = 0;
    for (std::size_t at = page.find(part); at != std::string::npos; at = page.find(part, at + 1)) ++n;
    return n;
  };
  require(count("<script") == 2 && count("</script") == 2, "no script but the page's own");
  require(count("<!--") == 0, "no comment opens");
  require(count("<section") == 7 && count("</section>") == 7 && count("<body") == 1,
          "the page's own elements");
  require(count("<a ") == count("<a href=\"#s") && count("<iframe") == 0, "no way out");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    std::vector<Row> rows = gnomon::report::rows_from_text(gnomon::fuzz::as_text(data, size), "fuzz");
    for (Row& row : rows) {
      const std::string line = to_json_line(row);
      require(line.find('\n') == std::string::npos, "a row is a line");
      const Row again = gnomon::report::row_from_json(line, "again");
      require(to_json_line(again) == line, "a row is read as it was written");
      require(again.key() == row.key(), "a row keeps its key");
      row.pictures = {};  // files, of which there are none here
    }
    if (!rows.empty()) check_page(std::move(rows));
  } catch (const gnomon::report::ReportError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
