// A flight through a scene with planned shadow maps, in one page: make_plan -> draw -> measure.
// The installed program `flythrough` is the same with every option; this is how to begin with your own.
//
// usage: flythrough_sample [SCENE] [FOLDER]     builtin:city and out/flythrough_sample where nothing is said
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <gnomon/gnomon.hpp>
#include <gnomon/render/context.hpp>
#include <gnomon/render/filter.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/camera_path.hpp>
#include <gnomon/scene/default_light.hpp>
#include <gnomon/scene/image.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/shadow_boxes.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 4, kWidth = 640, kHeight = 360;

/// Input of the plan: the light, and a box around each drawn object. Here every object casts and receives; an
/// engine lists only those that do.
struct World {
  gnomon::Scene scene;
  gnomon::Light light;
  gnomon::ShadowBoxes boxes;
  gnomon::CameraPath path;
};

World load_world(const std::string& name) {
  World world;
  world.scene = gnomon::load_scene(name);
  world.light = gnomon::default_light({}, world.scene.bounds_world);
  world.path = gnomon::default_path(world.scene);
  world.boxes = gnomon::ShadowBoxes(world.scene);
  return world;
}

/// The error as it arrived in the picture: m is the number of screen pixels that one shadow texel covers.
/// Sharp shadows need m <= 1 where they are looked at.
struct SeenError {
  double median = 0.0, p95 = 0.0, share_undersampled = 0.0;
};

SeenError seen_error(const gnomon::FloatImage& aliasing) {
  std::vector<float> m;  // of the pixels that face the light and lie in a map
  for (std::size_t i = 0; i < aliasing.values.size(); i += 4) {
    const float m_max = aliasing.values[i], map = aliasing.values[i + 3];
    if (map >= 0.0f && m_max > 0.0f) m.push_back(m_max);
  }
  if (m.empty()) return {};
  std::sort(m.begin(), m.end());
  const auto at = [&m](double share) {
    return static_cast<double>(m[static_cast<std::size_t>(share * static_cast<double>(m.size() - 1))]);
  };
  const auto above_one = m.end() - std::upper_bound(m.begin(), m.end(), 1.0f);
  return {at(0.5), at(0.95), static_cast<double>(above_one) / static_cast<double>(m.size())};
}

void describe_plan(int frame, const gnomon::ShadowPlan& plan) {
  std::printf("frame %d\n", frame);
  for (const gnomon::ShadowMap& map : plan.maps()) {
    std::printf("  map %d: %d x %d texels for view depths %.1f to %.1f, warp %s\n", map.cascade, map.width,
                map.height, map.depth_begin, map.depth_end, std::string(map.warp->name).c_str());
  }
  // The plan lists what it omitted, with the reason.
  for (const gnomon::Omission& omission : plan.omitted()) {
    const gnomon::OmissionText text = gnomon::describe(omission);
    std::printf("  omitted %s: %s\n", text.what.data(), text.why.data());
  }
}

int fly(const std::string& scene_name, const fs::path& folder) {
  // An OpenGL context without a window: a GPU where there is one, else Mesa's software renderer.
  const auto context = gnomon::render::create_context(gnomon::render::ContextKind::automatic);
  const World world = load_world(scene_name);
  gnomon::render::Renderer renderer(world.scene);
  const gnomon::render::PreparedFilter filter = renderer.prepare(gnomon::render::filters::pcf);

  gnomon::PlanOptions options;  // every default is right for most scenes
  gnomon::render::set_margin(gnomon::render::default_settings(gnomon::render::filters::pcf), options);
  fs::create_directories(folder);

  for (int frame = 0; frame < kFrames; ++frame) {
    const gnomon::Camera camera = world.path.at((frame + 0.5) / kFrames, kWidth, kHeight);

    // 1. Plan: pure arithmetic, some 100 microseconds, no OpenGL and no heap.
    const gnomon::ShadowPlan plan = gnomon::make_plan(camera, world.light, world.boxes.bounds(), options);
    if (plan.status == gnomon::PlanStatus::invalid_input) {
      std::fprintf(stderr, "flythrough_sample: the plan refuses %s\n",
                   std::string(plan.invalid_field).c_str());
      return 2;
    }
    describe_plan(frame, plan);

    // 2. Draw: the maps, the surfaces, the shadow mask by the filter, and the lit picture.
    const gnomon::render::FrameStats stats = renderer.draw(plan, camera, filter, {});
    const std::string name = "frame_" + std::to_string(frame);
    gnomon::write_png(renderer.image(), folder / (name + "_image.png"));
    gnomon::write_png(renderer.heat_map(), folder / (name + "_heat.png"));

    // 3. Measure: what the maps are worth at every pixel, and what they cost.
    const SeenError m = seen_error(renderer.aliasing());
    std::printf(
        "  m: median %.2f, 95 %% below %.2f, %.1f %% of the pixels undersampled; %d maps, %.2f million "
        "texels\n",
        m.median, m.p95, 100.0 * m.share_undersampled, stats.map_count,
        static_cast<double>(stats.texels) * 1e-6);
  }
  std::printf("pictures: %s\n", folder.string().c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--help") {
    std::puts("usage: flythrough_sample [SCENE] [FOLDER]");
    return 0;
  }
  try {
    return fly(argc > 1 ? argv[1] : "builtin:city", argc > 2 ? argv[2] : "out/flythrough_sample");
  } catch (const std::exception& error) {  // files and drivers; planning throws nothing
    std::fprintf(stderr, "flythrough_sample: %s\n", error.what());
    return 2;
  }
}
