// Exact results on the disk: rays that were sent once are not sent again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/camera.hpp"
#include "gnomon/trace/reference.hpp"

namespace gnomon::tool {

/// Number of all that a result depends on: equal input has equal keys on every machine.
class ExactKey {
 public:
  explicit ExactKey(std::uint64_t hash) : hash_(hash) {}
  ExactKey& add(std::string_view text);
  ExactKey& add(double value);
  ExactKey& add(int value);
  ExactKey& add(const glm::dvec3& value);
  ExactKey& add(const Camera& camera);
  ExactKey& add(const trace::SurfacePoints& points);
  [[nodiscard]] std::uint64_t hash() const noexcept { return hash_; }

 private:
  std::uint64_t hash_;
};

class ExactResults {
 public:
  /// Keeps nothing.
  ExactResults() = default;
  /// Keeps results in `folder`, which is made when the first is written. `identity`: the program's version,
  /// the scene, its light, and what its files hold.
  ExactResults(std::filesystem::path folder, const std::string& identity);
  /// Results from now on are of the scene as it stands then, seconds.
  void pose(double seconds) noexcept { seconds_ = seconds; }
  /// The key of a result; scene, light and pose are in it.
  [[nodiscard]] ExactKey key(std::string_view what) const;
  /// The `count` values of the key: read from the disk, else computed and written. A file that is damaged is
  /// named in a warning and written again. One that cannot be written is named once; the values are returned
  /// all the same.
  [[nodiscard]] std::vector<float> values(const ExactKey& key, std::size_t count,
                                          const std::function<std::vector<float>()>& compute) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t identity_ = 0;
  double seconds_ = 0.0;
  mutable bool writes_ = true;
};

/// The values as bytes: a byte each where they are at most 256 different ones, else four; then compressed.
[[nodiscard]] std::string packed(const std::vector<float>& values);
/// Sets `values` to what packed() was given. Returns why it could not; empty: it could.
[[nodiscard]] std::string unpack(std::string_view bytes, std::size_t count, std::vector<float>& values);

}  // namespace gnomon::tool
