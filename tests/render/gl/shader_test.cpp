// Are shaders put together rightly, and are mistakes in them found where they are?
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "filter/filter_block.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/shape.hpp"
#include "gl/program.hpp"
#include "filter/stored_maps.hpp"

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
  // Its own, frame.glsl, the map's record, one of many lights, and the shapes: two files, and one for each.
  EXPECT_EQ(shader.files.size(), 6u + all_shapes().size());
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
    const ComposedShader plain = compose_shader(path, {"filter/hard.glsl", 1});
    if (std::find(plain.files.begin(), plain.files.end(), "filter/hard.glsl") != plain.files.end()) continue;
    EXPECT_EQ(validated(plain, extension.substr(1)), "") << path;
    ++checked;
  }
  for (const Filter* filter : all_filters()) {
    for (const MapRead reads : {filter->info.reads, reads_of(default_settings(*filter))}) {
      std::vector<std::string_view> paths = filter_shaders(*filter, reads);
      if (reads == MapRead::depth && !filter->info.draws_silhouettes) {
        paths.push_back("mask_lights.frag");
        paths.push_back("shade_clusters.frag");
      }
      const std::vector<std::string_view> of_pages =
          filter->info.draws_silhouettes ? std::vector<std::string_view>{} : pages_shaders(reads);
      paths.insert(paths.end(), of_pages.begin(), of_pages.end());
      for (const std::string_view path : paths) {
        const std::string extension = std::filesystem::path(path).extension();
        ShaderChoice choice{"filter/" + std::string(filter->info.name) + ".glsl",
                            shadow_vectors(default_settings(*filter)), true, reads == MapRead::filtered};
        EXPECT_EQ(validated(compose_shader(path, choice), extension.substr(1)), "")
            << filter->info.name << " " << path;
        ++checked;
        if (path != paths.front()) continue;  // the mask, which is compiled for linear maps as well
        choice.shapes = false;
        EXPECT_EQ(validated(compose_shader(path, choice), extension.substr(1)), "")
            << filter->info.name << " " << path << " for linear maps";
      }
    }
  }
  EXPECT_GT(checked, 10u);
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
    const ShaderChoice choice{"filter/" + std::string(filter->info.name) + ".glsl",
                              shadow_vectors(default_settings(*filter)), true,
                              filter->info.reads == MapRead::filtered};
    const ComposedShader shader = compose_shader_text("engine.frag", engine_shader(*filter), choice);
    EXPECT_EQ(validated(shader, "frag", "--target-env opengl -G"), "") << filter->info.name;
    EXPECT_EQ(validated(shader, "frag", "-V"), "") << filter->info.name;
  }
}

TEST(ShaderLibrary, names_no_binding_and_no_uniform_of_ours) {
  std::size_t checked = 0;
  for (const ShaderFile& file : shader_files()) {
    if (file.path.substr(0, 8) != "library/" && file.path.substr(0, 7) != "filter/") continue;
    for (const char* word : {"uniform", "binding", "common/", "frame.", "filtering.", "gl_"}) {
      EXPECT_EQ(file.text.find(word), std::string_view::npos) << file.path << " names " << word;
    }
    ++checked;
  }
  EXPECT_GT(checked, 10u);
}

}  // namespace
}  // namespace gnomon::render
