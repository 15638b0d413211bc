// Does any text, taken for a capture, become a judgement whose words and figures are whole, or a refusal of
// one line?
#include <cmath>

#include "fuzz.hpp"
#include "judge/judge.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  using fuzz::require;
  try {
    const judge::Capture capture = judge::read_capture(fuzz::as_text(data, size));
    require(!capture.frames.empty(), "a capture has a frame");
    for (const judge::CapturedFrame& frame : capture.frames)
      require(frame.scene < capture.scenes.size(), "a frame has a scene");
    const judge::Judgement judgement = judge::judge(capture);
    require(judgement.lights.size() == capture.frames.front().lights.size(), "every light has figures");
    for (const judge::Finding& finding : judgement.findings) {
      require(!finding.what.empty() && !finding.change.empty(), "a finding says what and how to mend it");
      require(finding.frames >= 1 && static_cast<std::size_t>(finding.frames) <= capture.frames.size(),
              "a finding is in some of the frames");
      require(!std::isnan(finding.size), "a finding has a size");
    }
  } catch (const CaseError& refusal) {
    fuzz::require_one_line(refusal.what());
  }
  return 0;
}
