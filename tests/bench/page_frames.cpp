// Misclassified pixels of pages and of four cascades at equal texels, over the built-in scenes, against rays.
//
//     bench_page_frames [FOLDER [FILTER...]]   FOLDER: for pictures of masks, and of pages by level; - for
//     none.
//                                              FILTER: as `gnomon compare --filters` takes them; default hard
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/render/context.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "guarded.hpp"
#include "median.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

constexpr int kWidth = 480, kHeight = 270;

/// One frame of a scene with what is seen in it and what is true of it.
struct Frame {
  Scene scene;
  std::vector<Box> boxes;
  Light light;
  Camera camera;
  render::Renderer renderer;
  std::vector<glm::dvec3> points, normals;
  std::vector<trace::Verdict> truth;

  Frame(const std::string& name, double t)
      : scene(load_builtin(name)), camera(default_path(scene).at(t, kWidth, kHeight)), renderer(scene) {
    for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
    Box whole;
    for (const Box& box : boxes) whole.extend(box);
    light = default_light({}, whole);
    const render::PreparedFilter hard = renderer.prepare(render::filters::hard);
    renderer.draw(ShadowPlan{}, camera, hard, quiet());
    const FloatImage at = renderer.positions(), facing = renderer.normals();
    const trace::Tracer tracer(scene);
    truth =
        trace::hard_reference(tracer, trace::surface_points(tracer, camera, light, at, facing), light).pixels;
    for (std::size_t i = 0; i < at.values.size(); i += 4) {
      if (!(facing.values[i + 3] > 0.0f)) continue;
      points.push_back(camera.position + glm::dvec3(at.values[i], at.values[i + 1], at.values[i + 2]));
      normals.emplace_back(facing.values[i], facing.values[i + 1], facing.values[i + 2]);
    }
  }
  [[nodiscard]] SceneBounds bounds() const { return {boxes, boxes}; }
  /// Share of the pixels that a ray decides, in percent.
  [[nodiscard]] double misclassified(const FloatImage& mask) const {
    std::size_t wrong = 0, decided = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] != trace::Verdict::lit && truth[i] != trace::Verdict::shadow) continue;
      ++decided;
      wrong += (mask.values[2 * i] > 0.5f) != (truth[i] == trace::Verdict::lit);
    }
    return 100.0 * static_cast<double>(wrong) / static_cast<double>(decided);
  }
};

void save(const std::filesystem::path& file, const Image& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// The mask in grey, tinted by the level of the page where there are pages.
Image picture(const FloatImage& mask, const PagePlan* plan) {
  Image image{"mask", mask.width, mask.height, {}};
  for (std::size_t i = 0; i < mask.values.size(); i += 2) {
    const float lit = 0.25f + 0.75f * mask.values[i];
    render::Color tint{255, 255, 255};
    const int page = static_cast<int>(mask.values[i + 1]);
    if (plan != nullptr && page >= 0)
      tint = render::cascade_color(static_cast<int>(plan->pages[static_cast<std::size_t>(page)].level));
    for (const std::uint8_t channel : {tint.r, tint.g, tint.b})
      image.rgba.push_back(static_cast<std::uint8_t>(lit * static_cast<float>(channel)));
    image.rgba.push_back(255);
  }
  return image;
}

/// Milliseconds of maps, prefilter and look-up: all drawn, and with what is kept from the last frame.
struct Times {
  double all = 0.0, prefilter = 0.0, kept = 0.0;
};

/// Draws some frames and times the middle one of each kind; the mask is that of the last.
template <class Draw>
std::pair<Times, render::FrameStats> timed(Draw&& draw) {
  std::vector<double> all, prefilter, kept;
  render::FrameStats drawn;
  render::FrameOptions options = quiet();
  for (int frame = 0; frame < 8; ++frame) {
    const bool keeps = frame > 4;
    options.prune = keeps ? default_prune_rules() : default_prune_rules().without(PruneRule::held_maps);
    const render::FrameStats stats = draw(options);
    if (frame < 2) continue;  // shaders are compiled by first use
    (keeps ? kept : all).push_back(stats.shadow_ms());
    if (keeps) continue;
    prefilter.push_back(stats.ms(render::Pass::prefilter));
    drawn = stats;
  }
  return {{median(all), median(prefilter), median(kept)}, drawn};
}

void print(const std::string& scene, const std::string& filter, const char* technique,
           const std::pair<Times, render::FrameStats>& drawn, double wrong) {
  std::printf("%-8s %-12s %-22s %9.2f %10.3f %9.1f %9.1f %9.1f\n", scene.c_str(), filter.c_str(), technique,
              static_cast<double>(drawn.second.texels) / (kWidth * kHeight), wrong, drawn.first.all,
              drawn.first.prefilter, drawn.first.kept);
  std::fflush(stdout);
}

/// Four cascades of this size, and pages of as many texels.
void compare(Frame& frame, const std::string& name, int map_size, std::span<std::byte> memory,
             const std::string& folder, const render::FilterSettings& filter) {
  PlanOptions options;
  options.resolution.max_size = map_size;
  render::set_margin(filter, options);
  const std::string stem = folder + "/" + name + "_" + std::to_string(map_size) + "_";
  std::int64_t budget = std::int64_t{4} * map_size * map_size;
  for (const bool points : {false, true}) {
    View seen = frame.camera;
    if (points) seen.points_world = frame.points;
    const ShadowPlan plan = make_plan(seen, frame.light, frame.bounds(), options);
    const auto stats = timed([&](const render::FrameOptions& frame_options) {
      return frame.renderer.draw(plan, frame.camera, frame.renderer.prepare(filter), frame_options);
    });
    const FloatImage mask = frame.renderer.mask();
    print(name, render::to_string(filter), points ? "four cascades, points" : "four cascades", stats,
          frame.misclassified(mask));
    if (!folder.empty() && points) save(stem + "cascades.png", picture(mask, nullptr));
  }
  for (const bool normals : {false, true}) {
    PageOptions pages;
    pages.page_texels = 64;
    pages.target_m = 0.05;
    const int slot = pages.page_texels + 2 * static_cast<int>(std::ceil(options.filter.texels));
    pages.capacity = static_cast<int>(budget / (slot * slot));
    pages.plan = options;
    View seen{.camera = frame.camera, .points_world = frame.points};
    if (normals) seen.normals_world = frame.normals;
    const PagePlan plan = plan_pages(seen, frame.light, frame.bounds(), pages, memory);
    if (plan.status != PlanStatus::ok) {
      std::printf("%s: no pages: %s\n", name.c_str(), std::string(plan.invalid_field).c_str());
      continue;
    }
    const auto stats = timed([&](const render::FrameOptions& frame_options) {
      return frame.renderer.draw(plan, frame.camera, frame.renderer.prepare(filter, render::Source::pages),
                                 frame_options);
    });
    const FloatImage mask = frame.renderer.mask();
    print(name, render::to_string(filter), normals ? "pages, normals" : "pages", stats,
          frame.misclassified(mask));
    if (folder.empty()) continue;
    save(stem + (normals ? "pages_normals.png" : "pages.png"), picture(mask, nullptr));
    save(stem + (normals ? "levels_normals.png" : "levels.png"), picture(mask, &plan));
  }
}

int run_all(int argc, char** argv) {
  const std::string folder = argc > 1 && std::string(argv[1]) != "-" ? argv[1] : "";
  if (!folder.empty()) std::filesystem::create_directories(folder);
  std::vector<render::FilterSettings> filters;
  for (int i = 2; i < argc; ++i) {
    const render::ParsedFilter parsed = render::parse_filter(argv[i]);
    if (!parsed.error.empty()) {
      std::fprintf(stderr, "%s\n", parsed.error.c_str());
      return 2;
    }
    filters.push_back(parsed.settings);
  }
  if (filters.empty()) filters.push_back(render::default_settings(render::filters::hard));
  const auto context = render::create_context();
  std::printf("%-8s %-12s %-22s %9s %10s %9s %9s %9s\n", "scene", "filter", "technique", "texels/px",
              "wrong, %", "ms", "prefilter", "kept, ms");
  std::vector<std::byte> memory(page_memory(1 << 14, std::size_t{kWidth} * kHeight));
  for (const BuiltinScene& scene : builtin_scenes()) {
    const std::string name(scene.name);
    Frame frame(name, 0.5);
    for (const int map_size : {512, 1024})
      for (const render::FilterSettings& filter : filters)
        compare(frame, name, map_size, memory, folder, filter);
  }
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_page_frames", gnomon::run_all, argc, argv);
}
