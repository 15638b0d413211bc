// Are shaders put together rightly, and are mistakes in them found where they are?
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "gnomon/render/error.hpp"
#include "gnomon/render/filter.hpp"
#include "program.hpp"

namespace gnomon::render {
namespace {

std::string message_of(const auto& work) {
  try {
    work();
  } catch (const RenderError& error) {
    return error.what();
  }
  return "";
}

TEST(ShaderText, names_file_and_line_of_an_include_that_is_missing) {
  const std::string message = message_of([] {
    (void)compose_shader_text("broken.frag", "#version 450 core\n\n#include \"common/nowhere.glsl\"\n");
  });
  EXPECT_NE(message.find("broken.frag:3"), std::string::npos) << message;
  EXPECT_NE(message.find("common/nowhere.glsl"), std::string::npos) << message;
}

TEST(ShaderText, includes_a_file_once) {
  const ComposedShader shader = compose_shader_text(
      "twice.frag", "#version 450 core\n#include \"common/frame.glsl\"\n#include \"common/frame.glsl\"\n");
  EXPECT_EQ(shader.files.size(), 2u);
  EXPECT_EQ(shader.text.find("uniform Frame"), shader.text.rfind("uniform Frame"));
}

TEST(ShaderText, reads_the_logs_of_all_compilers) {
  const std::vector<std::string> files{"a.frag", "b.glsl"};
  EXPECT_EQ(name_files_in_log("1:7(3): error: no\n", files), "b.glsl:7(3): error: no\n");
  EXPECT_EQ(name_files_in_log("0(12) : error C0000\n", files), "a.frag(12) : error C0000\n");
  EXPECT_EQ(name_files_in_log("ERROR: 1:9: 'x' : undeclared\n", files), "b.glsl:9: 'x' : undeclared\n");
  EXPECT_EQ(name_files_in_log("7:7: what file is that\nplain\n", files), "7:7: what file is that\nplain\n");
}

TEST(Program, says_file_and_line_of_an_error) {
  const std::string message = message_of([] {
    (void)make_program(
        compose_shader("fullscreen.vert"),
        compose_shader_text("broken.frag",
                            "#version 450 core\n#include \"common/octahedral.glsl\"\nvoid main() {\n"
                            "  float x = undeclared;\n}\n"));
  });
  EXPECT_NE(message.find("broken.frag:4"), std::string::npos) << message;
  EXPECT_NE(message.find("undeclared"), std::string::npos) << message;
}

TEST(Program, says_which_shaders_do_not_link) {
  const std::string message = message_of([] {
    (void)make_program(compose_shader("fullscreen.vert"),
                       compose_shader_text("lonely.frag",
                                           "#version 450 core\nin vec3 from_nobody;\nout vec4 c;\n"
                                           "void main() { c = vec4(from_nobody, 1.0); }\n"));
  });
  EXPECT_NE(message.find("lonely.frag"), std::string::npos) << message;
}

/// The validator's words, empty where it is content.
std::string validated(const std::string& name, const ComposedShader& shader, const std::string& stage) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("gnomon_" + name + "." + stage);
  const auto log = std::filesystem::path(testing::TempDir()) / ("gnomon_" + name + ".log");
  std::ofstream(file) << shader.text;
  const std::string command =
      std::string(GLSLANG_VALIDATOR) + " -S " + stage + " " + file.string() + " > " + log.string() + " 2>&1";
  const int status = std::system(command.c_str());
  std::ifstream in(log);
  std::string words{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  std::filesystem::remove(log);
  return status == 0 ? "" : name_files_in_log(words, shader.files);
}

TEST(Shaders, pass_the_reference_validator_with_every_filter) {
  if (std::string_view(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator is not installed";
  std::size_t checked = 0;
  for (const ShaderFile& file : shader_files()) {
    const std::string path(file.path);
    const std::string extension = std::filesystem::path(path).extension();
    if (extension == ".glsl") continue;
    const bool filtered = file.text.find("#include <filter>") != std::string_view::npos;
    for (const Filter* filter : all_filters()) {
      const std::string filter_path = "filter/" + std::string(filter->name) + ".glsl";
      EXPECT_EQ(validated(std::to_string(checked), compose_shader(path, filter_path), extension.substr(1)),
                "")
          << path;
      ++checked;
      if (!filtered) break;
    }
  }
  EXPECT_GT(checked, 10u);
}

}  // namespace
}  // namespace gnomon::render
