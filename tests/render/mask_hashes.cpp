// Prints the hashes of what is drawn over all filters, sources and options, a line for each:
//   mask_hashes [--keep FILE | --against FILE] [TEXT]
// TEXT: the lines whose name holds it alone. Two builds on one driver print the same lines where no change
// was meant.
// --keep writes the masks into a file; --against prints, as rows of JSON, how many pixels differ from it.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/motion.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/page_filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/study/bias.hpp"
#include "mask_file.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kSize = 96;
const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.5, -1.0, -0.3));

/// FNV-1a.
std::uint64_t hash_of(std::span<const std::byte> bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 1099511628211ull;
  return hash;
}
std::uint64_t hash_of(const FloatImage& image) {
  return hash_of(std::as_bytes(std::span(image.values)));
}
std::uint64_t hash_of(const Image& image) {
  return hash_of(std::as_bytes(std::span(image.rgba)));
}

Scene opaque_scene() {
  Scene scene = boxes_on_ground();
  // A leaf whose edge its texture cuts out.
  Material leaf;
  leaf.alpha_mode = AlphaMode::mask;
  leaf.double_sided = true;
  leaf.base_color = {0.3f, 0.8f, 0.2f, 1.0f};
  leaf.base_color_image = 0;
  Image round{"round", 16, 16, {}};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool inside = (2 * x - 15) * (2 * x - 15) + (2 * y - 15) * (2 * y - 15) < 180;
      for (const int channel : {255, 255, 255, inside ? 255 : 0})
        round.rgba.push_back(static_cast<std::uint8_t>(channel));
    }
  }
  scene.images.push_back(std::move(round));
  add_quad(scene, {2.0f, 1.5f, -1.0f}, {1.5f, 0.3f, 0.0f}, {0.0f, 0.2f, 2.0f}, add_material(scene, leaf));
  return scene;
}

Scene pane_scene() {
  Scene scene = empty_scene();
  Material glass;
  glass.base_color = {0.9f, 0.2f, 0.1f, 1.0f};
  glass.transmission = 0.8f;
  add_quad(scene, {-3.0f, 3.0f, 3.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, add_material(scene, glass));
  Material smoke;
  smoke.alpha_mode = AlphaMode::blend;
  smoke.base_color = {1.0f, 1.0f, 1.0f, 0.4f};
  add_quad(scene, {-1.0f, 3.7f, 3.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, add_material(scene, smoke));
  return scene;
}

/// What is drawn, and with which words it is printed.
class Hashes {
 public:
  explicit Hashes(std::string text) : text_(std::move(text)) {}
  void keep_in(const std::string& file) { writer_.emplace(file); }
  void compare_with(const std::string& file) { reference_ = read_masks(file); }
  void all() {
    of_maps();
    of_shapes();
    of_options();
    of_motion();
    of_panes();
    of_pages();
    of_lights();
    of_lists();
  }

 private:
  [[nodiscard]] bool wanted(const std::string& name) const { return name.find(text_) != std::string::npos; }

  void print(const std::string& name, const Renderer& renderer) {
    if (writer_) writer_->add(name, kept(renderer.mask()));
    if (!reference_.empty()) {
      check_context();
      const auto found = reference_.find(name);
      if (found != reference_.end()) print_difference(name, kept(renderer.mask()), found->second);
      return;
    }
    std::printf("%s mask %016llx picture %016llx\n", name.c_str(),
                static_cast<unsigned long long>(hash_of(renderer.mask())),
                static_cast<unsigned long long>(hash_of(renderer.image())));
  }

  static FrameOptions quiet() {
    FrameOptions options;
    options.time_passes = options.aliasing = options.heat_map = options.cascade_tint = false;
    return options;
  }

  [[nodiscard]] std::vector<Box> boxes() const { return boxes_of(scene_); }

  [[nodiscard]] ShadowPlan plan(const FilterSettings& filter, const Light& light,
                                PlanOptions options = {}) const {
    const std::vector<Box> boxes = this->boxes();
    options.resolution.max_size = 256;
    options.split.overlap = 0.2;
    set_margin(filter, options);
    return make_plan(camera_, light, {boxes, boxes}, options);
  }

  void of_maps() {
    for (const Filter* filter : all_filters()) {
      const FilterSettings settings = default_settings(*filter);
      for (const auto& [word, light] : lights_) {
        const std::string name = "maps " + std::string(filter->info.name) + " " + word;
        if (!wanted(name)) continue;
        FrameOptions options = quiet();
        options.light = std::holds_alternative<DirectionalLight>(light) ? nullptr : &light;
        renderer_.draw(plan(settings, light), camera_, renderer_.prepare(settings), options);
        print(name, renderer_);
      }
    }
    for (const char* text :
         {"pcf:kernel=5,contacts=1", "vsm:blur=2,mipmap=1", "esm:format=fp16", "pcf:radius=3,contacts=1",
          "msm:format=unorm16", "evsm4:mipmap=1,anisotropy=4"}) {
      const std::string name = "maps " + std::string(text);
      const ParsedFilter parsed = parse_filter(text);
      if (!wanted(name) || !parsed.error.empty()) continue;
      renderer_.draw(plan(parsed.settings, kSunLight), camera_, renderer_.prepare(parsed.settings), quiet());
      print(name, renderer_);
    }
  }

  void of_shapes() {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 400; ++i) points.emplace_back(-4.0 + 0.02 * i, 0.0, 3.0 * std::sin(0.1 * i));
    for (const Shape* shape : all_shapes()) {
      for (const char* text : {"hard", "pcf", "vsm", "pcss", "revectorized"}) {
        for (const auto& [word, light] : lights_) {
          const std::string name = "shapes " + std::string(shape->name) + " " + text + " " + word;
          if (!wanted(name)) continue;
          const FilterSettings settings = parse_filter(text).settings;
          PlanOptions options;
          options.cascades = 1;
          options.warp.shape = shape;
          options.resolution.max_size = 256;
          set_margin(settings, options);
          const std::vector<Box> boxes = this->boxes();
          const ShadowPlan plan =
              make_plan({.camera = camera_, .points_world = points}, light, {boxes, boxes}, options);
          renderer_.draw(plan, camera_, renderer_.prepare(settings), quiet());
          print(name, renderer_);
        }
      }
    }
  }

  void of_options() {
    for (const char* text : {"hard", "pcf", "vsm", "silhouette"}) {
      const FilterSettings settings = parse_filter(text).settings;
      const auto draw = [&](const std::string& what, const FrameOptions& options, const Light& light,
                            const PlanOptions& of_plan = {}) {
        const std::string name = "options " + std::string(text) + " " + what;
        if (!wanted(name)) return;
        renderer_.draw(plan(settings, light, of_plan), camera_, renderer_.prepare(settings), options);
        print(name, renderer_);
      };
      for (const auto& [word, light] : lights_) {
        for (const DepthLayerInfo& layer : depth_layers()) {
          for (const bool linear : {false, true}) {
            FrameOptions options = quiet();
            options.depth_layer = layer.layer;
            options.linear_depth = linear;
            draw("layer " + std::string(layer.name) + (linear ? " linear " : " ") + word, options, light);
          }
        }
        FrameOptions options = quiet();
        options.linear_depth = true;
        draw("linear " + word, options, light);
        options = quiet();
        options.receiver_plane = false;
        draw("no plane " + word, options, light);
        options = quiet();
        options.map_passes = MapPasses::layered;
        draw("layered " + word, options, light);
        options = quiet();
        options.prune = kPruneNothing;
        draw("whole " + word, options, light);
        options = quiet();
        options.prune = PruneRules::all();
        draw("pruned " + word, options, light);
      }
      for (const SplitTransition transition : {SplitTransition::blend, SplitTransition::dither}) {
        for (const SampleNoise noise : {SampleNoise::still, SampleNoise::gradient, SampleNoise::blue}) {
          FrameOptions options = quiet();
          options.transition = transition;
          options.noise = noise;
          options.frame_index = 3;
          draw("transition " + std::to_string(static_cast<int>(transition)) + " noise " +
                   std::to_string(static_cast<int>(noise)),
               options, kSunLight);
        }
      }
      PlanOptions stable;
      stable.fit = Fit::stable;
      draw("stable", quiet(), kSunLight, stable);
      const std::string name = "options " + std::string(text) + " pictures";
      if (!wanted(name)) continue;
      FrameOptions options;
      options.time_passes = false;
      renderer_.draw(plan(settings, kSunLight), camera_, renderer_.prepare(settings), options);
      std::printf("%s aliasing %016llx heat %016llx tint %016llx\n", name.c_str(),
                  static_cast<unsigned long long>(hash_of(renderer_.aliasing())),
                  static_cast<unsigned long long>(hash_of(renderer_.heat_map())),
                  static_cast<unsigned long long>(hash_of(renderer_.cascade_tint())));
    }
  }

  /// Frames that follow each other: cached maps, scrolled ones, accumulated masks, casters that move.
  void of_motion() {
    for (const char* text : {"hard", "pcf", "vsm", "silhouette"}) {
      for (const bool accumulated : {false, true}) {
        const std::string name = "motion " + std::string(text) + (accumulated ? " accumulated" : "");
        if (!wanted(name)) continue;
        const FilterSettings settings = parse_filter(text).settings;
        Renderer renderer(scene_);
        const PreparedFilter filter = renderer.prepare(settings);
        Scene moving = scene_;
        for (int frame = 0; frame < 6; ++frame) {
          FrameOptions options = quiet();
          options.accumulation.on = accumulated;
          options.frame_index = static_cast<std::uint32_t>(frame);
          options.prune = PruneRules::all();
          Instance& box = moving.instances[1];
          if (frame > 2) {
            box.world_from_object[3].x += 0.2;
            box.bounds_world.min.x += 0.2;
            box.bounds_world.max.x += 0.2;
            renderer.move_instance(1, box);
          }
          PlanOptions of_plan;
          of_plan.fit = Fit::stable;
          of_plan.resolution.max_size = 256;
          set_margin(settings, of_plan);
          const std::vector<Box> boxes = boxes_of(moving);
          const Camera camera = going(frame);
          renderer.draw(make_plan(camera, kSunLight, {boxes, boxes}, of_plan), camera, filter, options);
          print(name + " frame " + std::to_string(frame), renderer);
        }
      }
    }
  }

  void of_panes() {
    Renderer renderer(scene_);
    renderer.add_panes(pane_scene());
    for (const char* text : {"hard", "pcf", "vsm"}) {
      for (const auto& [word, light] : lights_) {
        const std::string name = "panes " + std::string(text) + " " + word;
        if (!wanted(name)) continue;
        const FilterSettings settings = parse_filter(text).settings;
        FrameOptions options = quiet();
        options.accumulation.on = std::strcmp(text, "pcf") == 0;
        renderer.draw(plan(settings, light), camera_, renderer.prepare(settings), options);
        print(name, renderer);
        std::printf("%s transmittance %016llx\n", name.c_str(),
                    static_cast<unsigned long long>(hash_of(renderer.transmittance())));
      }
    }
    const FilterSettings hard = default_settings(filters::hard);
    if (wanted("panes irregular")) {
      renderer.draw(plan(hard, kSunLight), camera_, renderer.prepare(hard, Source::irregular()), quiet());
      print("panes irregular", renderer);
    }
    if (wanted("panes identifiers")) {
      renderer.draw(plan(hard, kSunLight), camera_, renderer.prepare(hard, Source::identifiers()), quiet());
      print("panes identifiers", renderer);
    }
    if (wanted("panes pages")) {
      draw_pages(renderer, "panes pages", hard, page_policies::resolution, quiet(), kSunLight);
      std::printf("panes pages transmittance %016llx\n",
                  static_cast<unsigned long long>(hash_of(renderer.transmittance())));
    }
    if (wanted("panes lights")) draw_lights(renderer, "panes lights", hard, quiet());
  }

  void draw_pages(Renderer& renderer, const std::string& name, const FilterSettings& filter,
                  const PagePolicy& policy, const FrameOptions& options, const Light& light) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 4096; ++i) points.emplace_back(-8.0 + 0.25 * (i % 64), 0.0, -8.0 + 0.25 * (i / 64));
    std::vector<std::byte> memory(page_memory(1024, 1 << 14));
    PageOptions pages;
    pages.policy = &policy;
    pages.capacity = 1024;
    pages.page_texels = 64;
    pages.target_m = 2.0;
    const FilterSettings settings = settings_for_pages(filter);
    set_margin(settings, pages.plan);
    const std::vector<Box> boxes = this->boxes();
    const PagePlan plan =
        plan_pages({.camera = camera_, .points_world = points}, light, {boxes, boxes}, pages, memory);
    renderer.draw(plan, camera_, renderer.prepare(settings, Source::pages), options);
    print(name, renderer);
    std::printf("%s pages %zu\n", name.c_str(), plan.pages.size());
  }

  void of_pages() {
    for (const Filter* filter : all_filters()) {
      const FilterSettings settings = settings_for_pages(default_settings(*filter));
      const std::string name = "pages " + std::string(filter->info.name);
      if (!wanted(name) || !page_filter_refusal(settings).empty()) continue;
      draw_pages(renderer_, name, settings, page_policies::resolution, quiet(), kSunLight);
    }
    const FilterSettings pcf = default_settings(filters::pcf);
    for (const PagePolicy* policy : all_page_policies()) {
      for (const auto& [word, light] : lights_) {
        const std::string name = "pages policy " + std::string(policy->name) + " " + word;
        if (wanted(name)) draw_pages(renderer_, name, pcf, *policy, quiet(), light);
      }
    }
    for (const DepthLayerInfo& layer : depth_layers()) {
      FrameOptions options = quiet();
      options.depth_layer = layer.layer;
      const std::string name = "pages layer " + std::string(layer.name);
      if (wanted(name)) draw_pages(renderer_, name, pcf, page_policies::resolution, options, kSunLight);
      options.map_passes = MapPasses::each;
      if (wanted(name))
        draw_pages(renderer_, name + " each", pcf, page_policies::resolution, options, kSunLight);
    }
  }

  void draw_lights(Renderer& renderer, const std::string& name, const FilterSettings& filter,
                   const FrameOptions& options) {
    const std::vector<LightRequest> requests{
        {kSunLight}, {SpotLight{{-4, 6, 4}, {0.6, -1, -0.5}, 0.6, 20.0}}, {PointLight{{3, 3, 2}, 9.0}}};
    std::vector<std::byte> memory(light_memory(requests.size(), 0));
    std::vector<LightState> states(requests.size());
    LightHistory history{states, 0, {}};
    LightOptions pool;
    pool.pool_width = 1024;
    pool.pool_height = 512;
    pool.most_size = 256;
    set_margin(filter, pool.plan);
    const std::vector<Box> boxes = this->boxes();
    const LightPlan plan = plan_lights(camera_, requests, {boxes, boxes}, pool, memory, &history);
    std::vector<ShadowPlan> own(requests.size());
    std::vector<DrawnLight> drawn;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const Light& light = requests[i].light;
      own[i] = make_plan(plan.lights[i].frames > 1 ? camera_round(light, camera_) : camera_, light,
                         {boxes, boxes}, light_options(pool, plan.lights[i]));
      drawn.push_back({light, &own[i], glm::vec3(0.5f + 0.1f * static_cast<float>(i))});
    }
    renderer.draw({plan, drawn}, camera_, renderer.prepare(filter, Source::lights), options);
    print(name, renderer);
    std::printf("%s sum %016llx\n", name.c_str(),
                static_cast<unsigned long long>(hash_of(renderer.light_sum())));
  }

  void of_lights() {
    for (const Filter* filter : all_filters()) {
      const FilterSettings settings = settings_for_pages(default_settings(*filter));
      const std::string name = "lights " + std::string(filter->info.name);
      if (!wanted(name)) continue;
      try {
        draw_lights(renderer_, name, settings, quiet());
      } catch (const RenderError& refused) {
        std::printf("%s: %s\n", name.c_str(), refused.what());
      }
    }
    FrameOptions options = quiet();
    options.light_clusters.tile_pixels = 0;
    if (wanted("lights each")) draw_lights(renderer_, "lights each", default_settings(filters::pcf), options);
    options = quiet();
    options.depth_layer = DepthLayer::midpoint;
    if (wanted("lights midpoint"))
      draw_lights(renderer_, "lights midpoint", default_settings(filters::pcf), options);
  }

  void of_lists() {
    const FilterSettings hard = default_settings(filters::hard);
    for (const auto& [word, light] : lights_) {
      for (const int samples : {1, 4}) {
        const std::string name = "irregular " + std::to_string(samples) + " " + word;
        if (!wanted(name)) continue;
        renderer_.draw(plan(hard, light), camera_, renderer_.prepare(hard, Source::irregular(samples)),
                       quiet());
        print(name, renderer_);
      }
      for (const IdentifierOf of : {IdentifierOf::instance, IdentifierOf::triangle}) {
        for (const int neighbours : {0, 1}) {
          const std::string name = "identifiers " + std::to_string(static_cast<int>(of)) + " " +
                                   std::to_string(neighbours) + " " + word;
          if (!wanted(name)) continue;
          renderer_.draw(plan(hard, light), camera_,
                         renderer_.prepare(hard, Source::identifiers({of, neighbours})), quiet());
          print(name, renderer_);
        }
      }
    }
  }

  const Light kSunLight = DirectionalLight{kSun};
  const std::vector<std::pair<std::string, Light>> lights_{
      {"sun", kSunLight},
      {"spot", SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0}},
      {"point", PointLight{{-4.0, 6.0, 3.0}, 60.0}}};
  std::string text_;
  std::optional<MaskWriter> writer_;
  std::map<std::string, KeptMask> reference_;
  Scene scene_ = opaque_scene();
  Camera camera_ = camera_on_box(kSize, kSize);
  Renderer renderer_{scene_};
};

}  // namespace
}  // namespace gnomon::render

int main(int argc, char** argv) {
  using namespace gnomon::render;
  try {
    const auto context = create_context(ContextKind::automatic);
    const bool file =
        argc > 2 && (std::strcmp(argv[1], "--keep") == 0 || std::strcmp(argv[1], "--against") == 0);
    const int text = file ? 3 : 1;
    Hashes hashes(argc > text ? argv[text] : "");
    if (file) std::strcmp(argv[1], "--keep") == 0 ? hashes.keep_in(argv[2]) : hashes.compare_with(argv[2]);
    hashes.all();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mask_hashes: %s\n", error.what());
    return 2;
  }
  return 0;
}
