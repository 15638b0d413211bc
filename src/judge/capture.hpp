// What does an engine hand in to be judged? Its cameras, lights and shadow maps, frame by frame, as it has
// them.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::judge {

/// How far an engine moves a depth towards the light before it compares: the sum of all of these.
struct CapturedBias {
  double depth = 0.0;          ///< of the map's depth, 0..1
  double slope_factor = 0.0;   ///< times the growth of that depth over one texel
  double world = 0.0;          ///< along the light, world units
  double texels = 0.0;         ///< along the light, in texels
  double slope_texels = 0.0;   ///< along the light, in texels times tan(angle between normal and light)
  double normal_world = 0.0;   ///< along the normal, world units
  double normal_texels = 0.0;  ///< along the normal, in texels
  bool follows_plane = false;  ///< each comparison follows the receiver's plane to its texel
};

/// One shadow map of an engine.
struct CapturedMap {
  glm::dmat4 clip_from_world{1.0};
  int light = 0;              ///< index of its light
  int width = 0, height = 0;  ///< texels
  TexelRect atlas;            ///< its place in an atlas; empty: none
  /// View depths that it serves, world units.
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
  double overlap = 0.0;              ///< of the blend band before `begin`, world units
  int depth_bits = 0;                ///< of a normalized integer; 0: single precision
  double filter_texels = 0.0;        ///< radius of the filter's kernel
  bool stores_back = false;          ///< back faces are drawn: a closed caster's far side
  bool clamps_depth = false;         ///< casters before the near plane are drawn on it
  std::optional<CapturedBias> bias;  ///< none: the file states none
  std::string path;                  ///< in the file
};

/// What stands in the scene, as far as it is known; each list may be empty.
struct CapturedScene {
  std::vector<Box> receivers, casters;
  std::vector<glm::dvec3> points, normals;  ///< of visible surfaces
};

/// One frame.
struct CapturedFrame {
  Camera camera;
  std::vector<Light> lights;
  std::vector<CapturedMap> maps;
  std::vector<MapSelection> selection;  ///< by light
  std::size_t scene = 0;                ///< index of what stands in it
};

/// A file of the format gnomon-capture/1 (docs/captures.md).
struct Capture {
  std::string name, engine;
  ClipSpace clip_space;                   ///< of the maps' matrices
  ClipSpace camera_clip_space;            ///< of the cameras'
  int atlas_width = 0, atlas_height = 0;  ///< texels; 0: no atlas
  std::vector<CapturedScene> scenes;      ///< the first is that of frames that name nothing of their own
  std::vector<CapturedFrame> frames;      ///< at least one
};

/// Cascades of one light: as many as a plan has.
inline constexpr std::size_t kMostMapsOfLight = kMaxMaps;

/// Reads a capture. Throws CaseError: one line that begins with the key's path.
[[nodiscard]] Capture read_capture(std::string_view json_text);
/// The same from a file; messages begin with its name.
[[nodiscard]] Capture load_capture(const std::filesystem::path& file);

}  // namespace gnomon::judge
