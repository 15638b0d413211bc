// `gnomon stress --random`: random cases, checked, and the smallest that fails of each kind as a file.
#include "stress/random.hpp"

#include <filesystem>
#include <stdexcept>

#include "base/bounded_file.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "run.hpp"
#ifdef GNOMON_STRESS_HAS_FRAMES
#include "stress/frames.hpp"
#endif

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::string text;
  const std::string why = read_bounded_file(file, kMaxCaseBytes, Readable::file_or_pipe, text);
  if (!why.empty()) throw CaseError(shown_name(file) + ": " + why);
  return text;
}

stress::Verdict check_text(const std::string& text, const fs::path& file) {
  try {
    (void)read_case(text);  // says what is wrong with it, and where
  } catch (const CaseError& error) {
    throw CaseError(shown_name(file) + ": " + error.what());
  }
  return stress::check_case(nlohmann::ordered_json::parse(text));
}

int replay(const RandomStressRequest& request) {
  int failed = 0;
  for (const std::string& file : request.replay) {
    const std::string text = text_of(file);
#ifdef GNOMON_STRESS_HAS_FRAMES
    if (is_frame_file(text)) {
      failed += replay_frame(text, shown_name(file), request.context) ? 1 : 0;
      continue;
    }
#endif
    const stress::Verdict verdict = check_text(text, file);
    for (const stress::Finding& f : verdict.findings)
      print_line(shown_name(file) + ": " + std::string(f.kind) + ": " + f.text);
    if (verdict.findings.empty()) print_line(shown_name(file) + ": keeps every promise");
    failed += verdict.findings.empty() ? 0 : 1;
  }
  flush_output();
  return failed == 0 ? 0 : 1;
}

}  // namespace

int run_random_stress(const RandomStressRequest& request) {
  if (!request.replay.empty()) return replay(request);
  const fs::path folder = failure_folder(request.out, request.seed);
  const stress::RandomOptions options{static_cast<long long>(request.random), request.seed, true};
  Progress progress("gnomon stress --random", options.cases);
  long long done = 0;
  const stress::RandomResult result = stress::run_random(options, [&] { progress.set(++done); });
  progress.clear();
  std::string text = stress::summary(options, result);
  if (!result.kinds.empty()) make_folder("--out", folder);
  for (const stress::KindFound& found : result.kinds) {
    const fs::path file = folder / (std::string(found.kind) + ".json");
    write_file(file, found.case_file);
    text += "wrote " + shown_name(file) + "\n";
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  print_line(text);
  flush_output();
  return result.kinds.empty() ? 0 : 1;
}

}  // namespace gnomon::tool
