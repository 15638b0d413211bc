// The scene that the samples of engines draw: a street of boxes under a sun, a walk through it, and exact
// rays that say which of its pixels are lit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/scene/image.hpp"

namespace sample {

/// Boxes with y up: a ground, houses along both sides, posts between them.
struct Street {
  std::vector<gnomon::Box> boxes;
  glm::dvec3 sun{0.6, -0.5, 0.35};  ///< the way its light travels, any length

  Street();
  /// The eye at one frame of the walk, at a man's height; the street goes along -z.
  [[nodiscard]] gnomon::Camera camera(int frame, int width, int height) const;
};

/// A corner of a box's triangles.
struct Vertex {
  glm::vec3 position, normal;  ///< world
};
inline constexpr std::size_t kBoxVertices =
    36;  ///< of a box's twelve triangles, counter-clockwise from outside
void append_box(const gnomon::Box& box, std::vector<Vertex>& out);

/// The picture of a camera by rays in double; rows top to bottom.
struct ExactPicture {
  enum Pixel : std::int8_t {
    uncounted = -1,
    shadow = 0,
    lit = 1
  };  ///< uncounted: sky, or turned from the sun
  int width = 0, height = 0;
  std::vector<Pixel> pixels;
  std::vector<float> brightness;  ///< cosine of the sun's angle where lit or in shadow, else 0
};
[[nodiscard]] ExactPicture exact_picture(const Street& street, const gnomon::Camera& camera);

/// Pixels of a drawn picture that are on the wrong side of one half.
struct Wrong {
  std::int64_t pixels = 0, of = 0;
  [[nodiscard]] double percent() const {
    return 100.0 * static_cast<double>(pixels) / static_cast<double>(of);
  }
};
/// `lit`: share of the sun's light at each pixel, rows top to bottom. Adds to `wrong`.
void count_wrong(const ExactPicture& exact, std::span<const float> lit, Wrong& wrong);

/// Matrices of another's cascades as a plan, so that they are drawn, biased and measured as gnomon's own are.
/// `like`: a plan of gnomon for the same frame. `clip_from_world`: in the plan's clip space, nearest cascade
/// first. `ends`: the view depth at which each cascade ends.
[[nodiscard]] gnomon::ShadowPlan plan_of(const gnomon::ShadowPlan& like, const gnomon::Camera& camera,
                                         std::span<const glm::dmat4> clip_from_world,
                                         std::span<const double> ends, int map_size,
                                         const gnomon::BiasOptions& bias);

/// Pictures beside each other above the same pictures with their misclassified pixels in red, as a PNG file.
/// Each is width x height x 3 bytes; `lit` as count_wrong takes it.
struct Drawn {
  std::vector<std::uint8_t> rgb;
  std::vector<float> lit;
};
void write_pictures(const std::filesystem::path& file, const ExactPicture& exact,
                    std::span<const Drawn> drawn);

}  // namespace sample
