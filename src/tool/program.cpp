// The `gnomon` program: the table of its commands, which CMakeLists.txt writes from what this build has.
#include "program.hpp"

#include "command.hpp"

namespace gnomon::tool {

#define GNOMON_COMMAND(name, summary) std::function<int()> declare_##name(Arguments& arguments);
#define GNOMON_MISSING_COMMAND(name, summary, missing)
#include "command_table.inc"
#undef GNOMON_COMMAND
#undef GNOMON_MISSING_COMMAND

namespace {

constexpr Command kCommands[] = {
#define GNOMON_COMMAND(name, summary) {#name, summary, "", declare_##name},
#define GNOMON_MISSING_COMMAND(name, summary, missing) {#name, summary, missing, nullptr},
#include "command_table.inc"
#undef GNOMON_COMMAND
#undef GNOMON_MISSING_COMMAND
};

}  // namespace

int run_gnomon(int argc, char** argv) {
  return run_program(
      {"gnomon", "Turns a camera, a light and the bounds of a scene into the shadow maps worth drawing.", kCommands},
      argc, argv);
}

}  // namespace gnomon::tool
