// How good is gnomon's map in OpenSceneGraph 3.6, beside its own orthographic and perspective ones? A walk
// down a street at equal texels, by one shader with one translated bias, against exact rays.
//   osg_sample [FOLDER]    writes one_map.png there; needs a display with OpenGL; xvfb-run gives one
// Ends with 1 where the shadow camera's matrix differs from the plan's, or gnomon's map has more
// misclassified pixels than the better of OpenSceneGraph's.
#include <osg/Version>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "gnomon/study/engine_bias.hpp"
#include "gnomon_shadow_map.hpp"
#include "stage.hpp"

namespace {

using namespace sample;
using Hint = osgShadow::ShadowSettings::ShadowMapProjectionHint;

constexpr int kWidth = 640, kHeight = 360, kFrames = 6, kTexels = 1024;
// The comparing sampler reads the four texels round a point: half a texel beyond the point's own.
constexpr double kKernelRadius = 0.5;

struct Way {
  const char* name;
  Hint hint;
  Watch watch;
  osg::ref_ptr<osgShadow::ViewDependentShadowMap> technique;
  const GnomonShadowMap* gnomon = nullptr;  // the same, where it is gnomon's
  Wrong wrong;
  std::vector<double> m_p95, microseconds;
  Drawn first;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// The map of the last frame as a plan, OpenSceneGraph's own as well.
gnomon::ShadowPlan plan_of_way(const Way& way, const Street& street, const gnomon::Camera& camera) {
  if (way.gnomon != nullptr) return way.gnomon->plan();
  const glm::dmat4 clip_from_world =
      glm_from(way.watch.camera->getViewMatrix() * way.watch.camera->getProjectionMatrix());
  const gnomon::ShadowPlan like =
      gnomon::make_plan(camera, gnomon::DirectionalLight{street.sun}, {street.boxes, street.boxes});
  return plan_of(like, camera, {&clip_from_world, 1}, {&camera.far_depth, 1}, kTexels, {});
}

double depth_bias(const gnomon::ShadowPlan& plan) {
  return gnomon::engine_bias(plan.map[0], {}, gnomon::BiasWay::rasterizer, kKernelRadius).depth;
}

void walk(Stage& stage, const Street& street, const std::vector<ExactPicture>& exact, Way& way, int& unlike) {
  stage.use(way.technique, way.hint, kTexels);
  for (int frame = 0; frame < kFrames; ++frame) {
    const gnomon::Camera camera = street.camera(frame, kWidth, kHeight);
    stage.look(camera);
    gnomon::ShadowPlan plan;
    Drawn drawn = stage.draw([&] {
      plan = plan_of_way(way, street, camera);
      return depth_bias(plan);
    });
    count_wrong(exact[static_cast<std::size_t>(frame)], drawn.lit, way.wrong);
    way.m_p95.push_back(gnomon::measure(plan, camera, {street.boxes, street.boxes}).p95);
    way.microseconds.push_back(way.watch.microseconds);
    if (way.gnomon != nullptr)
      unlike += glm_from(way.watch.camera->getViewMatrix() * way.watch.camera->getProjectionMatrix()) ==
                        plan.map[0].clip_from_world
                    ? 0
                    : 1;
    if (frame == 0) way.first = std::move(drawn);
  }
}

int run(const char* folder) {
  if (folder != nullptr) std::filesystem::create_directories(folder);
  const Street street;
  Stage stage(street, kWidth, kHeight);
  std::vector<ExactPicture> exact;
  for (int frame = 0; frame < kFrames; ++frame)
    exact.push_back(exact_picture(street, street.camera(frame, kWidth, kHeight)));
  std::array<Way, 3> ways;
  ways[0].name = "OSG orthographic";
  ways[0].hint = Hint::ORTHOGRAPHIC_SHADOW_MAP;
  ways[1].name = "OSG perspective";
  ways[1].hint = Hint::PERSPECTIVE_SHADOW_MAP;
  ways[2].name = "gnomon";
  ways[2].hint = Hint::ORTHOGRAPHIC_SHADOW_MAP;
  // The slope factor counts texels.
  for (Way& way : ways) way.watch.slope_factor = 2.0 * (0.5 + kKernelRadius);
  for (std::size_t i = 0; i < 2; ++i)
    ways[i].technique = new Watched<osgShadow::ViewDependentShadowMap>(ways[i].watch);
  gnomon::PlanOptions options;
  options.cascades = 1;
  options.resolution.max_size = kTexels;
  auto* const own = new Watched<GnomonShadowMap>(ways[2].watch, street.boxes, options);
  ways[2].technique = own;
  ways[2].gnomon = own;
  std::printf("OpenSceneGraph %s on %s\n%d frames of %d x %d pixels, one map of %d x %d texels\n\n",
              osgGetVersion(), stage.device().c_str(), kFrames, kWidth, kHeight, kTexels, kTexels);
  int unlike = 0;
  for (Way& way : ways) walk(stage, street, exact, way, unlike);

  std::printf("%-20s %13s %8s %10s\n", "", "misclassified", "m p95", "set-up, us");
  bool good = unlike == 0;
  const Way* best = &ways[0];
  for (const Way& way : ways) {
    std::printf("%-20s %11.3f %% %8.2f %10.1f\n", way.name, way.wrong.percent(), median(way.m_p95),
                median(way.microseconds));
    if (way.gnomon == nullptr && way.wrong.pixels < best->wrong.pixels) best = &way;
  }
  good = good && ways[2].wrong.pixels <= best->wrong.pixels;
  if (folder != nullptr)
    write_pictures(std::filesystem::path(folder) / "one_map.png", exact[0],
                   std::array{best->first, ways[2].first});
  std::printf("\nframes whose shadow camera differs from the plan: %d of %d\n", unlike, kFrames);
  if (!good) std::fputs("osg_sample: not as it should be, see above\n", stderr);
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
    std::fprintf(stderr, "usage: osg_sample [FOLDER]\n");
    return 2;
  }
  if (std::getenv("DISPLAY") == nullptr) {
    std::fprintf(stderr, "osg_sample: no display: run it by xvfb-run -a\n");
    return 2;
  }
  try {
    return run(argc == 2 ? argv[1] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "osg_sample: %s\n", error.what());
    return 2;
  }
}
