// What stands in the scene of a capture: boxes, visible points, or a picture of depths. For its reader.
#pragma once

#include <string_view>

#include "json_fields.hpp"
#include "judge/capture.hpp"

namespace gnomon::judge {

inline constexpr int kLargestMap = 1 << 16;
inline constexpr double kLargestNumber = 1e30;

/// Pixels or texels along a side. All of these throw CaseError.
[[nodiscard]] int size_from(const Fields& fields, std::string_view key);
/// Boxes and points, of a frame or of all.
[[nodiscard]] CapturedScene scene_of(const Fields& fields);
/// A picture shows what one camera sees: its points stand for those that are not listed.
void read_depth_picture(const Fields& frame, const Camera& camera, CapturedScene& scene);

}  // namespace gnomon::judge
