// Images and camera of temporal accumulation.
#include "frame/mask_history.hpp"

#include <glm/geometric.hpp>

#include "frame/target.hpp"

namespace gnomon::render {
namespace {

constexpr GLuint kHistoryBinding = 2, kMaskUnit = 6, kHistoryUnit = 7;

struct HistoryBlock {
  glm::mat4 clip_before;
  glm::vec4 depth_before, settings;
  glm::uvec4 moved_count;
  std::array<glm::vec4, kMaxMovedBoxes> moved_min, moved_max;  // relative to the camera
};
static_assert(sizeof(HistoryBlock) == 64 + 3 * 16 + 2 * kMaxMovedBoxes * 16, "std140 has no padding here");

}  // namespace

void MaskHistory::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  valid_ = false;
  single_ = pixel_image(GL_RG32F, width, height);
  single_fbo_ = make_framebuffer();
  glNamedFramebufferTexture(single_fbo_.name(), GL_COLOR_ATTACHMENT0, single_.name(), 0);
  for (std::size_t i = 0; i < history_.size(); ++i) {
    history_[i] = pixel_image(GL_RGBA32F, width, height);
    fbo_[i] = make_framebuffer();
    glNamedFramebufferTexture(fbo_[i].name(), GL_COLOR_ATTACHMENT1, history_[i].name(), 0);
    constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(fbo_[i].name(), static_cast<GLsizei>(kBoth.size()), kBoth.data());
  }
  if (block_) return;
  block_ = make_buffer();
  glNamedBufferStorage(block_.name(), sizeof(HistoryBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void MaskHistory::forget_behind(std::span<const Box> moved_world) noexcept {
  for (const Box& box : moved_world) {
    if (box.empty()) continue;
    if (moved_count_ < kMaxMovedBoxes) {
      moved_[moved_count_++] = box;
    } else {
      moved_[kMaxMovedBoxes - 1].extend(box.min);
      moved_[kMaxMovedBoxes - 1].extend(box.max);
    }
  }
}

void MaskHistory::bind(const Camera& camera, const Accumulation& settings) noexcept {
  const glm::dvec3 shift = camera.position - eye_;  // from the eye before to this one
  HistoryBlock block{};
  glm::dmat4 clip = clip_from_relative_;
  clip[3] = clip_from_relative_ * glm::dvec4(shift, 1.0);
  block.clip_before = glm::mat4(clip);
  block.depth_before = glm::vec4(glm::dvec4(forward_, glm::dot(forward_, shift)));
  block.settings = glm::vec4(glm::dvec4(settings.confidence_power, settings.memory, settings.depth_tolerance,
                                        valid_ && !settings.restart ? 1.0 : 0.0));
  block.moved_count.x = static_cast<glm::uint>(moved_count_);
  for (std::size_t i = 0; i < moved_count_; ++i) {
    block.moved_min[i] = glm::vec4(glm::dvec4(moved_[i].min - camera.position, 0.0));
    block.moved_max[i] = glm::vec4(glm::dvec4(moved_[i].max - camera.position, 0.0));
  }
  glNamedBufferSubData(block_.name(), 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, kHistoryBinding, block_.name());
  glBindTextureUnit(kMaskUnit, single_.name());
  glBindTextureUnit(kHistoryUnit, history_[1 - current_].name());
}

GLuint MaskHistory::fbo_with(const Texture& mask) noexcept {
  glNamedFramebufferTexture(fbo_[current_].name(), GL_COLOR_ATTACHMENT0, mask.name(), 0);
  return fbo_[current_].name();
}

void MaskHistory::keep(const Camera& camera, const FrameBlock& frame) noexcept {
  clip_from_relative_ = glm::dmat4(frame.clip_from_camera_relative);
  eye_ = camera.position;
  forward_ = glm::dvec3(frame.forward);
  current_ = 1 - current_;
  moved_count_ = 0;
  valid_ = true;
}

}  // namespace gnomon::render
