// How good are gnomon's maps in a Vulkan engine, beside the cascades that engines ship? A walk down a street
// at equal texels, by one shader with one translated bias, against exact rays.
//   vulkan_sample [PICTURE.png] [--no-validation] [--matrices FILE.json]
// FILE.json gets the matrices of the first frame's maps, a line for each row of the table.
// Ends with 1 where validation speaks, matrices on the device differ from the plan's, one pass over all maps
// draws other shadows than a pass a map, or gnomon's maps have more misclassified pixels than the ordinary
// ones.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>

#include "ordinary.hpp"
#include "view.hpp"

namespace {

using namespace sample;

constexpr int kWidth = 640, kHeight = 360, kTexels = 512, kMaps = 4, kFrames = 6;

struct Way {
  const char* name;
  bool gnomon;
  std::function<gnomon::ShadowPlan(const gnomon::Camera&)> plan;
  Wrong wrong;
  std::vector<double> m_p95, microseconds;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

double microseconds_of(const std::function<void()>& work) {
  std::vector<double> each;
  for (int i = 0; i < 31; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    each.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  return median(each);
}

/// Faults that end the program with 1.
struct Faults {
  int unlike = 0, maps = 0;                 // maps on the device that differ from the plan's, of how many
  std::int64_t layered = 0, multiview = 0;  // pixels that one pass over all maps draws otherwise
};

std::vector<Way> ways(const Street& street, const gnomon::PlanOptions& options) {
  const gnomon::DirectionalLight sun{street.sun};
  const gnomon::SceneBounds bounds{street.boxes, street.boxes};
  gnomon::PlanOptions stable = options;
  stable.fit = gnomon::Fit::stable;
  const auto ordinary = [&street, sun, bounds, stable](double lambda) {
    return [&street, sun, bounds, stable, lambda](const gnomon::Camera& camera) {
      // gnomon's plan gives the light, the origin and the selection; its matrices are replaced.
      const OrdinaryCascades own =
          ordinary_cascades(camera, street.sun, street.boxes, kTexels, lambda, stable.clip_space);
      return plan_of(gnomon::make_plan(camera, sun, bounds, stable), camera, own.clip_from_world, own.ends,
                     kTexels, stable.bias);
    };
  };
  const auto own = [sun, bounds](const gnomon::PlanOptions& of) {
    return [sun, bounds, of](const gnomon::Camera& camera) {
      return gnomon::make_plan(camera, sun, bounds, of);
    };
  };
  return {{"spheres, practical splits 0.5", false, ordinary(0.5), {}, {}, {}},
          {"spheres, practical splits 0.9", false, ordinary(0.9), {}, {}, {}},
          {"gnomon, Fit::stable", true, own(stable), {}, {}, {}},
          {"gnomon, default", true, own(options), {}, {}, {}}};
}

/// A line of JSON: the matrices that draw the plan's maps, column by column, with all of their bits.
std::string matrices_line(const gnomon::ShadowPlan& plan) {
  std::string line;
  for (const gnomon::ShadowMap& map : plan.maps()) {
    line += line.empty() ? "[[" : "], [";
    for (int i = 0; i < 16; ++i) {
      std::array<char, 24> number{};
      std::snprintf(number.data(), number.size(), "%s%.9g", i == 0 ? "" : ", ",
                    static_cast<double>(map.clip_from_camera_relative[i / 4][i % 4]));
      line += number.data();
    }
  }
  return line + "]]\n";
}

/// Files to write, or null.
struct Files {
  const char* picture = nullptr;
  const char* matrices = nullptr;
};

Faults draw_walk(Device& device, const Street& street, const gnomon::PlanOptions& options,
                 std::vector<Way>& all, const Files& files) {
  std::vector<Vertex> vertices;
  for (const gnomon::Box& box : street.boxes) append_box(box, vertices);
  const Buffer buffer =
      device.make_buffer(vertices.size() * sizeof(Vertex), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, true);
  std::memcpy(buffer.mapped, vertices.data(), buffer.bytes);
  Shadows shadows(device, kTexels, kMaps, buffer.handle);
  View view(device, kWidth, kHeight, buffer.handle, static_cast<std::uint32_t>(vertices.size()), shadows);

  Faults faults;
  std::string matrices;
  for (int frame = 0; frame < kFrames; ++frame) {
    const gnomon::Camera camera = street.camera(frame, kWidth, kHeight);
    const ExactPicture exact = exact_picture(street, camera);
    std::vector<Drawn> pictures;
    for (Way& way : all) {
      const gnomon::ShadowPlan plan = way.plan(camera);
      if (plan.map_count > kMaps || plan.map_count == 0)
        throw VulkanError("a plan of other maps than this scene has");
      const auto draw = [&](Shadows::Passes passes) {
        device.run([&](VkCommandBuffer commands) {
          shadows.record(commands, view.bound(), plan, options.bias, street.boxes, passes);
          view.record(commands, camera);
        });
        return view.read();
      };
      // RenderDoc begins and ends a capture at these labels, in programs that present no frames, too.
      if (frame == 0) device.label("capture-marker,begin_capture");
      const Drawn drawn = draw(Shadows::Passes::one_per_map);
      if (frame == 0) device.label("capture-marker,end_capture");
      if (frame == 0) matrices += matrices_line(plan);
      faults.maps += plan.map_count;
      faults.unlike += shadows.holds(plan) ? 0 : plan.map_count;
      for (const auto& [passes, unlike] : {std::pair{Shadows::Passes::layered, &faults.layered},
                                           std::pair{Shadows::Passes::multiview, &faults.multiview}}) {
        if (!shadows.has(passes)) continue;
        const Drawn at_once = draw(passes);
        for (std::size_t i = 0; i < drawn.lit.size(); ++i) *unlike += drawn.lit[i] != at_once.lit[i] ? 1 : 0;
      }
      count_wrong(exact, drawn.lit, way.wrong);
      way.m_p95.push_back(gnomon::measure(plan, camera, {street.boxes, street.boxes}).p95);
      pictures.push_back(drawn);
    }
    if (frame == 0 && files.picture != nullptr)
      write_pictures(files.picture, exact, std::array{pictures[0], pictures[3]});
  }
  if (files.matrices != nullptr && !(std::ofstream(files.matrices) << matrices << std::flush))
    throw VulkanError(std::string("cannot write ") + files.matrices);
  return faults;
}

void time_set_ups(const Street& street, std::vector<Way>& all) {
  const gnomon::Camera camera = street.camera(0, kWidth, kHeight);
  for (Way& way : all) {
    if (way.gnomon) {
      way.microseconds.push_back(microseconds_of([&] { (void)way.plan(camera); }));
    } else {
      way.microseconds.push_back(microseconds_of(
          [&] { (void)ordinary_cascades(camera, street.sun, street.boxes, kTexels, 0.5, kMapClipSpace); }));
    }
  }
}

int run(const Files& files, bool validated) {
  const Street street;
  gnomon::PlanOptions options;
  options.cascades = kMaps;
  options.resolution.max_size = kTexels;
  options.clip_space = kMapClipSpace;
  std::vector<Way> all = ways(street, options);
  Faults faults;
  int messages = 0;
  bool faulty_multiview = false;
  {
    Device device(validated);
    std::printf("%s%s\n%d frames of %d x %d pixels, %d maps of %d x %d texels, depths reversed\n\n",
                device.name().c_str(), validated ? "" : ", not validated", kFrames, kWidth, kHeight, kMaps,
                kTexels, kTexels);
    faults = draw_walk(device, street, options, all, files);
    messages = device.messages();
    if (messages > 0) std::fprintf(stderr, "validation: %s\n", device.first_message().c_str());
    // llvmpipe of Mesa 22.3 draws the inside of triangles of every view into the first layer.
    faulty_multiview = device.name().starts_with("llvmpipe");
    if (!device.layer_by_vertex()) std::puts("no layers by the vertex shader on this device");
    if (!device.multiview()) std::puts("no multiview on this device");
  }
  time_set_ups(street, all);
  std::printf("%-32s %13s %8s %10s\n", "", "misclassified", "m p95", "set-up, us");
  double best_ordinary = 100.0, worst_gnomon = 0.0;
  for (const Way& way : all) {
    std::printf("%-32s %11.3f %% %8.2f %10.1f\n", way.name, way.wrong.percent(), median(way.m_p95),
                median(way.microseconds));
    if (way.gnomon) {
      worst_gnomon = std::max(worst_gnomon, way.wrong.percent());
    } else {
      best_ordinary = std::min(best_ordinary, way.wrong.percent());
    }
  }
  std::printf("\nmaps whose matrices on the device differ from the plan's: %d of %d\n", faults.unlike,
              faults.maps);
  std::printf("pixels that one layered pass draws otherwise than a pass a map: %lld\n",
              static_cast<long long>(faults.layered));
  std::printf("pixels that multiview draws otherwise: %lld%s\n", static_cast<long long>(faults.multiview),
              faulty_multiview && faults.multiview > 0 ? " (a fault of this driver)" : "");
  std::printf("messages of validation: %d\n", messages);
  const bool good = faults.unlike == 0 && faults.layered == 0 &&
                    (faulty_multiview || faults.multiview == 0) && messages == 0 &&
                    worst_gnomon <= best_ordinary;
  if (!good) std::fputs("vulkan_sample: not as it should be, see above\n", stderr);
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Files files;
  bool validated = true;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--no-validation") == 0) {
      validated = false;
    } else if (std::strcmp(argv[i], "--matrices") == 0 && i + 1 < argc) {
      files.matrices = argv[++i];
    } else if (argv[i][0] == '-' || files.picture != nullptr) {
      std::fprintf(stderr, "usage: vulkan_sample [PICTURE.png] [--no-validation] [--matrices FILE.json]\n");
      return 2;
    } else {
      files.picture = argv[i];
    }
  }
  try {
    return run(files, validated);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vulkan_sample: %s\n", error.what());
    return 2;
  }
}
