// How much stack do the calls of a frame take? For fibers and threads with small stacks.
#include <gtest/gtest.h>
#include <pthread.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <new>
#include <vector>

#include "gnomon/extend/shape.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

constexpr bool kSanitized =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer) || __has_feature(undefined_behavior_sanitizer)
    true;
#else
    false;
#endif
#else
    false;
#endif
#ifdef NDEBUG
constexpr bool kOptimized = true;
#else
constexpr bool kOptimized = false;
#endif

// docs/performance.md states these.
constexpr std::size_t kKilo = 1024;
constexpr std::size_t kMost = 64 * kKilo, kFocus = 12 * kKilo, kViews = 100 * kKilo;

/// Bytes of a painted stack that a call touches, less those of a thread that does nothing.
std::size_t touched(const std::function<void()>& call) {
  constexpr std::size_t kSize = std::size_t{1} << 20, kAlignment = 1 << 16;
  constexpr unsigned char kPaint = 0xA5;
  std::vector<unsigned char> memory(kSize + kAlignment);
  const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
  unsigned char* const stack = memory.data() + (kAlignment - address % kAlignment);
  std::memset(stack, kPaint, kSize);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  EXPECT_EQ(pthread_attr_setstack(&attributes, stack, kSize), 0);
  pthread_t thread{};
  const auto run = [](void* argument) -> void* {
    (*static_cast<const std::function<void()>*>(argument))();
    return nullptr;
  };
  EXPECT_EQ(pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&call)), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  std::size_t untouched = 0;
  while (untouched < kSize && stack[untouched] == kPaint) ++untouched;
  return kSize - untouched;
}

class Stack : public testing::Test {
 protected:
  void SetUp() override {
    // The bounds are promised of optimized builds: sanitizers pad frames, and without -O nothing shares a
    // place.
    if (kSanitized || !kOptimized) GTEST_SKIP() << "stack frames of other builds are larger";
    nothing_ = touched([] {});
    for (int i = 0; i < 3000; ++i) points_.push_back({-4.0 + i % 9, 0.0, -8.0 - 0.04 * i});
  }
  void expect(const char* name, std::size_t most, const std::function<void()>& call) {
    const std::size_t bytes = touched(call) - nothing_;
    EXPECT_LE(bytes, most) << name;
    EXPECT_GT(bytes, 1000u) << name;
    largest_ = std::max(largest_, bytes);
  }
  void TearDown() override { std::cout << "largest: " << largest_ << " bytes\n"; }

  std::size_t nothing_ = 0, largest_ = 0;
  std::vector<glm::dvec3> points_;
  Camera camera_ = perspective_camera({0, 6, 14}, {0, -0.45, -1}, {0, 1, 0}, 1.0, 1.6, 0.1, 300, 640, 400);
  std::vector<Box> boxes_ = {
      {{-20, -1, -200}, {20, 0, 20}}, {{1, 0, 1}, {2, 3, 2}}, {{-6, 0, -7}, {-5, 3, -5}}};
  SceneBounds bounds_{boxes_, boxes_};
  std::array<Light, 3> lights_ = {DirectionalLight{{0.3, -1, 0.2}}, PointLight{{3, 8, 2}, 40.0},
                                  SpotLight{{3, 8, 2}, {0.1, -1, 0.2}, 0.6, 40.0}};
  // Plans are made in their place: their own size is the caller's.
  alignas(ShadowPlan) std::array<std::byte, sizeof(ShadowPlan)> place_{};
};

TEST_F(Stack, make_plan_with_every_partition_fit_and_warp) {
  for (const Light& light : lights_) {
    for (const Partition partition :
         {Partition::view_depth, Partition::frustum_faces, Partition::separating_plane,
          Partition::receiver_clusters, Partition::tetrahedron}) {
      for (const Fit fit : {Fit::tight, Fit::rotated, Fit::stable, Fit::warped_stable}) {
        for (const Warp* warp : all_warps()) {
          PlanOptions options;
          options.cascades = 4;
          options.fit = fit;
          options.split.partition = partition;
          options.warp.warp = warp;
          PlanHistory history;
          const View view{.camera = camera_, .points_world = points_};
          expect("make_plan", kMost,
                 [&] { new (&place_) ShadowPlan(make_plan(view, light, bounds_, options)); });
          expect("with a history", kMost,
                 [&] { new (&place_) ShadowPlan(make_plan(camera_, light, bounds_, options, &history)); });
        }
      }
    }
  }
}

TEST_F(Stack, make_plan_with_every_shape_split_and_objective) {
  for (const Light& light : lights_) {
    for (const Shape* shape : all_shapes()) {
      for (const Objective objective :
           {Objective::storage, Objective::max, Objective::p95, Objective::picture}) {
        for (const SplitScheme scheme : {SplitScheme::automatic, SplitScheme::optimal}) {
          PlanOptions options;
          options.cascades = 3;
          options.warp.shape = shape;
          options.warp.objective = objective;
          options.split.scheme = scheme;
          expect("make_plan", kMost,
                 [&] { new (&place_) ShadowPlan(make_plan(camera_, light, bounds_, options)); });
          const View view{.camera = camera_, .points_world = points_};
          expect("of points", kMost,
                 [&] { new (&place_) ShadowPlan(make_plan(view, light, bounds_, options)); });
        }
      }
    }
  }
}

TEST_F(Stack, make_plan_with_rare_options) {
  std::vector<Light> lights(lights_.begin(), lights_.end());
  lights.push_back(SpotLight{{3, 8, 2}, {0.1, -1, 0.2}, 1.1, 40.0});  // of one map or several
  for (const Light& light : lights) {
    for (const Partition partition : {Partition::view_depth, Partition::frustum_faces,
                                      Partition::separating_plane, Partition::receiver_clusters}) {
      for (int rare = 0; rare < 9; ++rare) {
        PlanOptions options;
        options.split.partition = partition;
        options.split.face_slices = 4;
        options.warp.objective = rare % 2 == 0 ? Objective::picture : Objective::storage;
        if (rare == 1) options.split.pseudo_near = 3.0;
        if (rare == 2) options.resolution.max_error = 2.0;
        if (rare == 3 || rare == 8) options.resolution.texel_budget = 1 << 20;
        if (rare == 4) options.filter.world = 0.2;
        if (rare == 5) options.split.selection = MapSelection::finest;
        if (rare == 6) options.prune = kPruneNothing;
        if (rare == 7) options.warp.focus = {{-4, 0, -8}, {4, 3, 0}};
        Camera camera = camera_;
        if (rare == 0) camera.far_depth = std::numeric_limits<double>::infinity();
        expect("make_plan", rare == 7 ? kMost + kFocus : kMost,
               [&] { new (&place_) ShadowPlan(make_plan(camera, light, bounds_, options)); });
      }
    }
  }
}

TEST_F(Stack, plan_views) {
  for (const Light& light : lights_) {
    const std::vector<Camera> cameras(kMaxViews, camera_);
    expect("plan_views", kViews, [&] { new (&place_) ShadowPlan(plan_views(cameras, light, bounds_)); });
  }
}

TEST_F(Stack, measure) {
  for (const Light& light : lights_) {
    const ShadowPlan plan = make_plan(camera_, light, bounds_);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    AliasingStats stats;
    expect("measure", kMost, [&] { stats = measure(plan, camera_, bounds_); });
    EXPECT_GT(stats.samples, 1000u);
    const View view{.camera = camera_, .points_world = points_};
    expect("measure at points", kMost, [&] { stats = measure(plan, view, bounds_); });
  }
}

TEST_F(Stack, plan_pages_and_their_measure) {
  const std::vector<glm::dvec3> normals(points_.size(), {0.0, 1.0, 0.0});
  const View view{.camera = camera_, .points_world = points_, .normals_world = normals};
  int measured = 0;
  for (const Light& light : lights_) {
    for (const PagePolicy* policy : all_page_policies()) {
      for (const double share : {1.0, 0.9}) {
        PageOptions options;
        options.policy = policy;
        options.share = share;
        options.plan.fit = share < 1.0 ? Fit::stable : Fit::tight;
        std::vector<std::byte> memory(page_memory(options.capacity, std::size_t{1} << 17));
        alignas(PagePlan) std::array<std::byte, sizeof(PagePlan)> place;
        const auto* const plan = reinterpret_cast<const PagePlan*>(place.data());
        PageStats stats;
        expect("plan_pages of boxes", kMost,
               [&] { new (&place) PagePlan(plan_pages(camera_, light, bounds_, options, memory)); });
        expect("plan_pages", kMost,
               [&] { new (&place) PagePlan(plan_pages(view, light, bounds_, options, memory)); });
        if (plan->status != PlanStatus::ok) continue;  // points that the spot does not light
        ++measured;
        expect("measure", kMost, [&] { stats = measure(*plan, view, bounds_); });
        EXPECT_GT(stats.m.samples, 100u);
        expect("measure of boxes", kMost, [&] { stats = measure(*plan, camera_, bounds_); });
      }
    }
  }
  EXPECT_GE(measured, 10);
}

TEST_F(Stack, plan_lights) {
  for (const int count : {1, 30, 300}) {
    std::vector<LightRequest> requests;
    for (int i = 0; i < count; ++i) requests.push_back({PointLight{{i % 30 - 15.0, 3.0, -0.5 * i}, 10.0}});
    requests.push_back({lights_[0]});
    std::vector<std::byte> memory(light_memory(requests.size(), points_.size()));
    alignas(LightPlan) std::array<std::byte, sizeof(LightPlan)> place;
    const View view{.camera = camera_, .points_world = points_};
    expect("plan_lights", kMost,
           [&] { new (&place) LightPlan(plan_lights(view, requests, bounds_, {}, memory)); });
    EXPECT_EQ(reinterpret_cast<const LightPlan*>(place.data())->status, PlanStatus::ok);
  }
}

}  // namespace
}  // namespace gnomon::test
