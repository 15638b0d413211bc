// The flight itself: scene, camera path and maps for each frame, drawn to files or to a window.
#pragma once

#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/scene.hpp"
#include "gnomon/scene/shadow_boxes.hpp"
#include "options.hpp"

namespace gnomon::tool::fly {

/// What flies where.
struct Flight {
  Scene scene;
  CameraPath path;
  ShadowBoxes boxes;          ///< of the instances, as posed
  int animation = kRestPose;  ///< that the flight plays
  Pose pose;                  ///< of the frame at hand
  [[nodiscard]] SceneBounds bounds() const noexcept { return boxes.bounds(); }
};

/// Loads scene and path, and sizes the picture as a camera of the file has it. Throws std::runtime_error with
/// what is wrong and where.
[[nodiscard]] Flight load_flight(Options& options);

/// Poses the flight's boxes at this time since its first frame, and the renderer where there is one. Nothing
/// without an animation.
void pose_flight(const Options& options, Flight& flight, double seconds, render::Renderer* renderer);
/// The same at a frame of the flight.
void pose_frame(const Options& options, Flight& flight, int frame, render::Renderer* renderer);

/// The camera of a frame of the flight.
[[nodiscard]] Camera camera_of(const Options& options, const Flight& flight, int frame);

/// Halves the maps until memory takes them, and says so. A context must be current. Throws std::runtime_error
/// where not even the least fit.
void fit_maps_to_memory(Options& options);

/// Takes the smallest maps, never larger than the given ones, whose texels the filter hides at the visible
/// points of all frames, without the warp where that is smaller; prints them. Throws std::runtime_error where
/// the kernel hides nothing.
void choose_perceptual_maps(Options& options, const Flight& flight);

/// Takes maps and filter that meet Options::budget in the frame that is hardest to serve, and prints them
/// with what less cost and what less error would have taken. With Options::pages, pages of several target
/// errors are among the choices; they are off afterwards where maps were chosen. Leaves the flight in the pose
/// of the last frame that was looked at. Throws std::runtime_error.
void choose_technique_of(Options& options, Flight& flight);

/// Draws the frames off-screen and writes them. Returns the exit code.
int fly_to_files(const Options& options, Flight& flight);

/// Opens a window. With --frames, flies the path once, writes what the window showed last and closes; else
/// the user flies. Returns the exit code.
int fly_in_window(const Options& options, Flight& flight);

}  // namespace gnomon::tool::fly
