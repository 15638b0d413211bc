// A list in the panel of what the scene's file has: its cameras, its lights.
#pragma once

#include <imgui.h>

#include <exception>
#include <vector>

#include "app.hpp"

namespace gnomon::tool::view {

/// A list of what the scene's file has; nothing where it has none. `take` is called with the entry that was
/// chosen.
template <class Entry, class Take>
void choose_of_file(const char* label, const std::vector<Entry>& entries, Display& display,
                    const Take& take) {
  if (entries.empty() || !ImGui::BeginCombo(label, "choose")) return;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(entries[i].name.c_str())) {
      try {
        take(entries[i], i);
      } catch (const std::exception& error) {
        show_message(display, error.what(), true);
      }
    }
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

}  // namespace gnomon::tool::view
