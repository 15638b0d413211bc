// Are shaders put together rightly, and are mistakes in them found where they are?
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "filter/filter_block.hpp"
#include "filter/stored_maps.hpp"
#include "gl/program.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/filter.hpp"

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
    (void)compose_shader_text("broken.frag", "#version 450 core\n\n#include \"pass/common/nowhere.glsl\"\n");
  });
  EXPECT_NE(message.find("broken.frag:3"), std::string::npos) << message;
  EXPECT_NE(message.find("pass/common/nowhere.glsl"), std::string::npos) << message;
}

TEST(ShaderText, includes_a_file_once) {
  const ComposedShader shader = compose_shader_text(
      "twice.frag",
      "#version 450 core\n#include \"pass/common/frame.glsl\"\n#include \"pass/common/frame.glsl\"\n");
  // Its own, frame.glsl, the map's record, and the shapes: two files, and one for each.
  EXPECT_EQ(shader.files.size(), 5u + all_shapes().size());
  EXPECT_EQ(shader.text.find("uniform Frame"), shader.text.rfind("uniform Frame"));
}

TEST(ShaderText, takes_parts_beside_the_file_that_includes_them_else_from_all_shaders) {
  const ComposedShader shader = compose_shader(
      {"pass/shade/clusters.frag", {"source/clusters", "read/depth", filter_part("hard"), "unused/part"}});
  for (const char* path : {"pass/mask/source/clusters.glsl", "pass/mask/read/depth.glsl", "filter/hard.glsl"})
    EXPECT_NE(std::find(shader.files.begin(), shader.files.end(), path), shader.files.end()) << path;
}

TEST(ShaderText, names_file_and_line_of_a_part_that_is_missing) {
  const std::string unchosen = message_of([] { (void)compose_shader("pass/depth/depth.frag"); });
  EXPECT_EQ(unchosen, "pass/depth/depth.frag:4: no part <alpha> was chosen");
  const std::string unknown = message_of([] {
    (void)compose_shader({"pass/depth/depth.frag", {"alpha/some"}});
  });
  EXPECT_EQ(unknown, "pass/depth/depth.frag:4: no shader file 'alpha/some.glsl'");
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
    (void)link_screen_program(
        compose_shader_text("broken.frag",
                            "#version 450 core\n#include \"pass/common/octahedral.glsl\"\nvoid main() {\n"
                            "  float x = undeclared;\n}\n"));
  });
  EXPECT_NE(message.find("broken.frag:4"), std::string::npos) << message;
  EXPECT_NE(message.find("undeclared"), std::string::npos) << message;
}

TEST(Program, says_file_and_line_of_an_error_in_a_part) {
  const std::string message = message_of([] {
    // A mask's part outside of a mask.
    (void)link_screen_program(compose_shader_text({"pass/mask/broken.frag", {"read/identifiers"}},
                                                  "#version 450 core\n#include <read>\nvoid main() {}\n"));
  });
  EXPECT_NE(message.find("pass/mask/read/identifiers.glsl:"), std::string::npos) << message;
}

TEST(Program, says_which_shaders_do_not_link) {
  const std::string message = message_of([] {
    (void)link_screen_program(compose_shader_text("lonely.frag",
                                                  "#version 450 core\nin vec3 from_nobody;\nout vec4 c;\n"
                                                  "void main() { c = vec4(from_nobody, 1.0); }\n"));
  });
  EXPECT_NE(message.find("lonely.frag"), std::string::npos) << message;
}

/// The validator's words, empty where it is content. `target`: what for, as the validator takes it.
std::string validated(const ComposedShader& shader, const std::string& stage,
                      const std::string& target = "") {
  const std::string name = testing::TempDir() + "gnomon_shader_" + std::to_string(::getpid());
  const std::filesystem::path file = name + "." + stage, log = name + ".log", binary = name + ".spv";
  std::ofstream(file) << shader.text;
  const std::string command = std::string(GLSLANG_VALIDATOR) + " " + target + " -S " + stage +
                              (target.empty() ? "" : " -o " + binary.string()) + " " + file.string() + " > " +
                              log.string() + " 2>&1";
  const int status = std::system(command.c_str());
  std::ifstream in(log);
  std::string words{std::istreambuf_iterator<char>(in), {}};
  for (const auto& each : {file, log, binary}) std::filesystem::remove(each);
  return status == 0 ? "" : name_files_in_log(words, shader.files);
}

using Parts = std::vector<std::string>;

/// Adds the parts of each role that a file and what it includes ask for. `roles`: to the names of its parts.
void find_roles(const std::string& path, std::map<std::string, Parts>& roles) {
  std::istringstream lines{std::string(shader_file(path))};
  for (std::string line; std::getline(lines, line);) {
    const std::string include = "#include ";
    if (!line.starts_with(include)) continue;
    const std::string named = line.substr(include.size() + 1, line.size() - include.size() - 2);
    if (line[include.size()] == '"') {
      find_roles(named, roles);
    } else if (named == "filter") {
      roles[named];
    } else if (!roles.contains(named)) {
      const std::string folder = path.substr(0, path.rfind('/') + 1) + named + "/";
      for (const ShaderFile& file : shader_files()) {
        if (!file.path.starts_with(folder)) continue;
        roles[named].push_back(named + "/" + std::filesystem::path(file.path).stem().string());
        find_roles(std::string(file.path), roles);
      }
      EXPECT_FALSE(roles[named].empty()) << path << ": " << line;
    }
  }
}

/// Every choice of one part of each role.
std::vector<Parts> choices_of(const std::map<std::string, Parts>& roles) {
  std::vector<Parts> choices{{}};
  for (const auto& [role, parts] : roles) {
    std::vector<Parts> longer;
    for (const Parts& choice : choices) {
      for (const std::string& part : parts) {
        longer.push_back(choice);
        longer.back().push_back(part);
      }
    }
    choices = std::move(longer);
  }
  return choices;
}

std::string name_of(const ShaderName& shader) {
  std::string name = shader.path;
  for (const std::string& part : shader.parts) name += " " + part;
  return name;
}

TEST(Shaders, pass_the_reference_validator_with_every_filter) {
  if (std::string_view(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator is not installed";
#if defined(__SANITIZE_ADDRESS__)
  // The validator is a program of its own, without a sanitizer: a second run of some minutes would find
  // nothing else.
  GTEST_SKIP() << "the validator's verdict on the same text is the release build's test";
#endif
  std::size_t checked = 0;
  for (const ShaderFile& file : shader_files()) {
    const std::string path(file.path);
    const std::string extension = std::filesystem::path(path).extension();
    if (extension == ".glsl") continue;
    std::map<std::string, Parts> roles;
    find_roles(path, roles);
    if (roles.contains("filter")) continue;
    for (const Parts& parts : choices_of(roles)) {
      const ShaderName shader{path, parts};
      EXPECT_EQ(validated(compose_shader(shader), extension.substr(1)), "") << name_of(shader);
      ++checked;
    }
  }
  EXPECT_GT(checked, 40u);
  for (const Filter* filter : all_filters()) {
    for (const MapRead reads : {filter->info.reads, reads_of(default_settings(*filter))}) {
      std::vector<ShaderName> shaders = filter_shaders(*filter, reads);
      for (const auto& more : {pages_shaders(*filter, reads), lights_shaders(*filter, reads)})
        shaders.insert(shaders.end(), more.begin(), more.end());
      for (std::size_t i = 0; i < shaders.size(); ++i) {
        const std::string extension = std::filesystem::path(shaders[i].path).extension();
        ShaderChoice choice{shadow_vectors(default_settings(*filter)), true, reads == MapRead::filtered};
        EXPECT_EQ(validated(compose_shader(shaders[i], choice), extension.substr(1)), "")
            << name_of(shaders[i]);
        if (i > 0) continue;  // the mask, which is compiled for linear maps as well
        choice.shapes = false;
        EXPECT_EQ(validated(compose_shader(shaders[i], choice), extension.substr(1)), "")
            << name_of(shaders[i]) << " for linear maps";
      }
    }
  }
}

/// An engine's shader: its own names and bindings, ours only as functions and types.
std::string engine_shader(const Filter& filter) {
  std::string text = R"(#version 450
#include <filter>
#include "library/receiver.glsl"
#include "library/select_map.glsl"
layout(std140, binding = 20) uniform Engine {
  ShadowMap engine_maps[4];
  vec4 sun, tuning, settings[4];
} engine;
layout(binding = 21) uniform sampler2DArray engine_depth;
layout(binding = 22) uniform sampler2DArrayShadow engine_compare;
layout(binding = 23) uniform sampler2DArray engine_depth_max;
layout(location = 0) in vec3 engine_point;
layout(location = 1) in vec3 engine_normal;
layout(location = 0) out vec4 color;
ShadowMap shadow_map(int index) { return engine.engine_maps[index]; }
)";
  const std::string_view reads = filter.info.reads == MapRead::filtered ? "filtered"
                                 : filter.info.reads == MapRead::joined ? "joined"
                                                                        : "summed";
  if (filter.info.draws_silhouettes) {
    text +=
        "layout(binding = 24) uniform sampler2DArray engine_points;\n"
        "vec2 shadow_silhouette(ShadowLookup at, vec2 texel) {\n"
        "  return textureLod(engine_points, vec3((texel + 0.5) / at.layer_size, at.layer), 0.0).rg;\n}\n";
  }
  std::string visible = "shadow_visibility(engine_compare, engine_depth, at, options)";
  if (filter.info.reads != MapRead::depth) {
    text += "#include \"library/fetch_" + std::string(reads) + ".glsl\"\n";
    text += filter.info.reads == MapRead::summed
                ? "layout(binding = 24) uniform usampler2DArray engine_stored;\n"
                  "ShadowTexel shadow_mean(ShadowLookup at) { return fetch_summed(engine_stored, at, "
                  "1048576.0); }\n"
                : "layout(binding = 24) uniform sampler2DArray engine_stored[GNOMON_SHADOW_VECTORS];\n";
    const std::string more = filter.info.reads == MapRead::joined   ? ", 16, options"
                             : filter.info.reads == MapRead::summed ? ", 1048576.0"
                                                                    : ", 4";
    visible = "shadow_visibility(fetch_" + std::string(reads) + "(engine_stored, at" + more +
              "), engine_depth, engine_depth_max, at, options)";
  }
  return text + R"(
void main() {
  ShadowOptions options;
  for (int i = 0; i < 16; ++i) options.value[i] = engine.settings[i / 4][i & 3];
  options.rounding = 6e-8;
  options.unsigned_unit = false;
  vec3 ray = light_at(engine.sun, engine_point);
  int map = map_of_finest_texel(engine_point, 0.1, ray, 4);
  if (map < 0) map = map_by_depth(engine_point, engine_point.z, 4);
  if (map < 0) map = map_by_hold(engine_point, 4);
  ShadowLookup at = shadow_lookup(shadow_map(map), float(map), vec2(1024.0), ShadowSurface(engine_point, engine_normal, engine.sun),
                                  engine.tuning);
  set_kernel(at, shadow_map(map), ShadowKernel(1.0, true, true), mat2(1.0));
  float lit = )" +
         visible + R"(;
  float next = share_of_next_map(shadow_map(map), engine_point.z);
  color = vec4(lit, next, pixel_noise(gl_FragCoord.xy), 1.0);
}
)";
}

TEST(ShaderLibrary, compiles_in_an_engines_shader_for_opengl_and_for_vulkan) {
  if (std::string_view(GLSLANG_VALIDATOR).empty()) GTEST_SKIP() << "glslangValidator is not installed";
  for (const Filter* filter : all_filters()) {
    const ShaderChoice choice{shadow_vectors(default_settings(*filter)), true,
                              filter->info.reads == MapRead::filtered};
    const ComposedShader shader = compose_shader_text({"engine.frag", {filter_part(filter->info.name)}},
                                                      engine_shader(*filter), choice);
    EXPECT_EQ(validated(shader, "frag", "--target-env opengl -G"), "") << filter->info.name;
    EXPECT_EQ(validated(shader, "frag", "-V"), "") << filter->info.name;
  }
}

TEST(ShaderLibrary, names_each_option_at_the_place_that_the_settings_have) {
  for (const Filter* filter : all_filters()) {
    const std::string file = "filter/option/" + std::string(filter->info.name) + ".glsl";
    std::string expected;
    std::size_t place = 0;
    const auto expect = [&](std::string_view name) {
      expected += "const int option_" + std::string(name) + " = " + std::to_string(place++) + ";\n";
    };
    for (const FilterOption& option : filter->info.options) expect(option.name);
    for (const std::string_view name : filter->info.own_options) expect(name);
    const std::string_view text = shader_file(file);
    EXPECT_EQ(text.substr(text.find('\n') + 1), expected) << file;
  }
}

TEST(ShaderLibrary, reads_no_option_by_number) {
  for (const ShaderFile& file : shader_files()) {
    if (!file.path.starts_with("library/") && !file.path.starts_with("filter/")) continue;
    const std::string_view access = "options.value[";
    for (std::size_t at = file.text.find(access); at != std::string_view::npos;
         at = file.text.find(access, at + 1))
      EXPECT_EQ(file.text.substr(at + access.size(), 7), "option_") << file.path;
  }
}

TEST(ShaderLibrary, names_no_binding_and_no_uniform_of_ours) {
  std::size_t checked = 0;
  for (const ShaderFile& file : shader_files()) {
    if (file.path.substr(0, 8) != "library/" && file.path.substr(0, 7) != "filter/") continue;
    for (const char* word : {"uniform", "binding", "pass/", "frame.", "filtering.", "gl_"}) {
      EXPECT_EQ(file.text.find(word), std::string_view::npos) << file.path << " names " << word;
    }
    ++checked;
  }
  EXPECT_GT(checked, 10u);
}

}  // namespace
}  // namespace gnomon::render
