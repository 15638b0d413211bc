// States of tiles as a small image, and lists that indirect dispatches read: the CPU never waits for them.
#include "filter/filter_tiles.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "gl/program.hpp"

namespace gnomon::render {
namespace {

// Bindings, locations and sizes as shaders/pass/store/tiles.glsl states them.
constexpr GLuint kStates = 0, kListsBinding = 3, kCountBinding = 4;
constexpr GLint kLayerLocation = 0, kSizeLocation = 1, kKeepLocation = 1;
constexpr int kRowsOfTile = 4;  ///< strips of 8 texels, a quarter of a tile high
constexpr int kGroup = 64;      ///< local_size_x of keep_tiles.comp and list_tiles.comp

/// TileLists before its entries.
struct ListHeader {
  std::array<std::uint32_t, 8> groups{};  ///< two indirect dispatches of x, y, z, 0
  std::array<std::uint32_t, 4> entries{};
};

GLuint groups_for(int items) noexcept {
  return static_cast<GLuint>((items + kGroup - 1) / kGroup);
}

}  // namespace

void FilterTiles::make_programs() {
  if (programs_.keep) return;
  programs_.keep = make_compute_program("pass/store/keep_tiles.comp");
  programs_.list = make_compute_program("pass/store/list_tiles.comp");
  count_ = make_buffer();
  constexpr std::uint32_t kNone = 0;
  glNamedBufferStorage(count_.name(), sizeof kNone, &kNone, GL_DYNAMIC_STORAGE_BIT);
}

void FilterTiles::fit(int width, int height, int layers) {
  make_programs();
  const auto tiles = [](int side) { return std::max((side + kTileSide - 1) / kTileSide, 1); };
  if (tiles(width) == width_ && tiles(height) == height_ && layers == layers_) return;
  width_ = tiles(width);
  height_ = tiles(height);
  layers_ = layers;
  states_ = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(states_.name(), 1, GL_R8UI, width_, height_, layers_);
  constexpr std::uint8_t kStale = 0;
  glClearTexImage(states_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, &kStale);
  // A tile, then its strips.
  const auto of_layer = static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
  const std::uint64_t list_bytes = sizeof(ListHeader) + of_layer * (1 + kRowsOfTile) * sizeof(std::uint32_t);
  lists_ = make_buffer();
  glNamedBufferStorage(lists_.name(), static_cast<GLsizeiptr>(list_bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  bytes_ = of_layer * static_cast<std::uint64_t>(layers_) + list_bytes;
}

void FilterTiles::keep(GLint layer, const Keep& what) {
  glBindImageTexture(kStates, states_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R8UI);
  glUseProgram(programs_.keep.name());
  glUniform1i(kLayerLocation, layer);
  glUniform2i(kKeepLocation, what.holds ? 1 : 0, what.all ? 1 : 0);
  glDispatchCompute(groups_for(width_ * height_), 1, 1);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void FilterTiles::bind_for_marks() const noexcept {
  glBindImageTexture(kStates, states_.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R8UI);
}

void FilterTiles::bind_for_reads() const noexcept {
  glBindImageTexture(kStates, states_.name(), 0, GL_TRUE, 0, GL_READ_ONLY, GL_R8UI);
}

void FilterTiles::list(GLint layer, glm::ivec2 size, int reach) {
  ListHeader header;
  for (std::size_t i = 0; i < 2; ++i) header.groups[4 * i + 1] = header.groups[4 * i + 2] = 1;
  glNamedBufferSubData(lists_.name(), 0, sizeof header, &header);
  bind_for_reads();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kListsBinding, lists_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCountBinding, count_.name());
  glUseProgram(programs_.list.name());
  glUniform1i(kLayerLocation, layer);
  glUniform3i(kSizeLocation, size.x, size.y, reach);
  glDispatchCompute(groups_for(width_ * height_ * kRowsOfTile), 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, lists_.name());
}

void FilterTiles::dispatch(List which) const noexcept {
  constexpr GLintptr kBytesOfDispatch = 16;
  glDispatchComputeIndirect(kBytesOfDispatch * static_cast<GLintptr>(which));
}

std::uint64_t FilterTiles::take_count() {
  if (!count_) return 0;
  std::uint32_t count = 0;
  constexpr std::uint32_t kNone = 0;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(count_.name(), 0, sizeof count, &count);
  glNamedBufferSubData(count_.name(), 0, sizeof kNone, &kNone);
  return count;
}

}  // namespace gnomon::render
