// Which sweeps does `gnomon compare` go through: of each view and light, with techniques of others?
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare.hpp"
#include "sweep.hpp"

namespace gnomon::tool {

/// A sweep with the hashes of its scenes.
struct Part {
  const CompareRequest* request = nullptr;
  Sweep sweep;
  std::vector<std::string> hashes;
};

/// Entries of others that are not measured, a line for each entry and scene.
class RefusedEntries {
 public:
  /// Warns, once for each line. `scene`: empty for all.
  void refuse(const std::string& entry, const std::string& scene, const std::string& why);
  [[nodiscard]] const std::vector<std::string>& lines() const noexcept { return lines_; }

 private:
  std::vector<std::string> lines_;
};

/// The sweeps of the requests, in their order, one for each light, numbered through. They have no hashes yet.
/// Throws std::runtime_error.
[[nodiscard]] std::vector<Part> parts_of(std::span<const CompareRequest> requests, RefusedEntries& refused);

}  // namespace gnomon::tool
