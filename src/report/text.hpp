// Text made safe for where it goes, and numbers made short.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace gnomon::report {

/// For HTML and SVG, as content and within double quotes.
[[nodiscard]] std::string escaped(std::string_view text);
/// One line for a message: control characters become '?', and what is longer than 400 bytes is cut.
[[nodiscard]] std::string one_line(std::string_view text);
/// Throws ReportError for brackets deeper than 32, which would be taken apart on the stack; a row needs 4.
void check_nesting(std::string_view json);
/// Visits each line that is not empty. The last one may lack its end: a whole row that way counts, and one
/// that a writer was cut off in is skipped. A ReportError of `visit`, and of lines nested too deeply, gets
/// "where:number: " in front.
void for_each_json_line(std::string_view text, const std::string& where,
                        const std::function<void(std::string_view line)>& visit);
/// JSON that may stand in a script element: no character of it can end the element.
[[nodiscard]] std::string for_script(std::string json);
/// Three significant digits, without an exponent between 1e-4 and 1e6.
[[nodiscard]] std::string short_number(double value);
/// All digits that it takes to read the value back; empty where it is not finite.
[[nodiscard]] std::string exact_number(double value);
/// "1 scene", "2 scenes".
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);
/// A share as people read it: 0.0123 becomes "1.23 %".
[[nodiscard]] std::string percent(double share);
/// Opens and ends a box that scrolls sideways where its content is too wide; keyboards can enter it. Tall
/// boxes scroll up and down as well.
[[nodiscard]] std::string scroll_box(std::string_view label, bool tall = false);
inline constexpr std::string_view kScrollBoxEnd = "</div>\n";
[[nodiscard]] std::string base64(std::string_view bytes);
/// The hash of a content security policy: "sha256-" and its base64. Based on: NIST, FIPS 180-4, 2015.
[[nodiscard]] std::string policy_hash(std::string_view text);

}  // namespace gnomon::report
