// What the viewer keeps from one run to the next, in the user's folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::tool::view {

struct Session {
  std::vector<std::string> recent;  ///< scenes, the last one first
  double ui_scale = 0.0;            ///< 0: as the display has it
};

/// $XDG_CONFIG_HOME/gnomon/view.json and $XDG_STATE_HOME/gnomon/view_state.json; empty where the user has no
/// home.
[[nodiscard]] std::filesystem::path session_file();
[[nodiscard]] std::filesystem::path last_state_file();

/// Defaults where the file is missing or broken.
[[nodiscard]] Session load_session(const std::filesystem::path& file);
/// Returns why it could not be written; empty where it was. Makes the folder.
[[nodiscard]] std::string save_session(const Session& session, const std::filesystem::path& file);
/// Writes a text file whole, in a folder that is made where it is missing. Returns why it could not.
[[nodiscard]] std::string save_text(const std::string& text, const std::filesystem::path& file);
void add_recent(Session& session, const std::string& scene);

}  // namespace gnomon::tool::view
