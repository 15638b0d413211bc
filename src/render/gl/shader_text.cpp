// Puts shader files together and reads compilers' logs back in terms of those files.
#include "gl/shader_text.hpp"

#include <algorithm>
#include <cctype>

#include "gnomon/plan.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {
namespace {

bool has_shader_file(std::string_view path) noexcept {
  const auto files = shader_files();
  return std::any_of(files.begin(), files.end(), [&](const ShaderFile& file) { return file.path == path; });
}

class Composer {
 public:
  Composer(const ShaderName& shader, const ShaderChoice& choice) : shader_(shader), choice_(choice) {}

  void add(std::string_view name, std::string_view text) {
    const std::size_t number = out_.files.size();
    out_.files.emplace_back(name);
    // #version must come first in the text, before any #line.
    const bool first = number == 0;
    if (!first) mark_line(1, number);
    std::size_t line = 1;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      add_line(name, text.substr(0, end), line, number);
      text.remove_prefix(std::min(end + 1, text.size()));
      ++line;
    }
  }
  ComposedShader take() { return std::move(out_); }

 private:
  void add_line(std::string_view name, std::string_view text, std::size_t line, std::size_t number) {
    constexpr std::string_view kInclude = "#include ", kVersion = "#version ";
    if (text.substr(0, kInclude.size()) != kInclude) {
      out_.text.append(text).push_back('\n');
      if (text.substr(0, kVersion.size()) == kVersion) {
        define("GNOMON_MAX_MAPS", static_cast<int>(kMaxMaps));
        define("GNOMON_SHADOW_VECTORS", choice_.vectors);
        define("GNOMON_READS_SLOPE", choice_.reads_slope ? 1 : 0);
        define("GNOMON_MEAN", choice_.mean ? 1 : 0);
        define("GNOMON_REACH", choice_.reach);
        define("GNOMON_CHANNELS", choice_.channels);
        define("GNOMON_VECTOR", choice_.vector);
        define("GNOMON_SHAPES", choice_.shapes ? 1 : 0);
        mark_line(line + 1, number);
      }
      return;
    }
    try {
      const std::string path = included_path(name, text.substr(kInclude.size()));
      if (std::find(out_.files.begin(), out_.files.end(), path) == out_.files.end())
        add(path, shader_file(path));
    } catch (const RenderError& error) {
      throw RenderError(std::string(name) + ":" + std::to_string(line) + ": " + error.what());
    }
    mark_line(line + 1, number);
  }
  /// `quoted`: "path" or <ROLE>, as it stands in the file `from`.
  [[nodiscard]] std::string included_path(std::string_view from, std::string_view quoted) const {
    const bool is_part = quoted.substr(0, 1) == "<";
    const std::size_t end = quoted.find(is_part ? '>' : '"', 1);
    const std::string_view named = quoted.substr(0, end).substr(std::min<std::size_t>(1, quoted.size()));
    if (!is_part) return std::string(named);
    const std::string role = std::string(named) + "/";
    const auto part = std::find_if(shader_.parts.begin(), shader_.parts.end(),
                                   [&](const std::string& each) { return each.starts_with(role); });
    if (part == shader_.parts.end()) throw RenderError("no part <" + std::string(named) + "> was chosen");
    const std::string beside = std::string(from.substr(0, from.rfind('/') + 1)) + *part + ".glsl";
    return has_shader_file(beside) ? beside : *part + ".glsl";
  }
  void define(std::string_view macro, int value) {
    out_.text.append("#define ").append(macro).append(" ").append(std::to_string(value)).push_back('\n');
  }
  void mark_line(std::size_t line, std::size_t number) {
    out_.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
  }

  const ShaderName& shader_;
  const ShaderChoice& choice_;
  ComposedShader out_;
};

std::size_t digits(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && std::isdigit(static_cast<unsigned char>(text[n])) != 0) ++n;
  return n;
}

}  // namespace

std::string_view shader_file(std::string_view path) {
  for (const ShaderFile& file : shader_files()) {
    if (file.path == path) return file.text;
  }
  throw RenderError("no shader file '" + std::string(path) + "'");
}

ComposedShader compose_shader(const ShaderName& shader, const ShaderChoice& choice) {
  return compose_shader_text(shader, shader_file(shader.path), choice);
}

ComposedShader compose_shader_text(const ShaderName& shader, std::string_view text,
                                   const ShaderChoice& choice) {
  Composer composer(shader, choice);
  composer.add(shader.path, text);
  return composer.take();
}

std::string filter_part(std::string_view filter) {
  return "filter/" + std::string(filter);
}

std::string name_files_in_log(std::string_view log, const std::vector<std::string>& files) {
  constexpr std::string_view kError = "ERROR: ";
  std::string out;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    std::string_view line = log.substr(0, end);
    log.remove_prefix(std::min(end + 1, log.size()));
    if (line.substr(0, kError.size()) == kError) line.remove_prefix(kError.size());
    const std::size_t n = digits(line);
    const bool numbered = n > 0 && n < 6 && n < line.size() && (line[n] == ':' || line[n] == '(');
    const std::size_t number = numbered ? std::stoul(std::string(line.substr(0, n))) : files.size();
    if (number < files.size()) {
      out += files[number];
      line.remove_prefix(n);
    }
    out.append(line).push_back('\n');
  }
  return out;
}

}  // namespace gnomon::render
