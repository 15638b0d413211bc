// Exact shadows among the filters of a command line: irregular or irregular:samples=N.
#pragma once

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gnomon/render/renderer.hpp"

namespace gnomon::tool {

/// Word that stands for render::Renderer::prepare_irregular. Behind it may follow `:samples=N`.
inline constexpr std::string_view kIrregular = "irregular";

/// The samples of a pixel that `irregular` or `irregular:samples=N` says; 0 for other words. Throws
/// std::runtime_error where N is no number of samples.
[[nodiscard]] inline int irregular_samples(const std::string& text) {
  constexpr std::string_view kSamples = ":samples=";
  if (!text.starts_with(kIrregular)) return 0;
  const std::string_view rest = std::string_view(text).substr(kIrregular.size());
  if (rest.empty()) return 1;
  int samples = 0;
  const char* const begin = rest.data() + std::min(kSamples.size(), rest.size());
  const char* const end = rest.data() + rest.size();
  const auto [last, error] = std::from_chars(begin, end, samples);
  if (!rest.starts_with(kSamples) || error != std::errc{} || last != end || samples < 1 ||
      samples > render::kMostFacetSamples)
    throw std::runtime_error("--filters " + text + ": wants irregular or irregular:samples=N, N from 1 to " +
                             std::to_string(render::kMostFacetSamples));
  return samples;
}

}  // namespace gnomon::tool
