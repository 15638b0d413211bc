// Edits of a scene on a command line: --up, --open-sky, --ground, --section and --proxies.
#pragma once

#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {

/// In the order of UpAxis.
[[nodiscard]] inline std::vector<std::string> up_axis_names() {
  return {"y", "z"};
}
[[nodiscard]] std::vector<Option> edit_options(SceneEdits& edits);
/// Planes as NX,NY,NZ,D with / between them. Throws std::runtime_error with the option in front.
[[nodiscard]] std::vector<SectionPlane> section_words(const std::string& option, const std::string& word);
/// As section_words() reads them.
[[nodiscard]] std::string section_text(const std::vector<SectionPlane>& planes);
/// What tells one such scene from another, for rows of results. Empty without edits. Throws SceneError where
/// the file of proxies cannot be read.
[[nodiscard]] std::string edit_text(const SceneEdits& edits, const LoadLimits& limits);
/// How many triangles shadow proxies save a map of the whole scene; empty where there are none.
[[nodiscard]] std::string proxies_text(const Scene& scene);
/// The scene with its edits. Throws SceneError.
[[nodiscard]] Scene load_edited(const std::string& spec, const LoadLimits& limits, const SceneEdits& edits);

}  // namespace gnomon::tool
