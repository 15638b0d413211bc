// The exact hard shadow of a picture, traced in the background row by row.
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/trace/reference.hpp"
#include "gnomon/trace/seen_shadow.hpp"

namespace gnomon::tool::view {

/// Equal for equal lights alone.
[[nodiscard]] std::string light_text(const Light& light);

class Truth {
 public:
  Truth() = default;
  ~Truth() { stop(); }
  Truth(const Truth&) = delete;
  Truth& operator=(const Truth&) = delete;

  /// True where rows of this picture are there or on their way.
  [[nodiscard]] bool is_of(const Camera& camera, const Light& light) const;
  /// Forgets the last picture, and begins with this one: `positions` and `normals` as the renderer has them.
  void begin(std::shared_ptr<const trace::Tracer> tracer, const Camera& camera, const Light& light,
             FloatImage positions, FloatImage normals);
  void stop();
  /// Waits for the last row.
  void finish();
  /// Pixels of the rows that are done, from the top.
  [[nodiscard]] std::span<const trace::Verdict> verdicts() const;
  [[nodiscard]] bool done() const;
  /// ShadowPicture::occluders of the picture that was begun.
  [[nodiscard]] OccluderSearch occluders() const { return occluders_.search(); }
  /// Changes with each row that is done.
  [[nodiscard]] int rows() const { return rows_; }

 private:
  std::string picture_;
  int width_ = 0, height_ = 0;
  std::vector<trace::Verdict> verdicts_;
  std::shared_ptr<const trace::Tracer> tracer_;
  trace::LightOccluders occluders_;
  std::atomic<int> rows_ = 0;
  std::jthread thread_;
};

}  // namespace gnomon::tool::view
