// How is a bad file named? One line: which element, and what is wrong with it.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::detail {

/// `text` with control characters made spaces, and cut: file contents must not break the one-line promise.
[[nodiscard]] std::string one_line(std::string_view text);

/// "kind[index]", the way glTF elements are named in messages.
[[nodiscard]] std::string element(std::string_view kind, std::size_t index);

/// What load_gltf turns into a SceneError by putting the path in front.
class Refusal : public std::runtime_error {
 public:
  Refusal(const std::string& element, const std::string& what) : std::runtime_error(element + ": " + what) {}
};

/// A primitive or image that is left out with a warning instead of refusing the file.
class LeftOut : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Adds "element: what" to a scene's warnings. Where three say the same of other elements, one line counts
/// those that follow. Stops after a number no one would read, so that a file cannot make memory out of
/// mistakes.
void warn(std::vector<std::string>& warnings, const std::string& element, const std::string& what);
/// The same of a whole line.
void warn(std::vector<std::string>& warnings, const std::string& line);

}  // namespace gnomon::detail
