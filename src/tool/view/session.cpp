// What the viewer keeps from one run to the next, in the user's folders.
#include "session.hpp"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/bounded_file.hpp"
#include "base/whole_file.hpp"

namespace gnomon::tool::view {
namespace {

constexpr std::size_t kMaxRecent = 8;

/// The folder that `variable` names, or `fallback` in the home folder. The base directory specification has
/// relative names ignored.
std::filesystem::path base_folder(const char* variable, const char* fallback) {
  const char* named = std::getenv(variable);
  if (named != nullptr && named[0] == '/') return named;
  const char* home = std::getenv("HOME");
  return home != nullptr && home[0] == '/' ? std::filesystem::path(home) / fallback : std::filesystem::path();
}

}  // namespace

std::filesystem::path session_file() {
  const std::filesystem::path base = base_folder("XDG_CONFIG_HOME", ".config");
  return base.empty() ? base : base / "gnomon" / "view.json";
}

std::filesystem::path last_state_file() {
  const std::filesystem::path base = base_folder("XDG_STATE_HOME", ".local/state");
  return base.empty() ? base : base / "gnomon" / "view_state.json";
}

Session load_session(const std::filesystem::path& file) {
  Session session;
  constexpr std::uint64_t kMaxBytes = 1 << 20;  // a few names of scenes
  std::string text;
  if (!read_bounded_file(file, kMaxBytes, Readable::regular_file, text).empty()) return session;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return session;
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array()) {
    for (const auto& scene : *recent)
      if (scene.is_string() && session.recent.size() < kMaxRecent)
        session.recent.push_back(scene.get<std::string>());
  }
  constexpr double kLeast = 0.5, kMost = 8.0;
  if (const auto scale = json.find("ui_scale"); scale != json.end() && scale->is_number())
    session.ui_scale = *scale == 0.0 ? 0.0 : std::clamp(scale->get<double>(), kLeast, kMost);
  return session;
}

std::string save_text(const std::string& text, const std::filesystem::path& file) {
  if (file.empty()) return "no folder to keep it in";
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  return error ? error.message() : write_whole_file(file, text);
}

std::string save_session(const Session& session, const std::filesystem::path& file) {
  const nlohmann::ordered_json json{{"recent", session.recent}, {"ui_scale", session.ui_scale}};
  return save_text(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n", file);
}

void add_recent(Session& session, const std::string& scene) {
  std::erase(session.recent, scene);
  session.recent.insert(session.recent.begin(), scene);
  if (session.recent.size() > kMaxRecent) session.recent.resize(kMaxRecent);
}

}  // namespace gnomon::tool::view
