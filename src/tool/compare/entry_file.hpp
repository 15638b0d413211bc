// Entries of others for a sweep: a capture of an engine's maps, or a folder of masks.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/light.hpp"
#include "gnomon/report/row.hpp"
#include "others_frames.hpp"

namespace gnomon::tool {

/// NAME=PATH of --entry.
struct EntryWord {
  std::string name, path;
};
/// True for a name that rows and files can hold.
[[nodiscard]] bool is_entry_name(const std::string& name) noexcept;
/// Throws std::runtime_error where there is no name, or one that rows and files cannot hold.
[[nodiscard]] EntryWord entry_word(const std::string& option, const std::string& word);

/// The maps of a capture (docs/captures.md) in a right-handed world. Throws std::runtime_error where it is
/// damaged, has another light than one sun, or a frame without maps.
[[nodiscard]] std::shared_ptr<const CapturedMaps> load_captured_maps(const std::filesystem::path& file);

/// Name of the list of frames in a folder of masks, a line of JSON each.
inline constexpr const char* kMasksFile = "masks.jsonl";
/// Throws std::runtime_error where the list is damaged.
[[nodiscard]] std::shared_ptr<const GivenMasks> load_given_masks(const std::filesystem::path& folder);

/// The frame of the row's view; nullptr: none. The last of several.
[[nodiscard]] const GivenMasks::Frame* masks_of(const GivenMasks& given, const report::Row& row) noexcept;

/// What a renderer needs to draw the same frame.
struct MaskedView {
  Camera camera, before;
  Light light;
  SceneBounds bounds;
};
/// Masks of one frame; the last two may be empty.
struct FrameMasks {
  std::vector<float> mask;
  std::vector<float> before;  ///< one step of a viewer earlier, through its own camera
  std::vector<float> moved;   ///< the shadow of that step, looked up at the frame's points
};
/// Files of a frame. Throws std::runtime_error.
[[nodiscard]] FrameMasks read_masks(const GivenMasks& given, const GivenMasks::Frame& frame, int width,
                                    int height);
/// Writes a row's masks below `folder`, and a line for them into its list. Throws std::runtime_error.
void write_masks(const std::filesystem::path& folder, const report::Row& row, const MaskedView& view,
                 const FrameMasks& masks);

}  // namespace gnomon::tool
