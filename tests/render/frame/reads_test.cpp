// Does a technique read, bind and draw no more than its equations need? What the linked programs hold on to,
// and how many passes a frame takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "filter/stored_maps.hpp"
#include "gl/program.hpp"
#include "gnomon/render/page_filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

using Names = std::set<std::string>;

/// Names of the program's active resources of a kind; of uniforms the samplers alone.
Names active(const Program& program, GLenum interface) {
  GLint count = 0;
  glGetProgramInterfaceiv(program.name(), interface, GL_ACTIVE_RESOURCES, &count);
  Names names;
  for (GLint i = 0; i < count; ++i) {
    const GLenum asked[2] = {GL_TYPE, GL_LOCATION};
    GLint of[2] = {0, -1};
    glGetProgramResourceiv(program.name(), interface, static_cast<GLuint>(i), 2, asked, 2, nullptr, of);
    char name[128] = "";
    glGetProgramResourceName(program.name(), interface, static_cast<GLuint>(i), sizeof name, nullptr, name);
    if (of[1] < 0) continue;  // of a block, or built in
    const auto type = static_cast<GLenum>(of[0]);
    const bool is_sampler = type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_ARRAY ||
                            type == GL_SAMPLER_2D_ARRAY_SHADOW || type == GL_UNSIGNED_INT_SAMPLER_2D_ARRAY;
    if (interface == GL_UNIFORM && !is_sampler) continue;
    std::string text = name;
    names.insert(text.substr(0, text.find('[')));
  }
  return names;
}

/// What the equations of each filter read of the map; a new filter reads what its kind does.
Names maps_read(const Filter& filter) {
  if (&filter == &filters::pcf_tent || &filter == &filters::revectorized) return {"shadow_depth"};
  if (&filter == &filters::hard) return {"shadow_depth"};
  if (&filter == &filters::silhouette) return {"shadow_depth", "shadow_points"};
  if (&filter == &filters::pcf) return {"shadow_compare", "shadow_depth"};
  if (&filter == &filters::pcss || &filter == &filters::smrt) return {"shadow_depth"};
  if (&filter == &filters::esm) return {"shadow_stored", "shadow_depth", "shadow_depth_max"};
  if (filter.info.reads == MapRead::summed) return {"shadow_sums"};
  return {"shadow_stored"};
}

TEST(Reads, the_mask_of_a_filter_fetches_the_surface_and_what_its_equations_need) {
  for (const Filter* filter : all_filters()) {
    const FilterPrograms programs = make_filter_programs(default_settings(*filter));
    Names wanted = maps_read(*filter);
    // Of the surface its place and its normals; its colour says what is sky.
    // Dithered transitions and turned samples take their noise from it.
    wanted.insert({"position_image", "normal_image", "albedo_image", "noise_tile"});
    EXPECT_EQ(active(programs.mask, GL_UNIFORM), wanted) << filter->info.name;
  }
}

/// The texts of all shaders that are compiled while it lives.
class CompiledTexts {
 public:
  CompiledTexts() {
    texts_.clear();
    real_ = std::exchange(glad_glShaderSource, &keep);
  }
  ~CompiledTexts() { glad_glShaderSource = real_; }
  CompiledTexts(const CompiledTexts&) = delete;
  CompiledTexts& operator=(const CompiledTexts&) = delete;

  /// Of the shaders that look maps up, how many have the places of shapes that bend lines, and how many not.
  struct Count {
    int bent = 0, linear = 0;
    bool operator==(const Count&) const = default;
  };
  [[nodiscard]] static Count count() {
    Count count;
    for (const std::string& text : texts_) {
      if (text.find("ShadowLookup shadow_lookup(") == std::string::npos) continue;
      ++(text.find("#define GNOMON_SHAPES 0") == std::string::npos ? count.bent : count.linear);
    }
    return count;
  }

 private:
  static void GLAD_API_PTR keep(GLuint shader, GLsizei count, const GLchar* const* text,
                                const GLint* length) {
    texts_.emplace_back(*text);
    real_(shader, count, text, length);
  }
  inline static std::vector<std::string> texts_;
  inline static PFNGLSHADERSOURCEPROC real_ = nullptr;
};

// Software renderers run the places of all shapes for every pixel: three times the time of a look-up.
TEST(Reads, masks_of_linear_maps_pages_and_pools_have_the_places_of_no_other_shape) {
  for (const Filter* filter : all_filters()) {
    const FilterSettings settings = default_settings(*filter);
    const CompiledTexts texts;
    FilterPrograms programs = make_filter_programs(settings);
    const CompiledTexts::Count linear = CompiledTexts::count();
    EXPECT_EQ(linear.bent, 0) << filter->info.name;
    EXPECT_GT(linear.linear, 0) << filter->info.name;
    if (page_filter_refusal(settings).empty()) {
      make_pages_programs(settings, programs);
      EXPECT_EQ(CompiledTexts::count().bent, 0) << filter->info.name;
      EXPECT_GT(CompiledTexts::count().linear, linear.linear) << filter->info.name;
    }
    if (!lights_shaders(*filter, programs.variant.reads).empty()) {
      const int before = CompiledTexts::count().linear;
      const Program mask = make_lights_program(settings), clusters = make_clusters_program(settings);
      EXPECT_EQ(CompiledTexts::count().bent, 0) << filter->info.name;
      EXPECT_EQ(CompiledTexts::count().linear, before + 2) << filter->info.name;
    }
    make_shaped_programs(settings, programs);
    EXPECT_GT(CompiledTexts::count().bent, 0) << filter->info.name;
  }
}

TEST(Reads, opaque_casters_are_drawn_from_their_positions_alone) {
  const Program opaque = make_caster_program("alpha/opaque", "depth/plain");
  EXPECT_EQ(active(opaque, GL_PROGRAM_INPUT), (Names{"position_object", "object_index"}));
  EXPECT_EQ(active(opaque, GL_UNIFORM), Names{});
  const Program masked = make_caster_program("alpha/masked", "depth/plain");
  EXPECT_EQ(active(masked, GL_PROGRAM_INPUT), (Names{"position_object", "object_index", "texcoord"}));
  EXPECT_EQ(active(masked, GL_UNIFORM), Names{"color_image"});
}

TEST(Reads, a_filter_has_the_programs_of_its_passes_and_no_others) {
  for (const Filter* filter : all_filters()) {
    const FilterPrograms programs = make_filter_programs(default_settings(*filter));
    const bool stores = filter->info.reads == MapRead::filtered || filter->info.reads == MapRead::joined;
    EXPECT_TRUE(programs.mask);
    EXPECT_EQ(programs.store_rows.size(), stores ? static_cast<std::size_t>(programs.variant.vectors) : 0)
        << filter->info.name << ": one for each vector that is blurred";
    EXPECT_EQ(static_cast<bool>(programs.blur_columns), stores) << filter->info.name;
    EXPECT_FALSE(programs.store || programs.blur) << filter->info.name << ": the kernel is known";
    FilterSettings in_world = default_settings(*filter);
    in_world.unit = KernelUnit::world;
    const FilterPrograms any_reach = make_filter_programs(in_world);
    EXPECT_EQ(any_reach.store && any_reach.blur, stores) << filter->info.name << ": each map has its own";
    EXPECT_TRUE(any_reach.store_rows.empty() && !any_reach.blur_columns) << filter->info.name;
    EXPECT_EQ(static_cast<bool>(programs.sum_rows), filter->info.reads == MapRead::summed)
        << filter->info.name;
    EXPECT_EQ(static_cast<bool>(programs.join_mip),
              reads_of(default_settings(*filter)) == MapRead::joined && filter->info.may_mipmap)
        << filter->info.name;
    EXPECT_EQ(static_cast<bool>(programs.depth_max), filter->hooks.needs_depth_max != nullptr)
        << filter->info.name;
  }
}

/// Passes over one map of this size, of a kernel in texels without mip-maps.
int passes_of(const FilterSettings& settings, int map_size) {
  const Filter& filter = *settings.filter;
  int passes = 0;
  if (filter.info.reads == MapRead::summed) passes += 2;  // along rows, then along columns
  if (filter.info.reads == MapRead::filtered || filter.info.reads == MapRead::joined)
    // Store all; or store and blur each vector along x, then along y.
    passes += settings.radius == 0.0 ? 1 : 2 * shadow_vectors(settings);
  if (filter.hooks.needs_depth_max != nullptr && filter.hooks.needs_depth_max(settings))
    passes += static_cast<int>(std::bit_width(static_cast<unsigned>(map_size / 2)));  // a level each
  return passes;
}

TEST(Reads, a_frame_takes_the_passes_that_its_filter_needs_for_each_map) {
  constexpr int kSize = 64, kMapSize = 128;
  const Scene scene = box_on_ground();
  Renderer renderer(scene);
  const Camera camera = camera_on_box(kSize, kSize);
  FrameOptions frame;
  frame.aliasing = frame.heat_map = frame.cascade_tint = frame.time_passes = false;
  frame.prune = PruneRules{}.without(PruneRule::held_maps).without(PruneRule::scrolled_maps);
  for (const Filter* filter : all_filters()) {
    for (const double radius : {0.0, 1.0, 3.0}) {
      FilterSettings settings = default_settings(*filter);
      settings.radius = radius;
      PlanOptions options;
      options.resolution.max_size = kMapSize;
      options.cascades = 2;
      options.prune = kPruneNothing;
      set_margin(settings, options);
      const ShadowPlan plan = plan_for(scene, camera, {0.3, -1.0, -0.2}, options);
      ASSERT_GT(plan.map_count, 0);
      const FrameStats stats = renderer.draw(plan, camera, renderer.prepare(settings), frame);
      EXPECT_EQ(stats.prefilter_passes, plan.map_count * passes_of(settings, kMapSize))
          << filter->info.name << ", radius " << radius;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
