// Runs the `gnomon` program in a process forked from the test's own.
#include "process.hpp"
#include "program.hpp"

namespace gnomon::test {

Finished run_gnomon(const std::vector<std::string>& arguments, const std::string& input,
                    const std::filesystem::path& out_file) {
  return run_process(arguments, input, out_file, [](std::vector<char*>& argv) {
    return tool::run_gnomon(static_cast<int>(argv.size()) - 1, argv.data());
  });
}

}  // namespace gnomon::test
