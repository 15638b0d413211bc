// Draws random frames, checks each, shrinks what fails, and sums up.
#include "run_frames.hpp"

#include <chrono>
#include <sstream>

#include "draw_frame.hpp"

namespace gnomon::stress {

FramesResult run_frames(const FrameOptionsOfRun& options, const std::function<void(long long)>& step) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  FramesResult result;
  Failures failures(all_frame_kinds());
  for (std::uint64_t number = 0; result.counts.frames < options.frames; ++number) {
    const nlohmann::ordered_json value = draw_frame(options.seed, number);
    FrameVerdict verdict = check_frame(value);
    // A frame that is refused counts as one, or a run of refusals would not end.
    if (verdict.counts.frames == 0) verdict.counts.frames = 1;
    result.counts.add(verdict.counts);
    failures.add(verdict.findings, number, value);
    if (step) step(result.counts.frames);
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  constexpr int kMostTries = 150;
  if (options.shrink)
    failures.shrink([](const nlohmann::ordered_json& value) { return check_frame(value).findings; },
                    kMostTries);
  result.kinds = failures.found();
  return result;
}

std::string summary(const FrameOptionsOfRun& options, const FramesResult& result) {
  std::ostringstream text;
  const FrameCounts& c = result.counts;
  text << c.frames << " random frames of " << c.cases << " scenes, seed " << options.seed << ", "
       << result.seconds << " s: " << c.moving << " after a move, " << c.maps << " maps, " << c.pages
       << " pages, " << c.pixels << " pixels that face the light; decided: " << c.lit << " lit, " << c.dark
       << " dark, " << c.exact << " of exact shadows, " << c.panes << " behind panes, " << c.unserved
       << " without a map; " << c.kept << " frames against a renderer that keeps nothing, " << c.anew
       << " against a new one\n";
  text << failure_lines(result.kinds);
  if (result.kinds.empty()) text << "every frame keeps every promise\n";
  return text.str();
}

}  // namespace gnomon::stress
