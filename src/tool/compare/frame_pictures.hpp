// The pictures of a frame that the report shows: the truth, the mask, where they differ, the error per pixel.
#pragma once

#include <filesystem>
#include <string>

#include "gnomon/report/row.hpp"
#include "measure.hpp"

namespace gnomon::tool {

/// Writes them below `folder` and answers their names. `scene` and `entry` are numbers within the sweep. The
/// picture and the truth are the same for all techniques of a scene. Throws SceneError.
[[nodiscard]] report::Pictures write_pictures(const std::filesystem::path& folder, std::size_t scene,
                                              std::size_t entry, const FrameTruth& truth,
                                              const FramePictures& drawn);

}  // namespace gnomon::tool
