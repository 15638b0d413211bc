// A case: one camera, one light, boxes and options, read from JSON. The program, tests and benchmarks share
// it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/lights.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

/// The input of make_plan(). Options that the file does not name have the default of PlanOptions.
struct Case {
  Camera camera;                        ///< the viewer
  Light light;                          ///< directional, spot or point
  std::vector<Box> receivers, casters;  ///< world space
  PlanOptions options;                  ///< as the file has them
  std::optional<PageOptions> pages;     ///< options.pages: plan_pages in place of make_plan
  /// Visible points for pages, and their normals, empty where the file has none.
  std::vector<glm::dvec3> seen, seen_normals;
  std::vector<std::uint8_t> seen_feedback;  ///< PageFeedback bits of the points, or empty
  /// The file's "lights": plan_lights in place of make_plan. `light` is the first of them then.
  std::vector<LightRequest> lights;
  LightOptions light_options;  ///< options.lights

  /// Views into this case: valid while it lives and its lists are not resized.
  [[nodiscard]] SceneBounds bounds() const noexcept { return {casters, receivers}; }
};

/// A case that is wrong. what() is one line. The key's path comes first where it is about a key
/// ("options.lamda: unknown key ..."). The file's name comes before that where there is a file.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file, or a line of standard input, larger than this is refused before it is parsed.
inline constexpr std::size_t kMaxCaseBytes = std::size_t{16} << 20;
/// Brackets nested deeper than this are refused before parsing; a case itself needs 4.
inline constexpr int kMaxCaseNesting = 32;

/// Reads one case from JSON text. Throws CaseError for what is no JSON, for a key that is unknown, twice or
/// missing, and for a value of the wrong type. An angle or length that makes no camera throws as well.
/// Contracts of make_plan() itself (near below far, say) are left to make_plan().
[[nodiscard]] Case read_case(std::string_view json_text);

/// The same from a file; messages begin with its name.
[[nodiscard]] Case load_case(const std::filesystem::path& file);

/// The value of "options" in a case, alone: a JSON object with the same keys. Throws CaseError as read_case()
/// does.
[[nodiscard]] PlanOptions read_plan_options(std::string_view json_text);

/// ShadowPlan::invalid_field in words of a case file: the key and the values that it may have
/// ("camera.far: must lie above near"). A field that has no text of its own comes back as "FIELD: not
/// usable".
[[nodiscard]] std::string invalid_input_text(std::string_view invalid_field);

/// `text` from a file, fit for one line of a message: bytes outside printable ASCII become '?', and what is
/// longer than `max_length` is cut.
[[nodiscard]] std::string one_line(std::string_view text, std::size_t max_length = 160);
/// The name of a file for a message: as it is, control characters aside.
[[nodiscard]] std::string shown_name(const std::filesystem::path& file);

}  // namespace gnomon
