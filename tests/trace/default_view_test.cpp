// Does the default view of a scene show what a person would look at? GNOMON_KEEP_SCENES=FOLDER keeps the
// scenes as files.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <glm/common.hpp>

#include "default_view_scenes.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::test {
namespace {

constexpr int kWidth = 96, kHeight = 54;

class DefaultView : public testing::TestWithParam<ViewScene> {};

/// Which triangles of a tracer are content.
std::vector<bool> content_of(const Scene& scene) {
  std::vector<bool> content;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    const std::string& name = scene.materials[static_cast<std::size_t>(primitive.material)].name;
    content.insert(content.end(), primitive.index_count / 3, name.starts_with("content"));
  }
  return content;
}

/// What of a picture shows content.
struct Shown {
  double share = 0.0;                ///< of its pixels
  double width = 0.0, height = 0.0;  ///< of the rectangle round them, of the picture's
  /// A quarter is filled, or all is shown of something as narrow as a post, which cannot be larger.
  [[nodiscard]] bool fills() const {
    constexpr double kWhole = 0.75;
    return share >= 0.25 || (std::max(width, height) > kWhole && width * height >= 0.25);
  }
};
Shown shown_of(const trace::Tracer& tracer, const std::vector<bool>& content, const Camera& camera) {
  const CameraAxes axes = camera_axes(camera);
  int shown = 0, left = kWidth, right = -1, top = kHeight, bottom = -1;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = camera.left + (camera.right - camera.left) * (x + 0.5) / kWidth,
                   v = camera.bottom + (camera.top - camera.bottom) * (y + 0.5) / kHeight;
      const trace::Hit hit = tracer.first_seen({camera.position, axes.forward + u * axes.right + v * axes.up,
                                                camera.near_depth, camera.far_depth});
      if (hit.triangle == trace::kNoTriangle || !content[hit.triangle]) continue;
      ++shown;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
      bottom = std::max(bottom, y);
    }
  if (shown == 0) return {};
  return {shown / (1.0 * kWidth * kHeight), (right - left + 1.0) / kWidth, (bottom - top + 1.0) / kHeight};
}

TEST_P(DefaultView, shows_content_in_a_quarter_of_the_picture) {
  const ViewScene& wanted = GetParam();
  if (const char* folder = std::getenv("GNOMON_KEEP_SCENES"))
    std::ofstream(std::string(folder) + "/" + wanted.name + ".glb", std::ios::binary) << wanted.gltf.file();
  const Scene scene = wanted.gltf.load();
  const trace::Tracer tracer(scene, trace::Engine::own);
  const std::vector<bool> content = content_of(scene);
  ASSERT_EQ(content.size(), tracer.triangle_count());
  const CameraPath path = default_path(scene, 1.0 * kWidth / kHeight);
  double least = 1.0;
  for (int i = 0; i < 8; ++i) {
    const Camera camera = path.at(i / 8.0, kWidth, kHeight);
    const Shown shown = shown_of(tracer, content, camera);
    if (i == 4) {  // what the viewer opens with, and a flight of one frame
      RecordProperty("share_percent", static_cast<int>(100 * shown.share));
      EXPECT_TRUE(shown.fills()) << shown.share << " " << shown.width << " x " << shown.height;
    }
    least = std::min(least, shown.share);
    const glm::dvec3 eye = camera.position;
    const bool inside = glm::clamp(eye, wanted.box_min, wanted.box_max) == eye;
    if (wanted.from_inside || wanted.from_outside) {
      EXPECT_EQ(inside, wanted.from_inside) << eye.x << ", " << eye.y << ", " << eye.z << " at " << i;
    }
  }
  constexpr double kAround = 0.15;  // seen from its narrow side, a thing fills less
  EXPECT_GE(least, kAround);
}

TEST(DefaultViewOfOneSide, is_from_before_it_wherever_it_faces) {
  for (int turn = 0; turn < 8; ++turn) {
    const double angle = turn * std::numbers::pi / 4;
    const glm::dvec3 right(3.0 * std::cos(angle), 0.0, -3.0 * std::sin(angle)), up(0.0, 3.0, 0.0);
    ViewScene wall("wall");
    wall.content(PartMesh().quad(-right, right, right + up, -right + up));
    const Scene scene = wall.gltf.load();
    const Camera camera = default_path(scene, 1.0 * kWidth / kHeight).at(0.5, kWidth, kHeight);
    EXPECT_TRUE(shown_of(trace::Tracer(scene, trace::Engine::own), content_of(scene), camera).fills())
        << turn;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DefaultView, testing::ValuesIn(default_view_scenes()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace gnomon::test
