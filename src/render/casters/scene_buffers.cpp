// Uploads a scene: vertices, images, and instances sorted so that few changes of state draw them all.
#include "casters/scene_buffers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/weighted_median.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {
namespace {

constexpr GLuint kPosition = 0, kNormal = 1, kTexcoord = 2, kObjectIndex = 3;  // as in the vertex shaders
constexpr GLuint kObjectsBinding = 0;

GLint gl_wrap(TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::mirrored_repeat:
      return GL_MIRRORED_REPEAT;
    case TextureWrap::clamp_to_edge:
      return GL_CLAMP_TO_EDGE;
    case TextureWrap::repeat:
      break;
  }
  return GL_REPEAT;
}

Texture upload(const Image& image) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (image.width > limit || image.height > limit) {
    throw RenderError("image '" + image.name + "' is " + std::to_string(image.width) + "x" +
                      std::to_string(image.height) + ", the driver takes " + std::to_string(limit));
  }
  Texture texture = make_texture(GL_TEXTURE_2D);
  const auto largest = static_cast<unsigned>(std::max(image.width, image.height));
  glTextureStorage2D(texture.name(), std::bit_width(largest), GL_SRGB8_ALPHA8, image.width, image.height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                      image.rgba.data());
  glGenerateTextureMipmap(texture.name());
  return texture;
}

/// Diagonal of the box round all boxes, at most eight times the radius that holds half of their surface: an
/// object that was left at the origin of a scene far from it does not count.
double extent_of(std::span<const Box> boxes) {
  constexpr double kMost = 8.0;
  Box all;
  std::vector<const Box*> filled;
  for (const Box& box : boxes) {
    if (box.empty()) continue;
    all.extend(box);
    filled.push_back(&box);
  }
  if (filled.empty()) return 0.0;
  const auto median = [&filled](const auto& value) {
    std::vector<std::pair<double, double>> weighted;
    for (const Box* box : filled) {
      const glm::dvec3 side = box->max - box->min;
      weighted.emplace_back(value(*box), side.x * side.y + side.y * side.z + side.z * side.x);
    }
    return weighted_median(std::move(weighted));
  };
  glm::dvec3 middle;
  for (int axis = 0; axis < 3; ++axis)
    middle[axis] =
        median([axis](const Box& box) { return box.min[axis] + 0.5 * (box.max[axis] - box.min[axis]); });
  const double radius = median([&middle](const Box& box) {
    return glm::length(glm::max(glm::abs(box.min - middle), glm::abs(box.max - middle)));
  });
  const double diagonal = glm::length(all.max - all.min);
  return radius > 0.0 ? std::min(diagonal, kMost * radius) : diagonal;
}

}  // namespace

SceneBuffers::SceneBuffers(const Scene& scene)
    : primitives_(scene.primitives),
      clusters_(scene),
      materials_(scene.materials),
      mirrored_(scene.instances.size()),
      vertex_count_(scene.positions.size()),
      translation_(scene.instances.size()),
      objects_(scene.instances.size()),
      order_(scene.instances.size()) {
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    primitive_of_.push_back(instance.primitive);
    boxes_.emplace_back();
    mirrored_[i] = instance.mirrored;
    casts_.push_back(instance.casts);
    receives_.push_back(instance.receives);
    shown_.push_back(instance.shown);
    move(i, instance);
  }
  upload_vertices(scene);
  upload_images(scene);
  make_batches();
  for (Placement& placement : placement_) placement.buffer = filled_buffer(objects_);
  extent_ = extent_of(boxes_);
  constexpr int kStepsPerExtent = 2;  // as a power of two
  if (extent_ > 0.0 && std::isfinite(extent_))
    origin_step_ = std::ldexp(1.0, std::ilogb(extent_) - kStepsPerExtent);
}

void SceneBuffers::move(std::size_t instance, const Instance& to) {
  ++changes_;
  boxes_[instance] = to.bounds_world;
  const glm::dmat4& m = to.world_from_object;
  translation_[instance] = glm::dvec3(m[3]);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) objects_[instance].row[r].value[c] = static_cast<float>(m[c][r]);
  }
  for (Placement& placement : placement_) placement.origin_world.reset();
  if (mirrored_[instance] == to.mirrored) return;
  mirrored_[instance] = to.mirrored;
  make_batches();
}

glm::dmat4 SceneBuffers::world_from_object(std::uint32_t instance) const noexcept {
  glm::dmat4 m(1.0);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[c][r] = static_cast<double>(objects_[instance].row[r].value[c]);
  }
  m[3] = glm::dvec4(translation_[instance], 1.0);
  return m;
}

void SceneBuffers::bend(std::uint32_t first, std::span<const glm::vec3> positions,
                        std::span<const glm::vec3> normals) {
  const auto replace = [first](const Buffer& buffer, std::span<const glm::vec3> values) {
    glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(first * sizeof(glm::vec3)),
                         static_cast<GLsizeiptr>(values.size_bytes()), values.data());
  };
  ++changes_;
  clusters_.forget(first, positions.size());
  replace(positions_, positions);
  replace(normals_, normals);
}

void SceneBuffers::upload_vertices(const Scene& scene) {
  positions_ = filled_buffer(scene.positions);
  normals_ = filled_buffer(scene.normals);
  texcoords_ = filled_buffer(scene.texcoords);
  std::vector<std::uint32_t> indices = scene.indices;
  indices.insert(indices.end(), clusters_.sorted_indices().begin(), clusters_.sorted_indices().end());
  indices_ = filled_buffer(indices);
  vertex_array_ = make_vertex_array();
  const GLuint vao = vertex_array_.name();
  glVertexArrayElementBuffer(vao, indices_.name());
  const std::array<std::tuple<GLuint, GLuint, int>, 3> attributes{
      {{kPosition, positions_.name(), 3}, {kNormal, normals_.name(), 3}, {kTexcoord, texcoords_.name(), 2}}};
  for (const auto& [location, buffer, size] : attributes) {
    glVertexArrayVertexBuffer(vao, location, buffer, 0, size * static_cast<GLsizei>(sizeof(float)));
    glVertexArrayAttribFormat(vao, location, size, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(vao, location, location);
    glEnableVertexArrayAttrib(vao, location);
  }
  glVertexArrayAttribIFormat(vao, kObjectIndex, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(vao, kObjectIndex, kObjectIndex);
  glVertexArrayBindingDivisor(vao, kObjectIndex, 1);
  glEnableVertexArrayAttrib(vao, kObjectIndex);
}

void SceneBuffers::set_object_index_buffer(GLuint buffer) const noexcept {
  glVertexArrayVertexBuffer(vertex_array_.name(), kObjectIndex, buffer, 0, sizeof(std::uint32_t));
}

std::vector<glm::vec3> SceneBuffers::read_positions() const {
  return read_positions(0, vertex_count_);
}

std::vector<glm::vec3> SceneBuffers::read_positions(std::uint32_t first, std::size_t count) const {
  std::vector<glm::vec3> positions(count);
  glGetNamedBufferSubData(positions_.name(), static_cast<GLintptr>(first * sizeof(glm::vec3)),
                          static_cast<GLsizeiptr>(count * sizeof(glm::vec3)), positions.data());
  return positions;
}

std::vector<std::uint32_t> SceneBuffers::read_indices(const IndexRun& run) const {
  std::vector<std::uint32_t> indices(run.index_count);
  glGetNamedBufferSubData(indices_.name(), static_cast<GLintptr>(run.first_index * sizeof(std::uint32_t)),
                          static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data());
  return indices;
}

std::vector<std::uint32_t> SceneBuffers::read_indices(const Primitive& primitive) const {
  return read_indices(IndexRun{primitive.first_index, primitive.index_count});
}

std::vector<std::uint32_t> SceneBuffers::read_near_indices(std::uint32_t primitive) const {
  return read_indices(clusters_.whole(primitive));
}

void SceneBuffers::upload_images(const Scene& scene) {
  textures_.reserve(scene.images.size());
  for (const Image& image : scene.images) {
    textures_.push_back(image.width > 0 && image.height > 0 ? upload(image) : Texture{});
  }
  white_ = upload(Image{"white", 1, 1, {255, 255, 255, 255}});
  samplers_.resize(9);
}

GLuint SceneBuffers::sampler_for(const Material& material) {
  Sampler& sampler =
      samplers_[static_cast<std::size_t>(material.wrap_u) * 3 + static_cast<std::size_t>(material.wrap_v)];
  if (!sampler) {
    sampler = make_sampler();
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_S, gl_wrap(material.wrap_u));
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_T, gl_wrap(material.wrap_v));
  }
  return sampler.name();
}

void SceneBuffers::make_batches() {
  batches_.clear();
  const auto key = [this](std::uint32_t i) {
    const int index = primitive_of(i).material;
    const Material& material = materials_[static_cast<std::size_t>(index)];
    return std::tuple(material.alpha_mode != AlphaMode::opaque, index, static_cast<bool>(mirrored_[i]),
                      !receives_[i], primitive_of_[i], i);
  };
  std::iota(order_.begin(), order_.end(), 0u);
  std::sort(order_.begin(), order_.end(),
            [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

  for (std::uint32_t n = 0; n < order_.size(); ++n) {
    const bool mirrored = mirrored_[order_[n]], receives = receives_[order_[n]];
    const int index = primitive_of(order_[n]).material;
    const auto same_state = [&](std::uint32_t other) {
      return primitive_of(order_[other]).material == index && mirrored_[order_[other]] == mirrored &&
             receives_[order_[other]] == receives;
    };
    if (n > 0 && same_state(n - 1)) {
      batches_.back().end = n + 1;
      continue;
    }
    const Material& material = materials_[static_cast<std::size_t>(index)];
    Batch batch{.begin = n,
                .end = n + 1,
                .double_sided = material.double_sided,
                .mirrored = mirrored,
                .receives = receives,
                .base_color = material.base_color,
                .texture = white_.name(),
                .sampler = sampler_for(material),
                .wrap_u = material.wrap_u,
                .wrap_v = material.wrap_v};
    batch.alpha_mode = material.alpha_mode;
    batch.transmission = material.transmission;
    batch.masked = material.alpha_mode != AlphaMode::opaque;
    if (batch.masked) batch.alpha_cutoff = material.alpha_cutoff;
    if (material.base_color_image >= 0) {
      const Texture& texture = textures_[static_cast<std::size_t>(material.base_color_image)];
      if (texture) batch.texture = texture.name();
    }
    batches_.push_back(batch);
  }
}

void SceneBuffers::place(Placed placed, const glm::dvec3& origin_world) {
  Placement& placement = placement_[static_cast<std::size_t>(placed)];
  if (placement.origin_world == origin_world) return;
  placement.origin_world = origin_world;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const glm::dvec3 relative = translation_[i] - origin_world;
    for (int r = 0; r < 3; ++r) objects_[i].row[r].value[3] = static_cast<float>(relative[r]);
  }
  glNamedBufferSubData(placement.buffer.name(), 0, static_cast<GLsizeiptr>(objects_.size() * sizeof(Object)),
                       objects_.data());
}

void SceneBuffers::use(Placed placed) const noexcept {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kObjectsBinding,
                   placement_[static_cast<std::size_t>(placed)].buffer.name());
}

}  // namespace gnomon::render
