// Contexts: which is taken, and do all of them draw the same?
#include <glad/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <optional>

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

}  // namespace
}  // namespace gnomon::render
