// The lists' memory, and the frame across the light that pixels and casters meet in.
#include "source/pixel_lists.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <string>

#include "gl/program.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {
namespace {

// Bindings and locations as the shaders state them.
constexpr GLuint kListedBinding = 1, kFramesBinding = 3, kHeadsUnit = 4, kHeightUnit = 4, kHeadsImage = 0,
                 kMaskImage = 1;
constexpr GLint kSamplesLocation = 0;
constexpr std::uint64_t kPixelBytes = 16;
constexpr std::uint32_t kShadowed = 0x8000'0000u;

/// The axis of the narrowest cone from a local light that holds its map: the middle of two of the rays
/// through the map's corners, or of three. Their mean may be at more than a right angle to one of them where
/// a warp turns the map aside. `otherwise`: for a map without an inverse.
glm::dvec3 axis_of(const ShadowMap& map, const glm::dvec3& otherwise) noexcept {
  // Rays through the light stay rays: x, y and w vanish at it, and are linear in the way from it.
  const glm::dmat4& m = map.clip_from_world;
  const glm::dmat3 xyw_from_way(m[0][0], m[0][1], m[0][3], m[1][0], m[1][1], m[1][3], m[2][0], m[2][1],
                                m[2][3]);
  const glm::dmat3 way_from_xyw = glm::inverse(xyw_from_way);
  std::array<glm::dvec3, 4> ray;
  for (std::size_t i = 0; i < ray.size(); ++i)
    ray[i] = glm::normalize(way_from_xyw * glm::dvec3(i % 2 == 0 ? -1 : 1, i < 2 ? -1 : 1, 1));
  glm::dvec3 axis = otherwise;
  double widest = -2.0;  // cosine of the widest angle to a ray
  const auto take_if_narrower = [&](const glm::dvec3& along) {
    const glm::dvec3 unit = glm::normalize(along);
    double least = glm::dot(unit, ray[0]);  // no number stays none
    for (const glm::dvec3& r : ray) least = std::min(least, glm::dot(unit, r));
    if (!(least > widest)) return;
    axis = unit;
    widest = least;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 &a = ray[(i + 1) % 4], &b = ray[(i + 2) % 4], &c = ray[(i + 3) % 4];
    const glm::dvec3 round = glm::cross(b - a, c - a);
    take_if_narrower(round);
    take_if_narrower(-round);
    for (std::size_t k = 0; k < i; ++k) take_if_narrower(ray[i] + ray[k]);
  }
  return axis;
}

std::uint64_t entries_of(glm::ivec2 frame, int samples) noexcept {
  return static_cast<std::uint64_t>(frame.x) * static_cast<std::uint64_t>(frame.y) *
         static_cast<std::uint64_t>(samples);
}

}  // namespace

LightFrames light_frames(const ShadowPlan& plan, const Camera& camera, double scene_extent) noexcept {
  // Sixteen half units of the last place, as gnomon::trace::Tracer::error_world: points interpolated between
  // corners, and corners themselves, are rounded to a few. Of each point and triangle, not of the scene.
  constexpr double kRounding = 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon());
  LightFrames frames{};
  const bool local = plan.map_count > 0 && plan.map[0].light_world.w != 0.0;
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const ShadowMap& map = plan.map[i];
    const glm::dvec3 z = local ? axis_of(map, plan.light_direction) : glm::normalize(plan.light_direction);
    const glm::dvec3 a = glm::abs(z);
    const glm::dvec3 least = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                             : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                      : glm::dvec3(0, 0, 1);
    const glm::dvec3 x = glm::normalize(glm::cross(least, z)), y = glm::cross(z, x);
    const glm::dvec3 origin = local ? glm::dvec3(map.light_world) - camera.position : glm::dvec3(0.0);
    const std::array<glm::dvec3, 3> axes{x, y, z};
    for (std::size_t r = 0; r < 3; ++r)
      frames.row[3 * i + r] = glm::vec4(glm::dvec4(axes[r], -glm::dot(axes[r], origin)));
  }
  frames.light = glm::vec4(glm::dvec4(local ? 1.0 : 0.0, scene_extent, kRounding, 0.0));
  return frames;
}

PixelLists::PixelLists() {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
  GLint images = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_IMAGE_UNIFORMS, &images);
  if (blocks < 1 || images < 1) {
    throw RenderError(
        "irregular shadows need a storage buffer and an image in fragment shaders; this driver has " +
        std::to_string(blocks) + " and " + std::to_string(images));
  }
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  most_bytes_ = static_cast<std::uint64_t>(std::max<GLint64>(most, 0));
  surfaces_ = make_program("pass/gbuffer/gbuffer.vert", "pass/gbuffer/heights.geom",
                           {"pass/gbuffer/gbuffer.frag", {"extra/heights"}});
  list_ = make_compute_program("pass/lists/list.comp");
  mean_ = make_compute_program("pass/lists/mean.comp");
  opaque_ = make_program("pass/lists/caster.vert", "pass/lists/caster.geom",
                         {"pass/lists/test.frag", {"alpha/opaque"}});
  masked_ = make_program("pass/lists/caster.vert", "pass/lists/caster.geom",
                         {"pass/lists/test.frag", {"alpha/masked"}});
  glNamedBufferStorage(frames_.name(), sizeof(LightFrames), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

bool PixelLists::fits(int width, int height, int samples) const noexcept {
  const std::uint64_t entries = entries_of({width, height}, samples);
  return entries < kShadowed && entries * kPixelBytes <= most_bytes_;
}

void PixelLists::clear(glm::ivec2 frame, int samples, glm::ivec2 map, int maps) {
  if (frame != frame_ || samples != samples_ || !pixels_) {
    frame_ = frame;
    samples_ = samples;
    pixels_ = make_buffer();
    glNamedBufferStorage(pixels_.name(), static_cast<GLsizeiptr>(entries_of(frame, samples) * kPixelBytes),
                         nullptr, 0);
  }
  if (!heads_ || map != map_ || maps > layers_) {
    map_ = map;
    layers_ = std::max(maps, layers_);
    heads_ = make_texture(GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(heads_.name(), 1, GL_R32UI, map.x, map.y, layers_);
    glTextureParameteri(heads_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(heads_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glNamedFramebufferParameteri(fbo_.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, map.x);
    glNamedFramebufferParameteri(fbo_.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, map.y);
  }
  constexpr GLuint kNoPixel = 0;
  glClearTexImage(heads_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &kNoPixel);
}

void PixelLists::set_light(const LightFrames& frames) noexcept {
  glNamedBufferSubData(frames_.name(), 0, sizeof frames, &frames);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFramesBinding, frames_.name());
}

void PixelLists::list(GLuint heights, GLuint mask) noexcept {
  glBindTextureUnit(kHeightUnit, heights);
  glBindSampler(kHeightUnit, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kListedBinding, pixels_.name());
  glBindImageTexture(kHeadsImage, heads_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
  glBindImageTexture(kMaskImage, mask, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
  glUseProgram(list_.name());
  glUniform1i(kSamplesLocation, samples_);
  dispatch();
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void PixelLists::bind(GLuint mask) const noexcept {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kListedBinding, pixels_.name());
  glBindImageTexture(kMaskImage, mask, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32F);
  glBindTextureUnit(kHeadsUnit, heads_.name());
  glBindSampler(kHeadsUnit, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo_.name());
}

void PixelLists::dispatch() const noexcept {
  constexpr GLuint kSide = 8;
  glDispatchCompute((static_cast<GLuint>(frame_.x) + kSide - 1) / kSide,
                    (static_cast<GLuint>(frame_.y) + kSide - 1) / kSide, 1);
}

void PixelLists::average(GLuint mask) const noexcept {
  if (samples_ == 1) return;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kListedBinding, pixels_.name());
  glBindImageTexture(kMaskImage, mask, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RG32F);
  glUseProgram(mean_.name());
  glUniform1i(kSamplesLocation, samples_);
  dispatch();
}

std::uint64_t PixelLists::entries() const noexcept {
  return entries_of(frame_, samples_);
}

std::uint64_t PixelLists::bytes() const noexcept {
  constexpr std::uint64_t kHeadBytes = 4;
  return kPixelBytes * entries_of(frame_, samples_) + kHeadBytes * static_cast<std::uint64_t>(map_.x) *
                                                          static_cast<std::uint64_t>(map_.y) *
                                                          static_cast<std::uint64_t>(layers_);
}

std::vector<std::uint32_t> PixelLists::lengths() const {
  if (!heads_) return {};
  const auto texels =
      static_cast<std::size_t>(map_.x) * static_cast<std::size_t>(map_.y) * static_cast<std::size_t>(layers_);
  std::vector<std::uint32_t> heads(texels);
  glGetTextureImage(heads_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                    static_cast<GLsizei>(texels * sizeof(std::uint32_t)), heads.data());
  struct Entry {
    float at[3];
    std::uint32_t next;
  };
  static_assert(sizeof(Entry) == kPixelBytes, "std430");
  std::vector<Entry> pixels(static_cast<std::size_t>(entries_of(frame_, samples_)));
  glGetNamedBufferSubData(pixels_.name(), 0, static_cast<GLsizeiptr>(pixels.size() * sizeof(Entry)),
                          pixels.data());
  std::vector<std::uint32_t> lengths;
  for (const std::uint32_t head : heads) {
    std::uint32_t length = 0;
    for (std::uint32_t at = head; at != 0 && at <= pixels.size() && length < pixels.size(); ++length)
      at = pixels[at - 1].next & ~kShadowed;
    if (length > 0) lengths.push_back(length);
  }
  return lengths;
}

}  // namespace gnomon::render
