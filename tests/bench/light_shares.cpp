// Which shares of a pool among many lights leave the fewest pixels misclassified, against exact rays?
//
//     bench_light_shares [LIGHTS [POOL [SCENE...]]]
//
// Without them 48 lights, a pool of 2048 texels to each side, and the built-in scenes. Each light's shadow is
// drawn alone, at the size that each way of sharing gives it, and counted: pixels that the light faces and
// whose shadow a ray decides. Lights are seeded; two views of each scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "guarded.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

constexpr int kWidth = 480, kHeight = 270, kPointStep = 8;
constexpr double kLastFrame = 0.002;  // of the flight
constexpr std::array<double, 2> kViews = {0.3, 0.7};

/// Point lights and spots of any width and range over the scene.
std::vector<LightRequest> place_lights(const Scene& scene, int count, std::uint64_t seed) {
  Random random(seed);
  const Box& box = scene.bounds_world;
  const glm::dvec3 size = box.max - box.min;
  const double spacing = std::sqrt(size.x * size.z / count);
  std::vector<LightRequest> lights;
  for (int i = 0; i < count; ++i) {
    const double height = random.between(0.1, 0.8) * std::min(spacing, size.y);
    const glm::dvec3 at{box.min.x + size.x * random.unit(), box.min.y + height,
                        box.min.z + size.z * random.unit()};
    if (i % 3 == 0) {
      const glm::dvec3 down{random.between(-0.5, 0.5), -1.0, random.between(-0.5, 0.5)};
      lights.push_back({SpotLight{at + glm::dvec3(0.0, 0.4 * spacing, 0.0), down, random.between(0.3, 0.9),
                                  random.between(1.5, 3.0) * spacing}});
    } else {
      lights.push_back({PointLight{at, random.between(0.6, 2.0) * spacing}});
    }
  }
  return lights;
}

/// Wrong pixels and all that count.
struct Counts {
  double wrong = 0.0, pixels = 0.0;
  void add(const Counts& other) {
    wrong += other.wrong;
    pixels += other.pixels;
  }
  [[nodiscard]] double percent() const { return pixels > 0.0 ? 100.0 * wrong / pixels : 0.0; }
};

/// One frame: what is seen in it, and the shadow of each light at each size.
class Frame {
 public:
  Frame(render::Renderer& renderer, const trace::Tracer& tracer, const Scene& scene, const Camera& camera)
      : renderer_(renderer),
        tracer_(tracer),
        camera_(camera),
        hard_(renderer.prepare(render::filters::hard)) {
    for (const Instance& instance : scene.instances) boxes_.push_back(instance.bounds_world);
    renderer_.draw(ShadowPlan{}, camera_, hard_, quiet());
    positions_ = renderer_.positions();
    normals_ = renderer_.normals();
    for (int y = 0; y < kHeight; y += kPointStep) {
      for (int x = 0; x < kWidth; x += kPointStep) {
        const std::size_t i = 4 * (static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x));
        if (!(normals_.values[i + 3] > 0.0f)) continue;
        points.push_back(camera_.position + vector_at(positions_, i));
      }
    }
  }
  [[nodiscard]] SceneBounds bounds() const { return {boxes_, boxes_}; }
  [[nodiscard]] const Camera& camera() const { return camera_; }

  /// Misclassified pixels of a light at these maps.
  const Counts& counts(std::size_t index, const Light& light, const LightOptions& pool,
                       const LightMaps& maps) {
    const auto [at, is_new] = counts_.try_emplace({index, maps.size});
    if (!is_new) return at->second;
    const std::vector<trace::Verdict>& truth = truth_of(index, light);
    const std::vector<float> mask = drawn(light, pool, maps);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] != trace::Verdict::lit && truth[i] != trace::Verdict::shadow) continue;
      at->second.pixels += 1.0;
      at->second.wrong += (mask[2 * i] > 0.5f) != (truth[i] == trace::Verdict::lit) ? 1.0 : 0.0;
    }
    return at->second;
  }
  /// Share of the pixels that the light reaches whose right or lower neighbour has another shadow, as drawn.
  /// One pixel more stands for edges that the frame missed.
  double edge_share(const Light& light, const LightOptions& pool, const LightMaps& maps) {
    const std::vector<float> mask = drawn(light, pool, maps);
    const trace::SurfacePoints seen = trace::surface_points(tracer_, camera_, light, positions_, normals_);
    const auto faces = [&](std::size_t i) { return seen.pixels[i].state == trace::PixelState::facing; };
    double edges = 1.0, pixels = 1.0;
    for (std::size_t i = 0; i + kWidth < seen.pixels.size(); ++i) {
      if (!faces(i)) continue;
      pixels += 1.0;
      const std::size_t right = (i + 1) % kWidth > 0 ? i + 1 : i;
      for (const std::size_t next : {right, i + kWidth})
        edges += faces(next) && (mask[2 * i] > 0.5f) != (mask[2 * next] > 0.5f) ? 1.0 : 0.0;
    }
    return edges / pixels;
  }

  std::vector<glm::dvec3> points;  // of every kPointStep-th pixel and row

 private:
  static glm::dvec3 vector_at(const FloatImage& image, std::size_t i) {
    return {image.values[i], image.values[i + 1], image.values[i + 2]};
  }
  std::vector<float> drawn(const Light& light, const LightOptions& pool, const LightMaps& maps) {
    const ShadowPlan plan = make_plan(camera_, light, bounds(), light_options(pool, maps));
    renderer_.draw(plan, camera_, hard_, quiet());
    return renderer_.mask().values;
  }
  const std::vector<trace::Verdict>& truth_of(std::size_t index, const Light& light) {
    const auto [at, is_new] = truth_.try_emplace(index);
    if (is_new) {
      const trace::SurfacePoints seen = trace::surface_points(tracer_, camera_, light, positions_, normals_);
      at->second = trace::hard_reference(tracer_, seen, light).pixels;
    }
    return at->second;
  }

  render::Renderer& renderer_;
  const trace::Tracer& tracer_;
  Camera camera_;
  render::PreparedFilter hard_;
  std::vector<Box> boxes_;
  FloatImage positions_, normals_;
  std::map<std::pair<std::size_t, int>, Counts> counts_;
  std::map<std::size_t, std::vector<trace::Verdict>> truth_;
};

/// A plan's sizes. They outlive its memory.
std::vector<LightMaps> plan(const View& view, const std::vector<LightRequest>& lights,
                            const SceneBounds& bounds, const LightOptions& pool) {
  std::vector<std::byte> memory(light_memory(lights.size(), view.points_world.size()));
  const LightPlan planned = plan_lights(view, lights, bounds, pool, memory);
  return {planned.lights.begin(), planned.lights.end()};
}

// known: by the pixels that each light has wrong at the sizes by points, which no plan can know.
constexpr std::array<const char*, 5> kWays = {"equal", "boxes", "points", "edges", "known"};

/// Sizes by each way, in the order of kWays.
std::array<std::vector<LightMaps>, kWays.size()> shares(Frame& frame, Frame& last,
                                                        const std::vector<LightRequest>& lights,
                                                        const LightOptions& pool) {
  const auto view = [](const Frame& of) { return View{.camera = of.camera(), .points_world = of.points}; };
  std::array<std::vector<LightMaps>, kWays.size()> sizes;
  sizes[1] = plan(frame.camera(), lights, frame.bounds(), pool);
  sizes[2] = plan(view(frame), lights, frame.bounds(), pool);
  // The last frame had sizes by points: its masks tell where edges are.
  std::vector<LightRequest> weighted = lights;
  const std::vector<LightMaps> before = plan(view(last), lights, last.bounds(), pool);
  double sum = 0.0;
  std::size_t known = 0;
  std::vector<double> edges(lights.size(), 0.0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].map_count == 0) continue;
    sum += edges[i] = last.edge_share(lights[i].light, pool, before[i]);
    ++known;
  }
  for (std::size_t i = 0; i < lights.size(); ++i)
    weighted[i].weight =
        edges[i] > 0.0 ? edges[i] : sum / static_cast<double>(std::max<std::size_t>(known, 1));
  sizes[3] = plan(view(frame), weighted, frame.bounds(), pool);
  for (std::size_t i = 0; i < sizes[2].size(); ++i) {
    const LightMaps& own = sizes[2][i];
    if (own.map_count == 0 || !(own.share * own.m > 0.0)) continue;
    weighted[i].weight = (frame.counts(i, lights[i].light, pool, own).wrong + 1.0) / (own.share * own.m);
  }
  sizes[4] = plan(view(frame), weighted, frame.bounds(), pool);
  // The largest power of two that all lights can have.
  sizes[0] = sizes[2];
  std::int64_t maps = 0;
  for (const LightMaps& own : sizes[0]) maps += own.map_count;
  int side = 16;
  while (maps * (2 * side) * (2 * side) <= std::int64_t{pool.pool_width} * pool.pool_height) side *= 2;
  for (LightMaps& own : sizes[0]) own.size = std::min(side, pool.most_size);
  return sizes;
}

int run_all(int argc, char** argv) {
  const int count = argc > 1 ? std::clamp(std::atoi(argv[1]), 1, 512) : 48;
  LightOptions pool;
  pool.pool_width = pool.pool_height = argc > 2 ? std::clamp(std::atoi(argv[2]) / 1024, 1, 16) * 1024 : 2048;
  pool.least_size = 32;
  pool.most_frames = 1;  // all plans follow the view: as many maps whatever the share
  std::vector<std::string> scenes(argv + std::min(argc, 3), argv + argc);
  if (scenes.empty())
    scenes = {"builtin:city", "builtin:fence", "builtin:hangar", "builtin:terrain", "builtin:trees"};
  const auto context = render::create_context(render::ContextKind::automatic);
  std::array<double, kWays.size()> logs{};
  int views = 0;
  std::printf("%d lights, pool of %d x %d: misclassified pixels, %%\n%-24s %6s", count, pool.pool_width,
              pool.pool_height, "scene, view", "lights");
  for (const char* way : kWays) std::printf(" %8s", way);
  std::printf("\n");
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const Scene scene = load_scene(scenes[s]);
    const trace::Tracer tracer(scene);
    render::Renderer renderer(scene);
    render::set_margin(render::default_settings(render::filters::hard), pool.plan);
    const CameraPath path = default_path(scene);
    for (const double t : kViews) {
      const std::vector<LightRequest> lights = place_lights(scene, count, 100 * s + (t < 0.5 ? 1 : 2));
      Frame last(renderer, tracer, scene, path.at(t - kLastFrame, kWidth, kHeight));
      Frame frame(renderer, tracer, scene, path.at(t, kWidth, kHeight));
      const auto sizes = shares(frame, last, lights, pool);
      std::array<Counts, kWays.size()> sums;
      int mapped = 0;
      for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool all = std::all_of(sizes.begin(), sizes.end(), [&](const auto& way) {
          return i < way.size() && way[i].map_count > 0 && way[i].size > 0;
        });
        if (!all) continue;
        ++mapped;
        for (std::size_t way = 0; way < kWays.size(); ++way)
          sums[way].add(frame.counts(i, lights[i].light, pool, sizes[way][i]));
      }
      std::printf("%-19s %4.2f %6d",
                  scenes[s].substr(std::max<std::size_t>(scenes[s].size(), 19) - 19).c_str(), t, mapped);
      for (const Counts& sum : sums) std::printf(" %8.3f", sum.percent());
      std::printf("\n");
      std::fflush(stdout);
      if (!(sums[2].wrong > 0.0)) continue;
      ++views;
      for (std::size_t way = 0; way < kWays.size(); ++way)
        logs[way] += std::log(std::max(sums[way].wrong, 0.5) / sums[2].wrong);
    }
  }
  std::printf("%-31s", "geometric mean over points");
  for (const double log : logs) std::printf(" %8.3f", std::exp(log / std::max(views, 1)));
  std::printf("\n");
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_light_shares", gnomon::run_all, argc, argv);
}
