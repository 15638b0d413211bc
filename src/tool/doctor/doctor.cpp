// `gnomon doctor`: what this machine offers, and why something does not work.
#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/render/frame_option.hpp"
#include "gnomon/render/probe.hpp"
#include "machine.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

using Json = nlohmann::ordered_json;

/// What a context can do, or why there is none.
Json context_json(render::ContextKind kind) {
  Json json{{"asked", std::string(to_string(kind))}};
  try {
    const std::unique_ptr<render::Context> context = render::create_context(kind);
    const render::ContextInfo& info = context->info();
    json["works"] = true;
    json["platform"] = info.platform;
    json["renderer"] = info.renderer;
    json["version"] = info.version;
    json["software"] = info.software;
    json["reports_resets"] = info.reports_resets;
    json["refused_before"] = info.refused;
    const render::Probe probe = render::probe_driver();
    json["limits"] = Json::object();
    for (const render::Limit& limit : probe.limits) json["limits"][limit.name] = limit.value;
    json["timer_queries"] = {{"trusted", probe.timers_trusted},
                             {"why", probe.timers_why},
                             {"timer_ms", probe.timer_ms},
                             {"wall_ms", probe.wall_ms}};
    json["layers"] = probe.layers;
  } catch (const render::RenderError& error) {
    json["works"] = false;
    json["why"] = error.what();
  }
  return json;
}

/// Programs and libraries that widen what this program can do, and where they would be.
Json packages_json() {
  Json json = Json::array();
  const auto add = [&json](const char* package, const char* what, bool found) {
    json.push_back({{"package", package}, {"for", what}, {"found", found}});
  };
  const auto on_path = [](const char* program) {
    for (const char* folder : {"/usr/local/bin/", "/usr/bin/", "/bin/"}) {
      std::error_code ignored;
      if (std::filesystem::exists(std::string(folder) + program, ignored)) return true;
    }
    return false;
  };
  add("libembree-dev", "fast rays (at build time)", machine({}).rays == "Embree");
  add("parallel", "shards of a sweep side by side", on_path("parallel"));
  add("chromium", "the test of the report in a browser", on_path("chromium"));
  add("glslang-tools", "the test of the shaders", on_path("glslangValidator"));
  add("xvfb", "windows without a display", on_path("xvfb-run"));
  return json;
}

void print_context(const Json& c) {
  print_line("context " + c["asked"].get<std::string>() + ": " +
             (c["works"].get<bool>() ? "works" : "does not work"));
  if (!c["works"].get<bool>()) {
    print_line("  " + c["why"].get<std::string>());
    return;
  }
  print_line("  " + c["platform"].get<std::string>() + ", " + c["renderer"].get<std::string>() + ", OpenGL " +
             c["version"].get<std::string>() + (c["software"].get<bool>() ? ", drawn by the CPU" : ""));
  print_line(std::string("  resets of the driver ") +
             (c["reports_resets"].get<bool>() ? "are reported" : "are not reported"));
  for (const Json& line : c["refused_before"]) print_line("  before it: " + line.get<std::string>());
  std::string limits = "  limits:";
  for (const auto& [name, value] : c["limits"].items()) limits += " " + name + " " + value.dump() + ",";
  limits.pop_back();
  print_line(limits);
  const Json& timers = c["timer_queries"];
  print_line(std::string("  timer queries: ") +
             (timers["trusted"].get<bool>() ? "can be trusted: " : "not trusted: ") +
             timers["why"].get<std::string>());
  const auto layers = c["layers"].get<std::string>();
  print_line("  maps in one pass: " + (layers.empty() ? "no, the driver has no extension for it" : layers));
}

/// What each source of shadows honours of a frame's options. Needs no context.
int run_sources(bool json) {
  if (!json) {
    std::string table = render::source_table();
    table.pop_back();  // the end of the last line
    print_line(table);
  } else {
    Json sources = Json::array();
    for (const render::SourceSupport& source : render::source_supports()) {
      Json honours = Json::array();
      for (std::size_t i = 0; i < render::kFrameOptionCount; ++i) {
        const auto option = static_cast<render::FrameOption>(i);
        if (source.supports.has(option)) honours.push_back(std::string(to_string(option)));
      }
      sources.push_back({{"source", std::string(source.name)}, {"honours", honours}});
    }
    print_line(sources.dump());
  }
  flush_output();
  return 0;
}

/// Exit code 0 where a context was found, else 2.
int run_doctor(bool json) {
  Json report;
  const report::Machine here = machine({});
  report["version"] = here.version;
  report["cpu"] = here.cpu;
  report["vector_units"] = vector_units();
  report["cores"] = here.cores;
  report["load"] = current_load();
  report["contexts"] = Json::array();
  bool any = false;
  for (const render::ContextKind kind :
       {render::ContextKind::automatic, render::ContextKind::osmesa, render::ContextKind::egl}) {
    report["contexts"].push_back(context_json(kind));
    any = any || report["contexts"].back()["works"].get<bool>();
  }
  report["packages"] = packages_json();
  if (json) {
    print_line(report.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else {
    print_line("gnomon " + here.version + " on " + here.cpu + ", " + std::to_string(here.cores) +
               " cores, load " + fmt::format("{:.2f}", report["load"].get<double>()));
    std::string units;
    for (const std::string& unit : vector_units()) units += (units.empty() ? "" : ", ") + unit;
    print_line("vector units that plans can use: " +
               (units.empty() ? "none" : units + "; they use the first"));
    for (const Json& context : report["contexts"]) print_context(context);
    for (const Json& package : report["packages"])
      print_line("package " + package["package"].get<std::string>() + ": " +
                 (package["found"].get<bool>() ? "found" : "not found") + ", for " +
                 package["for"].get<std::string>());
  }
  flush_output();
  constexpr int kNoContext = 2;
  return any ? 0 : kNoContext;
}

}  // namespace

std::function<int()> declare_doctor(Arguments& arguments) {
  const auto json = std::make_shared<bool>(false), sources = std::make_shared<bool>(false);
  arguments.options = {
      {.name = "--sources",
       .target = sources.get(),
       .help = "print which options of a frame each source of shadows honours"},
      {.name = "--json", .target = json.get(), .help = "print the findings as one line of JSON"}};
  return [json, sources] { return *sources ? run_sources(*json) : run_doctor(*json); };
}

}  // namespace gnomon::tool
