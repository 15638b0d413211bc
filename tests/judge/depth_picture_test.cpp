// Does a picture of depths stand for the surfaces that it shows?
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "captures.hpp"

namespace gnomon::judge::test {
namespace {

/// The boxes in view as a picture of depths, in their place.
Json with_depth_picture(const Json& c) {
  const Capture capture = read_capture(c.dump());
  const CapturedFrame& frame = capture.frames[0];
  const SeenSurfaces seen = seen_surfaces(frame, capture.scenes[0]);
  std::vector<double> depths(static_cast<std::size_t>(kRayColumns) * kRayRows, 0.0);
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    const auto column = static_cast<std::size_t>(seen.pixels[p].x / frame.camera.width * kRayColumns);
    const auto row = static_cast<std::size_t>(seen.pixels[p].y / frame.camera.height * kRayRows);
    depths[row * kRayColumns + column] = seen.depths[p];
  }
  Json out = c;
  out.erase("receivers");
  out["depth_picture"] = {{"width", kRayColumns}, {"height", kRayRows}, {"depths", depths}};
  return out;
}

TEST(DepthPictures, show_the_surfaces_that_boxes_have) {
  const Json boxes = sound("ogre_pssm");
  const Json c = with_depth_picture(boxes);
  EXPECT_THAT(kinds(judged(c)), testing::IsEmpty());
  const CapturedScene scene = read_capture(c.dump()).scenes[0];
  const Capture of_boxes = read_capture(boxes.dump());
  const SeenSurfaces seen = seen_surfaces(of_boxes.frames[0], of_boxes.scenes[0]);
  EXPECT_GT(scene.points.size(), seen.points.size() * 95 / 100);
  // Of axis-aligned boxes.
  const auto straight = std::count_if(scene.normals.begin(), scene.normals.end(), [](const glm::dvec3& n) {
    return std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 0.999;
  });
  EXPECT_GT(straight, static_cast<std::ptrdiff_t>(scene.normals.size() * 9 / 10));
}

TEST(DepthPictures, that_are_half_written_or_of_several_cameras_are_refused) {
  Json c = with_depth_picture(sound("ogre_pssm"));
  EXPECT_EQ(refusal(c.dump()), "taken");
  Json half = c;
  half["depth_picture"]["depths"].erase(0);
  EXPECT_EQ(refusal(half.dump()), "depth_picture.depths: needs 5184 numbers, has 5183");
  Json large = c;
  large["depth_picture"]["width"] = 60000;
  EXPECT_EQ(refusal(large.dump()), "depth_picture.depths: must be at most 100000 pixels");
  Json both = c;
  both["points"] = {{0, 0, 0}};
  EXPECT_EQ(refusal(both.dump()), "depth_picture: stands beside points: one of both");
  Json shared = sound("three_csm");
  shared["depth_picture"] = c["depth_picture"];
  EXPECT_EQ(refusal(shared.dump()), "depth_picture: stands beside frames: each has its own");
  shared.erase("depth_picture");
  shared["frames"][0]["depth_picture"] = c["depth_picture"];
  EXPECT_EQ(refusal(shared.dump()), "taken");
}

TEST(DepthPictures, of_depths_behind_the_camera_or_beyond_its_planes_are_refused) {
  Json c = with_depth_picture(sound("ogre_pssm"));
  Json behind = c;
  behind["depth_picture"]["depths"][7] = -3.0;
  EXPECT_EQ(refusal(behind.dump()),
            "depth_picture.depths[7]: must be a depth in front of the camera, or 0 where nothing is");
  for (const double scale : {1e-6, 1e6}) {
    Json scaled = c;
    for (Json& depth : scaled["depth_picture"]["depths"]) depth = depth.get<double>() * scale;
    EXPECT_EQ(refusal(scaled.dump()), "depth_picture.depths: none lies between the camera's planes") << scale;
  }
  // Nothing but sky is a picture, too.
  for (Json& depth : c["depth_picture"]["depths"]) depth = 0.0;
  EXPECT_EQ(refusal(c.dump()), "taken");
}

}  // namespace
}  // namespace gnomon::judge::test
