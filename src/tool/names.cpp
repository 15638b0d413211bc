// Names that a command line takes: lists of them for messages, and which one was meant.
#include <stdexcept>

#include "command.hpp"
#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {
std::string any_of_text(std::span<const std::string> names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return all;
}

void refuse_name(std::string_view option, const std::string& value, std::span<const std::string> names) {
  throw std::runtime_error(std::string(option) + " " + one_line(value, 80) + ": wants " + any_of_text(names) +
                           meant(value, names));
}

}  // namespace gnomon::tool
