// Edits of a scene on a command line: --ground and --section.
#pragma once

#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/load.hpp"

namespace gnomon::tool {

[[nodiscard]] std::vector<Option> edit_options(SceneEdits& edits);
/// Planes as NX,NY,NZ,D with / between them. Throws std::runtime_error with the option in front.
[[nodiscard]] std::vector<SectionPlane> section_words(const std::string& option, const std::string& word);
/// As section_words() reads them.
[[nodiscard]] std::string section_text(const std::vector<SectionPlane>& planes);
/// The scene with its edits. Throws SceneError.
[[nodiscard]] Scene load_edited(const std::string& spec, const LoadLimits& limits, const SceneEdits& edits);

}  // namespace gnomon::tool
