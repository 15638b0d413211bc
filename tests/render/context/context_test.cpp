// Contexts: which is taken, and do all of them draw the same?
#include <glad/gl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>

#include "gnomon/render/context.hpp"
#include "gnomon/render/probe.hpp"
#include "gnomon/render/renderer.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kSize = 128;

TEST(ContextKind, is_known_by_its_name) {
  for (const ContextKind kind :
       {ContextKind::automatic, ContextKind::osmesa, ContextKind::egl, ContextKind::glfw}) {
    ContextKind found = ContextKind::glfw;
    EXPECT_TRUE(context_kind_from_name(to_string(kind), found));
    EXPECT_EQ(found, kind);
  }
  ContextKind untouched = ContextKind::egl;
  EXPECT_FALSE(context_kind_from_name("vulkan", untouched));
  EXPECT_EQ(untouched, ContextKind::egl);
}

TEST(CreateContext, refuses_a_window_and_says_where_to_get_one) {
  try {
    (void)create_context(ContextKind::glfw);
    FAIL() << "made a window without a display";
  } catch (const RenderError& error) {
    EXPECT_NE(std::string(error.what()).find("create_window"), std::string::npos);
  }
}

TEST(CreateContext, needs_no_display_and_says_what_it_took_and_why) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const auto context = create_context();
  const ContextInfo& info = context->info();
  EXPECT_NE(info.kind, ContextKind::automatic);
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_NE(info.description().find(info.renderer), std::string::npos);
  // In software, every GPU that was looked for is accounted for.
  if (info.software) {
    EXPECT_FALSE(info.refused.empty());
  }
  for (const std::string& line : info.refused) EXPECT_NE(info.description().find(line), std::string::npos);
}

TEST(MemoryTakesMaps, what_fits_and_refuses_what_no_machine_has) {
  const auto context = create_context();
  EXPECT_TRUE(memory_takes_maps(64, 4, 4.0));
  EXPECT_TRUE(memory_takes_maps(64, 4, 40.0));
  // 16 Pi of bytes: refused before anything is taken in software, by the driver else.
  EXPECT_FALSE(memory_takes_maps(1 << 14, 1 << 11, 1 << 15));
  // An earlier call's error is not taken for its answer.
  glEnable(GL_TEXTURE_2D_ARRAY);
  EXPECT_TRUE(memory_takes_maps(64, 1, 4.0));
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(LargestMaps, are_halved_to_the_limit_and_say_why) {
  const auto context = create_context();
  const FittingMaps all = largest_maps(256, 4, 4.0, 1.0);
  EXPECT_EQ(all.size, 256);
  EXPECT_TRUE(all.why.empty()) << all.why;
  const FittingMaps half = largest_maps(256, 4, 4.0, 0.3);
  EXPECT_EQ(half.size, 128);
  EXPECT_NE(half.why.find("0.3"), std::string::npos) << half.why;
  EXPECT_EQ(largest_maps(256, 4, 4.0, 1e-6).size, 0);
}

/// FNV-1a, 64 bits.
template <class T>
std::uint64_t hash_of(const std::vector<T>& values) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const T& value : values) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3ull;
  }
  return hash;
}

struct Hashes {
  std::uint64_t depth, mask, aliasing, image;
  bool operator==(const Hashes&) const = default;
};

std::optional<Hashes> drawn_by(ContextKind kind, std::string& renderer_name) {
  std::unique_ptr<Context> context;
  try {
    context = create_context(kind);
  } catch (const RenderError& error) {
    renderer_name = error.what();
    return std::nullopt;
  }
  renderer_name = context->info().renderer;
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  PlanOptions options;
  options.resolution.max_size = 256;
  options.cascades = 2;
  renderer.draw(plan_for(scene, camera, {0.4, -0.8, -0.3}, options), camera, renderer.prepare(filters::pcf));
  return Hashes{hash_of(renderer.depth_map(0).values), hash_of(renderer.mask().values),
                hash_of(renderer.aliasing().values), hash_of(renderer.image().rgba)};
}

TEST(Backends, osmesa_and_egl_draw_the_same_bits) {
  std::string osmesa_renderer, egl_renderer;
  const std::optional<Hashes> osmesa = drawn_by(ContextKind::osmesa, osmesa_renderer);
  const std::optional<Hashes> egl = drawn_by(ContextKind::egl, egl_renderer);
  // A machine may have one of them alone: there is nothing to compare.
  if (!osmesa || !egl) GTEST_SKIP() << "needs both: " << osmesa_renderer << "; " << egl_renderer;
  // Two drivers round as they like: only of one and the same are equal bits a promise.
  if (osmesa_renderer != egl_renderer)
    GTEST_SKIP() << "not the same renderer: " << osmesa_renderer << ", " << egl_renderer;
  EXPECT_EQ(osmesa->depth, egl->depth);
  EXPECT_EQ(osmesa->mask, egl->mask);
  EXPECT_EQ(osmesa->aliasing, egl->aliasing);
  EXPECT_EQ(osmesa->image, egl->image);
  // The hash tells pictures apart: depth, mask and image are three different ones.
  EXPECT_NE(osmesa->depth, osmesa->mask);
  EXPECT_NE(osmesa->mask, osmesa->image);
}

TEST(Backends, draw_the_same_bits_every_time) {
  std::string name;
  const std::optional<Hashes> first = drawn_by(ContextKind::automatic, name);
  ASSERT_TRUE(first) << name;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(*drawn_by(ContextKind::automatic, name), *first);
}

TEST(Contexts, of_two_kinds_take_turns) {
  std::unique_ptr<Context> a, b;
  try {
    a = create_context(ContextKind::osmesa);
    b = create_context(ContextKind::egl);
  } catch (const RenderError& error) {
    GTEST_SKIP() << error.what();
  }
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  a->make_current();
  auto in_a = std::make_unique<Renderer>(scene);
  b->make_current();
  auto in_b = std::make_unique<Renderer>(scene);
  a->make_current();
  in_a->draw(ShadowPlan{}, camera, in_a->prepare(filters::hard));
  const Image from_a = in_a->image();
  in_a.reset();
  b->make_current();
  in_b->draw(ShadowPlan{}, camera, in_b->prepare(filters::hard));
  EXPECT_EQ(in_b->image().rgba.size(), from_a.rgba.size());
  in_b.reset();
}

TEST(Contexts, of_two_threads_draw_at_the_same_time) {
  std::string name;
  const std::optional<Hashes> alone = drawn_by(ContextKind::automatic, name);
  ASSERT_TRUE(alone) << name;
  constexpr int kFrames = 4;  // of each thread: contexts come and go while the other draws
  std::array<std::vector<Hashes>, 2> drawn;
  const auto draw = [&drawn](std::size_t thread) {
    std::string renderer;
    for (int i = 0; i < kFrames; ++i)
      drawn[thread].push_back(drawn_by(ContextKind::automatic, renderer).value_or(Hashes{}));
  };
  std::thread first(draw, 0u), second(draw, 1u);
  first.join();
  second.join();
  for (const std::vector<Hashes>& of_thread : drawn)
    for (const Hashes& hashes : of_thread) EXPECT_EQ(hashes, *alone);
}

TEST(Contexts, have_a_table_of_functions_on_the_threads_that_make_them_current_alone) {
  const auto context = create_context();
  ASSERT_NE(glad_glClear, nullptr);
  bool elsewhere = true;
  std::thread([&elsewhere] { elsewhere = glad_glClear != nullptr; }).join();
  EXPECT_FALSE(elsewhere);
}

/// While it lives, the driver of this thread's context says that it was reset.
class LostContext {
 public:
  explicit LostContext(GLenum status) {
    status_ = status;
    glad_glGetGraphicsResetStatus = [] { return status_; };
  }
  ~LostContext() { glad_glGetGraphicsResetStatus = driver_; }
  LostContext(const LostContext&) = delete;
  LostContext& operator=(const LostContext&) = delete;

 private:
  static inline GLenum status_ = GL_NO_ERROR;
  PFNGLGETGRAPHICSRESETSTATUSPROC driver_ = glad_glGetGraphicsResetStatus;
};

TEST(CheckContext, says_in_one_line_who_lost_it) {
  const auto context = create_context();
  EXPECT_NO_THROW(check_context());
  for (const auto& [status, who] : {std::pair{GL_GUILTY_CONTEXT_RESET, "what was drawn here"},
                                    {GL_INNOCENT_CONTEXT_RESET, "another program"},
                                    {GL_UNKNOWN_CONTEXT_RESET, "unknown reason"}}) {
    const LostContext lost(static_cast<GLenum>(status));
    try {
      check_context();
      ADD_FAILURE() << "took a lost context for a sound one: " << who;
    } catch (const RenderError& error) {
      EXPECT_NE(std::string(error.what()).find(who), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_NO_THROW(check_context());
}

TEST(Renderer, gives_no_picture_of_a_lost_context) {
  const auto context = create_context();
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  Renderer renderer(scene);
  PlanOptions options;
  options.resolution.max_size = 64;
  const PreparedFilter filter = renderer.prepare(filters::pcf);
  const ShadowPlan plan = plan_for(scene, camera, {0.4, -0.8, -0.3}, options);
  renderer.draw(plan, camera, filter);
  {
    const LostContext lost(GL_UNKNOWN_CONTEXT_RESET);
    renderer.draw(plan, camera, filter);  // nothing throws while a frame is drawn
    EXPECT_THROW((void)renderer.image(), RenderError);
    EXPECT_THROW((void)renderer.heat_map(), RenderError);
    EXPECT_THROW((void)renderer.cascade_tint(), RenderError);
    EXPECT_THROW((void)renderer.mask(), RenderError);
    EXPECT_THROW((void)renderer.aliasing(), RenderError);
    EXPECT_THROW((void)renderer.positions(), RenderError);
    EXPECT_THROW((void)renderer.normals(), RenderError);
    EXPECT_THROW((void)renderer.depth_map(0), RenderError);
    EXPECT_THROW((void)renderer.drawn_depths(filter.settings, plan), RenderError);
  }
  EXPECT_FALSE(renderer.image().rgba.empty());
}

/// Of this process, now.
double resident_mib() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

TEST(Renderer, leaves_no_memory_behind) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer keeps freed memory, and finds leaks itself";
#endif
  const auto context = create_context();
  const Scene scene = box_on_ground();
  const Camera camera = camera_on_box(kSize, kSize);
  const auto draw_once = [&] {
    Renderer renderer(scene);
    PlanOptions options;
    options.resolution.max_size = 512;
    options.cascades = 4;
    renderer.draw(plan_for(scene, camera, {0.4, -0.8, -0.3}, options), camera,
                  renderer.prepare(filters::vsm));
    EXPECT_FALSE(renderer.mask().values.empty());
  };
  constexpr int kFirst = 10, kMore = 190;
  for (int i = 0; i < kFirst; ++i) draw_once();  // caches of the driver fill
  const double before = resident_mib();
  for (int i = 0; i < kMore; ++i) draw_once();
  // The driver's compiler moves the process by up to 20 MiB either way. An image of 512 x 512 that each
  // renderer leaves behind takes 190.
  constexpr double kMaxGrowthMib = 60.0;
  const double after = resident_mib();
  RecordProperty("mebibytes", std::to_string(before) + " then " + std::to_string(after));
  EXPECT_LT(after - before, kMaxGrowthMib) << "from " << before << " MiB";
}

}  // namespace
}  // namespace gnomon::render
