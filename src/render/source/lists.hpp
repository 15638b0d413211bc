// Exact shadows: pixels are listed by the texels that they look into, and casters are tested against them.
#pragma once

#include "source/frame_source.hpp"
#include "source/pixel_lists.hpp"

namespace gnomon::render {

class ListSource final : public FrameSource {
 public:
  /// Throws RenderError.
  ListSource(CasterScene& casters, const CasterPass& pass, Screen& screen);

  static const SourceSupport kSupport;

  /// True where the driver can hold the lists of the frame.
  [[nodiscard]] bool fits(const Camera& camera, const Source& source) const noexcept;

  [[nodiscard]] FrameOptionSet supports(const FrameJob& frame) const noexcept override;
  [[nodiscard]] SourceSteps steps(const FrameJob& frame) const noexcept override;
  void begin(FrameJob& frame) override;
  void update(FrameJob& frame) override;
  [[nodiscard]] SurfacePass surfaces() const noexcept override;
  void mask(FrameJob& frame, GLuint fbo) override;
  void tint(FrameJob& frame) override;
  void count(FrameJob& frame) override;

  [[nodiscard]] const PixelLists& lists() const noexcept { return lists_; }

 private:
  CasterScene& casters_;
  const CasterPass& pass_;
  Screen& screen_;
  PixelLists lists_;
};

}  // namespace gnomon::render
