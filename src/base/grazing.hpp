// When does light only graze a surface?
#pragma once

namespace gnomon {

/// At less than this cosine a ray leaves the plane so slowly that errors grow a thousandfold along it: no
/// shadow and no m is certain. shaders/pass/common/grazing.glsl has it as well.
inline constexpr double kGrazingCosine = 1e-3;

}  // namespace gnomon
