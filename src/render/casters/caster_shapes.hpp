// What shape do moved casters have, and what shape had they when maps were last drawn?
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "casters/scene_buffers.hpp"

namespace gnomon::render {

/// A caster in one pose: its triangles, boxes round runs of them where it has many, or bounds alone where it
/// has more than are copied.
struct CasterShape {
  Box bounds_world;
  glm::dmat4 world_from_object{1.0};
  std::span<const glm::vec3> positions;    ///< object space
  std::span<const std::uint32_t> indices;  ///< into positions, three a triangle; none where there are parts
  std::span<const Box> parts;              ///< object space

  /// Triangles or parts; 0: bounds alone.
  [[nodiscard]] std::size_t size() const noexcept {
    return parts.empty() ? indices.size() / 3 : parts.size();
  }
};
struct MovedCaster {
  std::uint32_t instance = 0;
  CasterShape from, to;
};

/// Holds vertices on the CPU of those casters alone that moved() has returned once.
class CasterShapes {
 public:
  /// Triangles of a caster up to which each is told apart.
  static constexpr std::size_t kMaxParts = 1024;

  explicit CasterShapes(const SceneBuffers& scene);

  /// To be called before SceneBuffers::move.
  void keep(std::size_t instance);
  /// To be called before SceneBuffers::bend, with what it takes.
  void bend(std::size_t instance, std::uint32_t first, std::span<const glm::vec3> positions);
  /// Maps show everything as it is now.
  void forget_moves() noexcept;
  /// Casters that were kept since the last forget_moves(). Valid until the next call of any member. Waits for
  /// the driver where it returns an instance for the first time, to read its triangles; one that bent before
  /// has bounds alone for what it was.
  [[nodiscard]] std::span<const MovedCaster> moved();

 private:
  struct Posed {
    std::vector<glm::vec3> positions;
    std::vector<Box> parts;
  };
  struct Mesh {
    std::vector<std::uint32_t> vertices;  ///< of the scene, ascending: those that the triangles have
    std::vector<std::uint32_t> indices;   ///< into them
    Posed now, before;                    ///< before: where bent; empty: not known
    bool bent = false;                    ///< since the last forget_moves()
    bool stale_parts = false;             ///< those of `now`
  };
  struct Kept {
    std::uint32_t instance;
    Box bounds_world;
    glm::dmat4 world_from_object;
  };
  /// In place of a mesh: its triangles were not read yet, or bent besides since the last forget_moves().
  static constexpr std::uint32_t kUnread = ~0u, kUnreadBent = kUnread - 1;
  [[nodiscard]] Mesh& mesh_of(std::uint32_t primitive);
  static void make_parts(const Mesh& mesh, Posed& posed);
  [[nodiscard]] static CasterShape shape(const Mesh& mesh, const Posed& posed);

  const SceneBuffers& scene_;
  std::vector<Mesh> meshes_;
  std::vector<std::uint32_t> mesh_of_;  ///< by primitive
  std::vector<std::uint8_t> is_kept_;   ///< by instance
  std::vector<Kept> kept_;
  std::vector<MovedCaster> moved_;
};

}  // namespace gnomon::render
