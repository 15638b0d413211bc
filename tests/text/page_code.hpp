// What the C++ in pages takes for granted: names that a program would have by then. page_code.py puts the
// blocks below it; they are compiled, and never run.
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/scene/pose.hpp"
#include "gnomon/scene/translucent.hpp"
#include "gnomon/study/engine_bias.hpp"

namespace gnomon::pages {

using namespace gnomon::render;

extern glm::dvec3 eye, forward, up, sun, held;
extern glm::dmat4 view_from_world, clip_from_view;
extern Camera camera;
extern Light light;
extern std::vector<Light> lights;
extern std::vector<Box> boxes, casters, receivers, moved_bounds;
extern Box all_casters;
extern CasterSet set;
extern SceneBounds bounds;
extern PlanOptions options;
extern ShadowPlan plan;
extern PlanHistory history;
extern DepthTracker tracker;
extern std::vector<glm::dvec3> points, normals, visible;
extern std::size_t pool_slots;
extern std::vector<std::uint32_t> slot_table;
extern std::vector<KeptPage> out;
extern Scene scene;
extern Renderer renderer;
extern PreparedFilter filter;
extern std::uint32_t frame;
extern bool running, light_moved;
void fail(std::string_view reason);
void draw(const ShadowMap& map, const TexelRect& place);
void draw(const glm::dmat4& clip_from_world, int width_texels, int height_texels);
void light_shadow(double bias, double normal_bias);
void draw_page(const ShadowMap& map, std::uint32_t slot);

}  // namespace gnomon::pages
