// How good are gnomon's maps in OGRE 1.12, beside its own Focused, LiSPSM and PSSM? A walk down a street at
// equal texels, by one shader with one translated bias, against exact rays.
//   ogre_sample [FOLDER]    writes one_map.png and four_maps.png there; needs a display with OpenGL; xvfb-run
//   gives one
// Ends with 1 where a shadow camera's matrix differs from the plan's, or gnomon's maps have more
// misclassified pixels than OGRE's best of as many maps.
#include <Ogre.h>

#include <OgreShadowCameraSetupFocused.h>
#include <OgreShadowCameraSetupLiSPSM.h>
#include <OgreShadowCameraSetupPSSM.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "gnomon/study/engine_bias.hpp"
#include "gnomon_setup.hpp"
#include "stage.hpp"

namespace {

using namespace sample;

constexpr int kWidth = 640, kHeight = 360, kFrames = 6;
constexpr int kTexelsOfOne = 1024, kTexelsOfFour = 512;  // as many texels in all
// The comparing sampler reads the four texels round a point: half a texel beyond the point's own.
constexpr double kKernelRadius = 0.5;

struct Way {
  const char* name;
  std::size_t maps;
  Ogre::ShadowCameraSetupPtr setup;
  std::shared_ptr<GnomonSetup> gnomon;                  // the same, where it is gnomon's
  std::shared_ptr<Ogre::PSSMShadowCameraSetup> splits;  // the same, where it is PSSM
  Wrong wrong;
  std::vector<double> m_p95;
  double microseconds = 0.0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

Way ogre_way(const char* name, const Ogre::ShadowCameraSetupPtr& setup) {
  return {name, 1, setup, nullptr, nullptr, {}, {}, 0.0};
}

/// OGRE's own splits. `factor`: of each map's n_opt, 0 for OGRE's own, which are 5, 1, and no warp in the
/// others.
Way pssm_way(const char* name, const gnomon::Camera& camera, Ogre::Real factor) {
  auto setup = std::make_shared<Ogre::PSSMShadowCameraSetup>();
  setup->calculateSplitPoints(kMaxTextures, static_cast<Ogre::Real>(camera.near_depth),
                              static_cast<Ogre::Real>(camera.far_depth));
  for (std::size_t i = 0; factor > 0 && i < kMaxTextures; ++i) setup->setOptimalAdjustFactor(i, factor);
  return {name, kMaxTextures, setup, nullptr, setup, {}, {}, 0.0};
}

Way gnomon_way(const char* name, const Street& street, std::size_t maps) {
  gnomon::PlanOptions options;
  options.cascades = static_cast<int>(maps);
  options.resolution.max_size = maps == 1 ? kTexelsOfOne : kTexelsOfFour;
  auto setup = std::make_shared<GnomonSetup>(street.boxes, options);
  return {name, maps, setup, setup, nullptr, {}, {}, 0.0};
}

glm::dmat4 clip_from_world(const Ogre::Camera& camera) {
  return glm_from(camera.getProjectionMatrix() * Ogre::Matrix4(camera.getViewMatrix(true)));
}

/// The maps of the last frame as a plan, OGRE's own as well.
gnomon::ShadowPlan plan_of_way(const Way& way, const Stage& stage, const Street& street,
                               const gnomon::Camera& camera) {
  if (way.gnomon != nullptr) return way.gnomon->plan();
  std::vector<glm::dmat4> matrices;
  std::vector<double> ends;
  for (std::size_t i = 0; i < way.maps; ++i) {
    matrices.push_back(clip_from_world(*stage.texture_camera(i)));
    ends.push_back(i + 1 < way.maps ? way.splits->getSplitPoints()[i + 1] : camera.far_depth);
  }
  const gnomon::ShadowPlan like =
      gnomon::make_plan(camera, gnomon::DirectionalLight{street.sun}, {street.boxes, street.boxes});
  return plan_of(like, camera, matrices, ends, way.maps == 1 ? kTexelsOfOne : kTexelsOfFour, {});
}

MapNumbers numbers_of(const gnomon::ShadowPlan& plan) {
  MapNumbers numbers;
  numbers.end.fill(-1.0f);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    numbers.begin[i] = static_cast<float>(plan.map[i].depth_begin);
    numbers.end[i] = static_cast<float>(plan.map[i].depth_end);
    numbers.bias[i] = static_cast<float>(
        gnomon::engine_bias(plan.map[i], {}, gnomon::BiasWay::rasterizer, kKernelRadius).depth);
  }
  return numbers;
}

/// Shadow cameras whose matrix is not the plan's to the last bit.
int count_unlike(const Way& way, const Stage& stage) {
  int unlike = 0;
  for (std::size_t i = 0; i < way.gnomon->plan().maps().size(); ++i) {
    const glm::mat4 held(clip_from_world(*stage.texture_camera(i)));
    unlike += held == glm::mat4(way.gnomon->plan().map[i].clip_from_world) ? 0 : 1;
  }
  return unlike;
}

double set_up_microseconds(const Stage& stage) {
  std::vector<double> each;
  for (int i = 0; i < 31; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    stage.set_up_again();
    each.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  return median(each);
}

int run(const char* folder) {
  if (folder != nullptr) std::filesystem::create_directories(folder);
  const Street street;
  Stage stage(street, kWidth, kHeight);
  // create() of this class drops its arguments.
  std::vector<Way> ways{
      ogre_way("OGRE Focused", Ogre::FocusedShadowCameraSetup::create()),
      ogre_way("OGRE LiSPSM", Ogre::LiSPSMShadowCameraSetup::create()),
      ogre_way("OGRE LiSPSM, n_opt", std::make_shared<Ogre::LiSPSMShadowCameraSetup>(1.0f, false)),
      gnomon_way("gnomon, one map", street, 1),
      pssm_way("OGRE PSSM", street.camera(0, kWidth, kHeight), 0.0f),
      pssm_way("OGRE PSSM, n_opt", street.camera(0, kWidth, kHeight), 1.0f),
      gnomon_way("gnomon, four maps", street, kMaxTextures)};
  std::printf(
      "OGRE %d.%d.%d, RenderSystem_GL on %s\n%d frames of %d x %d pixels, one map of %d x %d texels or four "
      "of %d x %d\n\n",
      OGRE_VERSION_MAJOR, OGRE_VERSION_MINOR, OGRE_VERSION_PATCH, stage.device().c_str(), kFrames, kWidth,
      kHeight, kTexelsOfOne, kTexelsOfOne, kTexelsOfFour, kTexelsOfFour);
  int unlike = 0, maps = 0;
  std::vector<ExactPicture> exact;
  for (int frame = 0; frame < kFrames; ++frame)
    exact.push_back(exact_picture(street, street.camera(frame, kWidth, kHeight)));
  std::vector<Drawn> shown;
  for (Way& way : ways) {
    // The slope factor counts texels: the same for all maps.
    stage.use(way.setup, way.maps, way.maps == 1 ? kTexelsOfOne : kTexelsOfFour, 2.0 * (0.5 + kKernelRadius));
    for (int frame = 0; frame < kFrames; ++frame) {
      const gnomon::Camera camera = street.camera(frame, kWidth, kHeight);
      stage.look(camera);
      gnomon::ShadowPlan plan;
      Drawn drawn = stage.draw([&] {
        plan = plan_of_way(way, stage, street, camera);
        return numbers_of(plan);
      });
      count_wrong(exact[static_cast<std::size_t>(frame)], drawn.lit, way.wrong);
      way.m_p95.push_back(gnomon::measure(plan, camera, {street.boxes, street.boxes}).p95);
      if (way.gnomon != nullptr) {
        maps += plan.map_count;
        unlike += count_unlike(way, stage);
      }
      if (frame == 0) shown.push_back(std::move(drawn));
    }
    way.microseconds = set_up_microseconds(stage);
  }
  if (folder != nullptr) {
    // OGRE's best of one map beside gnomon's, and of four.
    write_pictures(std::filesystem::path(folder) / "one_map.png", exact[0], std::array{shown[2], shown[3]});
    write_pictures(std::filesystem::path(folder) / "four_maps.png", exact[0], std::array{shown[5], shown[6]});
  }

  std::printf("%-20s %13s %8s %10s\n", "", "misclassified", "m p95", "set-up, us");
  bool good = unlike == 0;
  for (const Way& way : ways) {
    std::printf("%-20s %11.3f %% %8.2f %10.1f\n", way.name, way.wrong.percent(), median(way.m_p95),
                way.microseconds);
    for (const Way& peer : ways)
      if (way.gnomon != nullptr && peer.gnomon == nullptr && peer.maps == way.maps)
        good = good && way.wrong.pixels <= peer.wrong.pixels;
  }
  std::printf("\nshadow cameras whose matrix differs from the plan's: %d of %d\n", unlike, maps);
  if (!good) std::fputs("ogre_sample: not as it should be, see above\n", stderr);
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
    std::fprintf(stderr, "usage: ogre_sample [FOLDER]\n");
    return 2;
  }
  // RenderSystem_GL ends with a crash there.
  if (std::getenv("DISPLAY") == nullptr) {
    std::fprintf(stderr, "ogre_sample: no display: run it by xvfb-run -a\n");
    return 2;
  }
  try {
    return run(argc == 2 ? argv[1] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ogre_sample: %s\n", error.what());
    return 2;
  }
}
