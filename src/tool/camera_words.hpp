// The camera on a command line: a path's file, or an eye and its target, and where sight begins and ends.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/scene/camera_path.hpp"

namespace gnomon::tool {

/// What is not given is the scene's own.
struct CameraWords {
  std::string path;                          ///< file; empty: none
  std::string of_file;                       ///< camera of the scene's file, by name or number; empty: none
  std::optional<glm::dvec3> eye, target;     ///< world; both or neither, and not with a path
  std::optional<glm::dvec3> eye_up;          ///< to the top of the eye's picture; none: +Y
  double height_world = 0.0;                 ///< of an orthographic picture; 0: of the path
  double near_depth = 0.0, far_depth = 0.0;  ///< world units; 0: of the path, or as the eye stands
};

/// X,Y,Z. Throws std::runtime_error by the option's name.
[[nodiscard]] glm::dvec3 point_word(const std::string& option, const std::string& word);
[[nodiscard]] Option point_option(std::string name, std::optional<glm::dvec3>& point, std::string help);

/// --path, --camera, --eye, --target, --eye-up, --orthographic, --near, --far.
[[nodiscard]] std::vector<Option> camera_options(CameraWords& words);

/// Throws std::runtime_error where they do not go together, SceneError where the file is no path.
void check_camera(const CameraWords& words);
/// The words' path, else that of `scene`; an eye is a path of one key, with sight_from(). `aspect`: of an
/// orbit that shows all of the scene. Throws as check_camera does, and std::runtime_error where the file has
/// no such camera.
[[nodiscard]] CameraPath camera_path(const CameraWords& words, const Scene& scene, double aspect = 1.0);
/// The key of the eye, which must be given.
[[nodiscard]] CameraKey eye_key(const CameraWords& words);
/// Makes a picture of a camera of the file the largest within `width` x `height` that has the camera's width
/// over height. Where the size is given, it stays, and a line says so. Throws as camera_path does.
void fit_picture(const CameraWords& words, const Scene& scene, bool size_given, int& width, int& height);
/// What tells one such camera from another, for rows of results. Empty where nothing is given.
[[nodiscard]] std::string camera_text(const CameraWords& words);

}  // namespace gnomon::tool
