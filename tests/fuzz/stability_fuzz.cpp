// Does any text, taken for what gnomon stress found, become a section that none of its words can break out
// of, or a refusal of one line?
#include "fuzz.hpp"
#include "gnomon/report/row.hpp"
#include "stability.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using gnomon::fuzz::require;
  try {
    const gnomon::report::Stability stability =
        gnomon::report::read_stability(std::string(gnomon::fuzz::as_text(data, size)), "fuzz");
    const std::string section = stability_section(stability);
    for (const char* element : {"<script", "<!--", "<iframe", "<a ", "<img"})
      require(section.find(element) == std::string::npos, "no element but the section's own");
  } catch (const gnomon::report::ReportError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
