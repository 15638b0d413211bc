// The last frame's images, from the GPU to plain memory. OpenGL's rows run bottom to top, pictures' top to
// bottom.
#include <algorithm>
#include <cmath>

#include "frame/renderer_impl.hpp"
#include "gnomon/render/context.hpp"

namespace gnomon::render {
namespace {

template <class T>
void flip_rows(std::vector<T>& values, std::size_t row, int height) {
  for (int y = 0; y < height / 2; ++y) {
    const auto top = values.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y));
    const auto bottom =
        values.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(height - 1 - y));
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
  }
}

Image read_color(const Texture& texture, int width, int height, const char* name) {
  Image image{name, width, height, {}};
  const auto row = static_cast<std::size_t>(width) * 4;
  image.rgba.resize(row * static_cast<std::size_t>(height));
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(image.rgba.size()),
                    image.rgba.data());
  check_context();  // after the copy, which waits for the drawing
  flip_rows(image.rgba, row, height);
  return image;
}

FloatImage read_floats(const Texture& texture, int width, int height, GLenum format,
                       std::vector<std::string> channel_names) {
  FloatImage image{width, height, static_cast<int>(channel_names.size()), {}, std::move(channel_names)};
  const auto row = static_cast<std::size_t>(width) * image.channel_names.size();
  image.values.resize(row * static_cast<std::size_t>(height));
  glGetTextureImage(texture.name(), 0, format, GL_FLOAT,
                    static_cast<GLsizei>(image.values.size() * sizeof(float)), image.values.data());
  check_context();
  flip_rows(image.values, row, height);
  return image;
}

/// As in shaders/pass/common/octahedral.glsl.
glm::vec3 unit_from_octahedral(float x, float y) {
  glm::vec3 n{x, y, 1.0f - std::abs(x) - std::abs(y)};
  if (n.z < 0.0f) {
    n.x = (1.0f - std::abs(y)) * (x >= 0.0f ? 1.0f : -1.0f);
    n.y = (1.0f - std::abs(x)) * (y >= 0.0f ? 1.0f : -1.0f);
  }
  return n / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
}

}  // namespace

Image Renderer::image() const {
  const FrameTargets& t = impl_->screen.targets;
  return read_color(t.color, t.width, t.height, "image");
}
Image Renderer::heat_map() const {
  const FrameTargets& t = impl_->screen.targets;
  return read_color(t.heat, t.width, t.height, "heat_map");
}
Image Renderer::cascade_tint() const {
  const FrameTargets& t = impl_->screen.targets;
  return read_color(t.tint, t.width, t.height, "cascade_tint");
}
FloatImage Renderer::mask() const {
  const FrameTargets& t = impl_->screen.targets;
  return read_floats(t.mask, t.width, t.height, GL_RG, {"visibility", "map"});
}
FloatImage Renderer::light_sum() const {
  const std::optional<PoolSource>& lights = impl_->sources.lights;
  if (!lights || lights->sum().width == 0) throw RenderError("no frame of many lights yet");
  const LightSum& sum = lights->sum();
  return read_floats(sum.image, sum.width, sum.height, GL_RGB, {"r", "g", "b"});
}
FloatImage Renderer::transmittance() const {
  if (!impl_->panes || !impl_->panes->image()) throw RenderError("no frame with panes yet");
  const FrameTargets& t = impl_->screen.targets;
  return read_floats(impl_->panes->image(), t.width, t.height, GL_RGB, {"r", "g", "b"});
}
FloatImage Renderer::aliasing() const {
  const FrameTargets& t = impl_->screen.targets;
  return read_floats(t.aliasing, t.width, t.height, GL_RGBA, {"m_max", "m_s", "m_t", "map"});
}
FloatImage Renderer::positions() const {
  const FrameTargets& t = impl_->screen.targets;
  return read_floats(t.position, t.width, t.height, GL_RGBA, {"x", "y", "z", "depth"});
}

FloatImage Renderer::normals() const {
  const FrameTargets& t = impl_->screen.targets;
  FloatImage image = read_floats(t.normal, t.width, t.height, GL_RGBA, {"x", "y", "z", "surface"});
  const Image albedo = read_color(t.albedo, t.width, t.height, "albedo");
  for (std::size_t i = 0; i < image.values.size(); i += 4) {
    const glm::vec3 n = unit_from_octahedral(image.values[i], image.values[i + 1]);
    image.values[i] = n.x;
    image.values[i + 1] = n.y;
    image.values[i + 2] = n.z;
    image.values[i + 3] = albedo.rgba[i + 3] > 0 ? 1.0f : 0.0f;
  }
  return image;
}

Image Renderer::screen() const {
  const auto [width, height] = impl_->screen_size;
  Image image{"screen", width, height, {}};
  image.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  check_context();
  flip_rows(image.rgba, static_cast<std::size_t>(width) * 4, height);
  return image;
}

FloatImage Renderer::depth_map(int map) const {
  const MapSource& maps = impl_->sources.maps;
  if (map < 0 || map >= maps.map_count())
    throw RenderError("no map " + std::to_string(map) + " in the last frame");
  const glm::ivec2 size = maps.size(map);
  FloatImage image{size.x, size.y, 1, {}, {"depth"}};
  image.values.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  maps.read_depths(map, image.values);
  check_context();
  return image;
}

FloatImage Renderer::page_depths(std::size_t page) const {
  const PagePool& pool = impl_->sources.pages.pool();
  if (page >= pool.resident()) throw RenderError("no page " + std::to_string(page) + " in the last frame");
  const DrawnPage at = pool.place_of(page);
  FloatImage image{at.place.width, at.place.height, 1, {}, {"depth"}};
  image.values.resize(static_cast<std::size_t>(at.place.width) * static_cast<std::size_t>(at.place.height));
  glGetTextureSubImage(impl_->depths.depth.name(), 0, at.place.x, at.place.y, at.layer, at.place.width,
                       at.place.height, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                       static_cast<GLsizei>(image.values.size() * sizeof(float)), image.values.data());
  check_context();
  return image;
}

bool Renderer::drew_page(std::size_t page) const noexcept {
  return impl_->sources.pages.pool().drew(page);
}

std::vector<DrawnDepths> Renderer::drawn_depths(const FilterSettings& settings,
                                                const ShadowPlan& plan) const {
  std::vector<DrawnDepths> maps;
  const BlurSides sides = blur_sides(settings, plan);
  for (int i = 0; i < std::min(plan.map_count, impl_->sources.maps.map_count()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const ShadowMap& map = plan.map[at];
    const double curve = impl_->sources.maps.linear() ? 0.0 : depth_curve(plan, map);
    std::vector<float> depths = depth_map(i).values;
    if (curve > 0.0)
      for (float& depth : depths) depth = static_cast<float>(linear_depth(depth, curve));
    const BiasWorld& bias = map.bias_world;
    maps.push_back({std::move(depths), map.width, map.height, std::max(sides[at], 0.5),
                    map_depths(settings, map), (bias.constant + bias.slope) / map.depth_range_world});
  }
  return maps;
}

std::vector<std::uint32_t> Renderer::list_lengths() const {
  const std::optional<ListSource>& lists = impl_->sources.lists;
  if (!lists) return {};
  std::vector<std::uint32_t> lengths = lists->lists().lengths();
  check_context();
  return lengths;
}

}  // namespace gnomon::render
