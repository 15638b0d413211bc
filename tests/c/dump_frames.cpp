// Writes what C returns for frames, atlases, clusters and pictures, with the input, as the bytes of C
// structs: what bindings compare their own results with.
//   c_dump_frames FILE
// In this order, n being a number of 32 bits before its list:
//   camera, sun, plan options, n boxes that cast and receive, n maps of their plan
//   n frames: number of the frame (64 bits), offset, and the maps moved by it
//   n points, n frames: direction of the sun, the held one (gnomon_held_sun)
//   frames_per_bin, hold_frames, n frames: n depths, those to plan with (gnomon_visible_depths)
//   n atlases: width, height, the atlas, the matrix of each of its maps
//   n biases: map, way (gnomon_engine_bias of a kernel of 1.5 texels and 24 bits)
//   n lights, n lists: room (64 bits), tile, columns, rows, slices, scale and offset of depths, n begins, n
//   entries n pixels, their mask, their depths, the wrong ones (gnomon_wrong_pixels), n points of edges
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <random>

#include "in_c.hpp"

namespace {

using namespace gnomon;
using namespace gnomon::test;

constexpr int kWidth = 96, kHeight = 64;

class File {
 public:
  explicit File(const char* path) : file_(path, std::ios::binary) {}
  template <typename T>
  void one(const T& value) {
    file_.write(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void list(const T* first, std::size_t count) {
    one(static_cast<std::uint32_t>(count));
    file_.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(T)));
  }
  template <typename T>
  void list(const std::vector<T>& values) {
    list(values.data(), values.size());
  }
  [[nodiscard]] bool closed() {
    file_.close();
    return bool{file_};
  }

 private:
  std::ofstream file_;
};

struct Street {
  std::vector<Box> boxes{{{-40, -1, -200}, {40, 0, 20}}};
  Camera camera =
      perspective_camera({0, 3, 10}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 250.0, kWidth, kHeight);
  DirectionalLight sun{{0.4, -1, 0.3}};
  PlanOptions options;

  Street() {
    for (int i = 0; i < 40; ++i) {
      const double x = i % 2 == 0 ? -12.0 : 8.0, z = -5.0 * i;
      boxes.push_back({{x, 0, z - 3}, {x + 4, 2.0 + i % 7, z}});
    }
    options.fit = Fit::stable;
    options.resolution.texel_budget = 1 << 20;
  }
};

void write_plans(File& file, const InputInC& in, PlanInC& found) {
  gnomon_make_plan(&in.view, &in.light, &in.scene, &in.options, nullptr, &found.plan, nullptr);
  file.list(found.maps, static_cast<std::size_t>(found.plan.map_count));
  const std::uint32_t frames[] = {0, 1, 17, 63, 1000000};
  file.one(static_cast<std::uint32_t>(std::size(frames)));
  for (const std::uint32_t frame : frames) {
    PlanInC moved;
    gnomon_make_plan(&in.view, &in.light, &in.scene, &in.options, nullptr, &moved.plan, nullptr);
    double offset[2];
    gnomon_jitter_texels(frame, offset);
    gnomon_jitter(&moved.plan, offset, nullptr);
    file.one(std::int64_t{frame});
    file.one(offset);
    for (int i = 0; i < moved.plan.map_count; ++i) file.one(moved.maps[i]);
  }
}

void write_suns(File& file, const InputInC& in) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 100; ++i) points.push_back({-8.0 + 0.5 * (i % 31), 0.0, -0.5 * i});
  file.list(points);
  gnomon_view view = in.view;
  view.points = &points[0].x;
  view.point_count = static_cast<int64_t>(points.size());
  const double casters[6] = {-40, -1, -200, 40, 8, 20};
  double held[3] = {0, 0, 0};
  constexpr std::uint32_t kFrames = 50;
  file.one(kFrames);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const double sun[3] = {0.4 + 2e-3 * frame, -1.0, 0.3};
    gnomon_held_sun now;
    gnomon_hold_sun(&view, held, sun, casters, 0.25, 0.05, &now, nullptr);
    file.one(sun);
    file.one(now);
    std::copy(std::begin(now.direction), std::end(now.direction), held);
  }
}

void write_depths(File& file, std::mt19937_64& random) {
  gnomon_depth_tracker* const tracker = gnomon_depth_tracker_create(4, 5);
  file.one(std::int32_t{4});
  file.one(std::int32_t{5});
  constexpr std::uint32_t kFrames = 60;
  file.one(kFrames);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    std::vector<float> depths(random() % 4);
    for (float& depth : depths) depth = 0.5f + 0.01f * static_cast<float>(random() % 10000);
    gnomon_visible_depths now;
    gnomon_visible_depths_clear(&now);
    gnomon_visible_depths_add(&now, depths.data(), static_cast<int64_t>(depths.size()), nullptr);
    gnomon_depth_tracker_update(tracker, &now, &now, nullptr);
    file.list(depths);
    file.one(now);
  }
  gnomon_depth_tracker_destroy(tracker);
}

void write_atlases(File& file, const PlanInC& found) {
  const std::int32_t sizes[][2] = {{0, 0}, {4096, 2048}, {8, 8}};
  file.one(static_cast<std::uint32_t>(std::size(sizes)));
  for (const auto& size : sizes) {
    gnomon_atlas atlas;
    gnomon_pack_atlas(&found.plan, size[0], size[1], &atlas, nullptr);
    file.one(size);
    file.one(atlas);
    for (int map = 0; map < atlas.count; ++map) {
      double matrix[16];
      gnomon_atlas_from_clip(&atlas, &found.plan.clip_space, map, matrix, nullptr);
      file.one(matrix);
    }
  }
}

void write_biases(File& file, const PlanInC& found) {
  file.one(static_cast<std::uint32_t>(2 * found.plan.map_count));
  for (std::int32_t map = 0; map < found.plan.map_count; ++map) {
    for (const std::int32_t way : {GNOMON_BIAS_RASTERIZER, GNOMON_BIAS_NORMAL_OFFSET}) {
      gnomon_engine_bias bias;
      gnomon_translate_bias(&found.plan, map, way, 1.5, 24, &bias, nullptr);
      file.one(map);
      file.one(way);
      file.one(bias);
    }
  }
}

void write_clusters(File& file, const gnomon_camera& camera, std::mt19937_64& random) {
  const auto number = [&](double low, double high) {
    return low + (high - low) * 1e-4 * static_cast<double>(random() % 10000);
  };
  std::vector<gnomon_light> lights;
  for (int i = 0; i < 120; ++i) {
    const glm::dvec3 place(number(-30, 30), number(0, 6), number(-120, 5));
    if (i % 16 == 0)
      lights.push_back(in_c(Light(DirectionalLight{{0.4, -1, 0.3}})));
    else if (i % 2 == 0)
      lights.push_back(in_c(Light(SpotLight{place, {number(-1, 1), -1.0, 0.1}, 0.5, number(1, 20)})));
    else
      lights.push_back(in_c(Light(PointLight{place, number(1, 20)})));
  }
  file.list(lights);
  const std::int64_t rooms[] = {100000, 120};
  file.one(static_cast<std::uint32_t>(std::size(rooms)));
  for (const std::int64_t room : rooms) {
    const ClustersInC clusters(camera, lights, room);
    const gnomon_light_clusters& found = clusters.found;
    file.one(room);
    for (const std::int32_t value : {found.tile_pixels, found.columns, found.rows, found.slices})
      file.one(value);
    file.one(found.depth_scale);
    file.one(found.depth_offset);
    file.list(clusters.begin.data(), static_cast<std::size_t>(found.columns * found.rows * found.slices) + 1);
    file.list(clusters.list.data(), static_cast<std::size_t>(found.light_count));
  }
}

/// A roof of slats, `scene`: the way of the light, unit. Bindings have the same in their language.
double slats(const void* scene, const double point[3]) {
  const auto* way = static_cast<const double*>(scene);
  const double up = (6.0 - point[1]) / -way[1];
  const double at = point[0] - way[0] * up + 0.4 * (point[2] - way[2] * up);
  return at - 8.0 * std::floor(at / 8.0) < 3.0 ? -std::numeric_limits<double>::infinity() : up;
}

void write_picture(File& file, const Street& street, const gnomon_camera& camera_in_c, const PlanInC& found) {
  const Camera& camera = street.camera;
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 way = glm::normalize(street.sun.direction);
  std::vector<float> mask, depths, distances, normals;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double right = camera.left + (camera.right - camera.left) * (i % kWidth + 0.5) / kWidth,
                 up = camera.top + (camera.bottom - camera.top) * (i / kWidth + 0.5) / kHeight;
    const glm::dvec3 ray = axes.forward + axes.right * right + axes.up * up;
    const double depth = ray.y < 0.0 ? -camera.position.y / ray.y : 0.0;
    const glm::dvec3 at = camera.position + ray * depth;
    depths.push_back(static_cast<float>(depth));
    mask.push_back(slats(&way.x, &at.x) < 0.0 ? 1.0f : 0.0f);
    // Not those of the ground, which the depths show.
    for (const float part : {0.0f, i % 3 == 0 ? 0.0f : 0.8f, i % 3 == 0 ? 0.0f : 0.6f})
      normals.push_back(part);
    distances.push_back(static_cast<float>(i % 9) * 0.125f);
  }
  gnomon_shadow_picture picture;
  gnomon_shadow_picture_default(&picture, sizeof picture);
  picture.camera = &camera_in_c;
  picture.mask = mask.data();
  picture.view_depths = depths.data();
  picture.pixel_count = kWidth * kHeight;
  gnomon_wrong_pixels wrong, averaged, biased, searched, facing;
  gnomon_expected_error(&found.plan, &picture, &wrong, nullptr);
  picture.kernel_texels = 1.5;
  gnomon_expected_error(&found.plan, &picture, &averaged, nullptr);
  picture.occluder_distances = distances.data();
  gnomon_expected_error(&found.plan, &picture, &biased, nullptr);
  picture.occluder_search = slats;
  picture.occluder_scene = &way.x;
  gnomon_expected_error(&found.plan, &picture, &searched, nullptr);
  picture.kernel_texels = 0.0;
  picture.normals = normals.data();
  gnomon_expected_error(&found.plan, &picture, &facing, nullptr);
  std::vector<double> edges(3 * 200);
  int64_t written = 0;
  gnomon_shadow_edge_points(&picture, edges.data(), 200, &written, nullptr);
  file.list(mask);
  for (const float depth : depths) file.one(depth);
  for (const float distance : distances) file.one(distance);
  file.one(wrong);
  file.one(averaged);
  file.one(biased);
  for (int i = 0; i < 3; ++i) file.one(way[i]);
  for (const float part : normals) file.one(part);
  file.one(searched);
  file.one(facing);
  file.one(static_cast<std::uint32_t>(written));
  for (std::size_t i = 0; i < static_cast<std::size_t>(3 * written); ++i) file.one(edges[i]);
  std::printf("%.1f of %.0f pixels wrong, %.0f by a search, %d points of edges\n", wrong.wrong, wrong.counted,
              facing.wrong, static_cast<int>(written));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: c_dump_frames FILE\n");
    return 2;
  }
  const Street street;
  const InputInC in(street.camera, street.sun, street.boxes, street.boxes, street.options);
  PlanInC found;
  std::mt19937_64 random(5);
  File file(argv[1]);
  file.one(in.camera);
  file.one(in.light);
  file.one(in.options);
  file.list(street.boxes);
  write_plans(file, in, found);
  write_suns(file, in);
  write_depths(file, random);
  write_atlases(file, found);
  write_biases(file, found);
  write_clusters(file, in.camera, random);
  write_picture(file, street, in.camera, found);
  if (!file.closed()) {
    std::fprintf(stderr, "%s: could not be written\n", argv[1]);
    return 1;
  }
}
