// Flies through a scene with planned shadow maps, and shows how good they are. See README.md.
#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "flight.hpp"
#include "interrupt.hpp"
#include "options.hpp"

namespace {

int run(int argc, char** argv) {
  std::optional<flythrough::Options> options = flythrough::parse_options(argc, argv);
  if (!options) return 0;
  const flythrough::Flight flight = flythrough::load_flight(*options);
  if (options->budget.milliseconds > 0.0 || options->budget.target_error > 0.0)
    flythrough::choose_technique_of(*options, flight);
  if (options->perceptual_resolution)
    options->plan.map_size = flythrough::perceptual_map_size(*options, flight);
  return options->context == gnomon::render::ContextKind::glfw ? flythrough::fly_in_window(*options, flight)
                                                               : flythrough::fly_to_files(*options, flight);
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that leaves early is an error to report, not a signal that leaves half a picture.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const int code = run(argc, argv);
    if (std::fflush(stdout) != 0 || !std::cout)
      throw flythrough::UsageError("standard output cannot be written");
    return code;
  } catch (const gnomon::tool::Interrupted&) {
    fmt::print(stderr, "flythrough: interrupted\n");
    return gnomon::tool::kInterrupted;
  } catch (const std::runtime_error& error) {  // the world outside: arguments, files, drivers
    fmt::print(stderr, "flythrough: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "flythrough: {}\n", error.what());
    return 1;
  }
}
