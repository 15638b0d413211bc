// A flight through a scene under many lights whose shadow maps share one pool: plan_lights -> make_plan ->
// draw.
//
// usage: many_lights [SCENE] [FOLDER] [LIGHTS]     builtin:hangar, out/many_lights and 24 where nothing is
// said; LIGHTS is a number, or `file` for all lights of the scene's file
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/render/context.hpp>
#include <gnomon/render/filter.hpp>
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

/// Lights over the scene, and a faint moon; or all lights of its file.
std::vector<gnomon::LightRequest> place_lights(const gnomon::Scene& scene, int count) {
  if (count == kOfFile) {
    std::vector<gnomon::LightRequest> lights;
    for (const gnomon::SceneLight& of_file : scene.lights) lights.push_back({of_file.light});
    if (lights.empty())
      throw std::runtime_error("LIGHTS file: the scene's file has no light that can be read");
    return lights;
  }
  std::vector<gnomon::LightRequest> lights{{gnomon::DirectionalLight{{0.4, -1.0, 0.3}}, 0.1}};
  for (const gnomon::Light& light : gnomon::local_lights(count, scene.bounds_world))
    lights.push_back({light});
  return lights;
}

/// Warm and cold by turns, and the moon.
glm::vec3 color_of(const gnomon::Light& light, std::size_t index) {
  if (std::holds_alternative<gnomon::DirectionalLight>(light)) return {0.03f, 0.04f, 0.06f};
  return index % 2 == 0 ? glm::vec3(0.5f, 0.3f, 0.15f) : glm::vec3(0.25f, 0.35f, 0.5f);
}

/// The maps of each light, as drawn last, and everything that plan_lights writes to.
struct Lights {
  std::vector<gnomon::LightRequest> requests;
  std::vector<gnomon::ShadowPlan> plans;
  std::vector<std::byte> memory;
  std::vector<gnomon::LightState> states;
  gnomon::LightHistory history;

  explicit Lights(std::vector<gnomon::LightRequest> all)
      : requests(std::move(all)),
        plans(requests.size()),
        memory(gnomon::light_memory(requests.size(), 0)),
        states(requests.size()),
        history{states, 0, {}} {}
  [[nodiscard]] std::vector<gnomon::render::DrawnLight> drawn() const {
    std::vector<gnomon::render::DrawnLight> lights;
    for (std::size_t i = 0; i < requests.size(); ++i)
      lights.push_back({requests[i].light, &plans[i], color_of(requests[i].light, i)});
    return lights;
  }
};

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
  Lights lights(place_lights(scene, count));
  fs::create_directories(folder);

  for (int frame = 0; frame < kFrames; ++frame) {
    const gnomon::Camera camera = path.at(0.3 + kStep * frame, kWidth, kHeight);

    // 1. Sizes and places of all lights' maps, and which of them are due.
    const auto begin = std::chrono::steady_clock::now();
    const gnomon::LightPlan plan =
        gnomon::plan_lights(camera, lights.requests, {set, set}, pool, lights.memory, &lights.history);
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (plan.status == gnomon::PlanStatus::invalid_input) {
      std::fprintf(stderr, "many_lights: the plan refuses %s\n", std::string(plan.invalid_field).c_str());
      return 2;
    }

    // 2. A plan for each light that is due.
    for (std::size_t i = 0; i < lights.requests.size(); ++i) {
      const gnomon::LightMaps& own = plan.lights[i];
      if (!own.due) continue;
      const gnomon::Light& light = lights.requests[i].light;
      lights.plans[i] = gnomon::make_plan(own.frames > 1 ? gnomon::camera_round(light, camera) : camera,
                                          light, {set, set}, gnomon::light_options(pool, own));
    }

    // 3. Draw: the maps of due lights, then the sum of all light.
    const gnomon::render::FrameStats stats = renderer.draw({plan, lights.drawn()}, camera, filter);
    gnomon::write_png(renderer.image(), folder / ("frame_" + std::to_string(frame) + ".png"));
    std::printf(
        "frame %d: %d of %zu lights have maps, %d due, %.1f of %.1f million texels drawn, planned in %.2f "
        "ms\n",
        frame, plan.mapped, lights.requests.size(), plan.due, static_cast<double>(stats.texels) * 1e-6,
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
