// Does the coarse view draw the meshes that hide most, where it may not draw all?
#include "gnomon/scene/coarse_view.hpp"

#include "gltf_text.hpp"
#include "gnomon/camera.hpp"

namespace gnomon::test {
namespace {

/// A square of two triangles across the view, of this half side and at this depth.
void add_square(TestGltf& gltf, float half, float depth) {
  const float h = half, z = -depth;
  gltf.show({{"attributes",
              {{"POSITION", gltf.positions({-h, -h, z, h, -h, z, h, h, z, -h, -h, z, h, h, z, -h, h, z})}}}});
}

TEST(CoarseView, takes_triangles_of_the_largest_meshes_first) {
  TestGltf gltf;
  add_square(gltf, 0.5f, 30.0f);  // all of it behind the wall
  add_square(gltf, 9.0f, 10.0f);
  const Scene scene = gltf.load();
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, 0.1, 100.0, 64, 64);
  CoarseView view;
  EXPECT_LT(view.depths(scene, camera, 4).max, 20.0);
  EXPECT_LT(view.depths(scene, camera, 2).max, 20.0) << "the wall hides what is behind it";
  EXPECT_GT(view.depths(scene, camera, 0).max, 29.0) << "boxes hide nothing";
}

}  // namespace
}  // namespace gnomon::test
