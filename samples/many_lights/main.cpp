// A flight through a scene under many lights whose shadow maps share one pool: LightPool -> draw.
//
// usage: many_lights [SCENE] [FOLDER] [LIGHTS]     builtin:hangar, out/many_lights and 24 where nothing is
// said; LIGHTS is a number, or `file` for all lights of the scene's file
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <glm/vec3.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/render/context.hpp>
#include <gnomon/render/filter.hpp>
#include <gnomon/render/light_pool.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/camera_path.hpp>
#include <gnomon/scene/default_light.hpp>
#include <gnomon/scene/image.hpp>
#include <gnomon/scene/load.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 6, kWidth = 960, kHeight = 540;
constexpr double kStep = 0.004;  // of the flight, from frame to frame

constexpr int kOfFile = 0;  // lights, in place of a number

/// Lights over the scene, warm and cold by turns, and a faint moon; or all lights of its file.
std::vector<gnomon::render::PooledLight> place_lights(const gnomon::Scene& scene, int count) {
  std::vector<gnomon::render::PooledLight> lights;
  if (count == kOfFile) {
    lights = gnomon::render::lights_of(scene);
    if (lights.empty())
      throw std::runtime_error("LIGHTS file: the scene's file has no light that can be read and shines");
    return lights;
  }
  constexpr glm::vec3 kMoon{0.03f, 0.04f, 0.06f}, kWarm{0.5f, 0.3f, 0.15f}, kCold{0.25f, 0.35f, 0.5f};
  lights.push_back({{gnomon::DirectionalLight{{0.4, -1.0, 0.3}}, 0.1}, kMoon});
  for (const gnomon::Light& light : gnomon::local_lights(count, scene.bounds_world))
    lights.push_back({{light}, lights.size() % 2 == 0 ? kWarm : kCold});
  return lights;
}

int fly(const std::string& scene_name, const fs::path& folder, int count) {
  const auto context = gnomon::render::create_context(gnomon::render::ContextKind::automatic);
  const gnomon::Scene scene = gnomon::load_scene(scene_name);
  const gnomon::CameraPath path = gnomon::default_path(scene);
  std::vector<gnomon::Box> boxes;
  for (const gnomon::Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  // Sorted once: each light reads the boxes near it alone.
  std::vector<gnomon::CasterBlock> blocks(gnomon::CasterSet::block_count(boxes.size()));
  std::vector<std::uint32_t> indices(gnomon::CasterSet::index_count(boxes.size()));
  const gnomon::CasterSet set(boxes, blocks, indices);
  gnomon::render::Renderer renderer(scene);
  const gnomon::render::FilterSettings pcf = gnomon::render::default_settings(gnomon::render::filters::pcf);
  const gnomon::render::PreparedFilter filter = renderer.prepare(pcf, gnomon::render::Source::lights);
  gnomon::LightOptions pool;
  gnomon::render::set_margin(pcf, pool.plan);
  gnomon::render::LightPool lights(place_lights(scene, count), pool);
  double exposure = 1.0;
  fs::create_directories(folder);

  for (int frame = 0; frame < kFrames; ++frame) {
    const gnomon::Camera camera = path.at(0.3 + kStep * frame, kWidth, kHeight);

    // 1. Sizes and places of all lights' maps, which of them are due (plan_lights), and a plan for each that
    // is (make_plan).
    const auto begin = std::chrono::steady_clock::now();
    const gnomon::LightPlan& plan = lights.plan(camera, {set, set});
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (plan.status == gnomon::PlanStatus::invalid_input) {
      std::fprintf(stderr, "many_lights: the plan refuses %s\n", std::string(plan.invalid_field).c_str());
      return 2;
    }

    // 2. Draw: the maps of due lights, then the sum of all light. Lux and candela of a file need an exposure.
    gnomon::render::FrameStats stats = renderer.draw({plan, lights.drawn(exposure)}, camera, filter);
    if (count == kOfFile && frame == 0) {
      exposure = gnomon::render::exposure_of(renderer.light_sum());
      if (exposure == 0.0) exposure = 1.0;  // nothing in view is lit
      stats = renderer.draw({plan, lights.drawn(exposure)}, camera, filter);
    }
    gnomon::write_png(renderer.image(), folder / ("frame_" + std::to_string(frame) + ".png"));
    std::printf(
        "frame %d: %d of %zu lights have maps, %d due, %.1f of %.1f million texels drawn, planned in %.2f "
        "ms\n",
        frame, plan.mapped, lights.lights().size(), plan.due, static_cast<double>(stats.texels) * 1e-6,
        static_cast<double>(plan.texels) * 1e-6, ms);
  }
  std::printf("pictures: %s\n", folder.string().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--help") {
    std::puts("usage: many_lights [SCENE] [FOLDER] [LIGHTS]");
    return 0;
  }
  try {
    const bool of_file = argc > 3 && std::string(argv[3]) == "file";
    const int count = of_file ? kOfFile : argc > 3 ? std::atoi(argv[3]) : 24;
    if (!of_file && (count < 1 || count > 1000)) {
      std::fprintf(stderr, "many_lights: LIGHTS must lie in 1..1000, or be `file`\n");
      return 2;
    }
    return fly(argc > 1 ? argv[1] : "builtin:hangar", argc > 2 ? argv[2] : "out/many_lights", count);
  } catch (const std::exception& error) {  // files and drivers; planning throws nothing
    std::fprintf(stderr, "many_lights: %s\n", error.what());
    return 2;
  }
}
