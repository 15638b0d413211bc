// The `gnomon` program as a call, for its main and for tests.
#pragma once

namespace gnomon::tool {

/// Runs the command that `argv` names, as the program does. Returns its exit code.
int run_gnomon(int argc, char** argv);

}  // namespace gnomon::tool
