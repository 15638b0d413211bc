// Does anything stand between this point and the light? Rays against a scene's triangles, in single precision
// through Embree where it was built in, and in double precision by a hierarchy of our own that holds Embree
// to account.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

#include "gnomon/scene/scene.hpp"

namespace gnomon::trace {

/// Embree was requested where it was not built in, or it ran out of memory. what() is one line.
class TraceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr std::uint32_t kNoTriangle = 0xffff'ffffu;

/// Points origin + t direction with begin <= t <= end. `direction` is of any non-zero length.
struct Ray {
  glm::dvec3 origin{0.0};                                ///< world
  glm::dvec3 direction{0.0, 1.0, 0.0};                   ///< world
  double begin = 0.0;                                    ///< in lengths of direction; Embree wants it >= 0
  double end = std::numeric_limits<double>::infinity();  ///< the same
  std::uint32_t except = kNoTriangle;                    ///< a triangle that is not there for this ray
};

/// Where a ray meets a triangle.
struct Hit {
  std::uint32_t triangle = kNoTriangle;  ///< kNoTriangle: nothing was hit, the rest is unset
  double t = 0.0;                        ///< in lengths of the ray's direction
  glm::dvec3 normal{0.0};                ///< of the triangle, unit, on the side that its corners turn around
                                         ///< counter-clockwise; zero where it has no area
};

enum class Engine : std::uint8_t {
  automatic,  ///< Embree where it was built in and errs by at most an eighth of the median triangle; else own
  embree,     ///< single precision, sixteen rays at a time, edges closed (RTC_SCENE_FLAG_ROBUST)
  own,        ///< double precision, edges closed; slower by a factor of about ten
};
[[nodiscard]] std::string_view to_string(Engine engine) noexcept;
[[nodiscard]] bool built_with_embree() noexcept;

/// A scene's triangles, ready for rays. Alpha-masked surfaces are there where the finest level of their image
/// is, read bilinearly as the renderer reads it. Both sides of every triangle stop rays. Keeps no reference
/// to the scene. Calls from several threads at once are fine.
class Tracer {
 public:
  /// Throws TraceError.
  explicit Tracer(const Scene& scene, Engine engine = Engine::automatic);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  [[nodiscard]] Engine engine() const noexcept;  ///< never automatic
  /// Triangles of all instances.
  [[nodiscard]] std::size_t triangle_count() const noexcept;

  /// Index into Scene::instances. `triangle`: below triangle_count().
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t triangle) const noexcept;
  /// Whether shadows fall on a triangle: Instance::receives. `triangle`: below triangle_count().
  [[nodiscard]] bool receives(std::uint32_t triangle) const noexcept;
  /// out[i] = 1 where a caster (Instance::casts) stops rays[i], else 0. The spans are equally long.
  /// Neighbours in the span should be neighbours in the scene.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> out) const;
  /// By our own hierarchy, in double, whichever the engine: what cameras may see (Instance::shown) and a ray
  /// meets first.
  [[nodiscard]] Hit first_hit(const Ray& ray) const noexcept;
  /// The same among casters.
  [[nodiscard]] Hit first_caster(const Ray& ray) const noexcept;
  /// As first_hit, for what a picture shows: without back faces, unless their material is double-sided.
  [[nodiscard]] Hit first_seen(const Ray& ray) const noexcept;
  /// As first_hit, but the hit whose t is nearest to `t`.
  [[nodiscard]] Hit hit_nearest_to(const Ray& ray, double t) const noexcept;

  /// Largest distance between true triangles and those that the engine hits, world units. A result is certain
  /// where it does not change within this distance across the ray. A multiple of the rounding unit times the
  /// diameter of the scene, enlarged by `reach`, the distance from which rays start.
  [[nodiscard]] double error_world(double reach = 0.0) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gnomon::trace
