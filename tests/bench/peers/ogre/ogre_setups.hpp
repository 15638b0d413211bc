// OGRE's shadow camera set-ups on a case: no window, no render system, only their matrices.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <memory>

#include "gnomon/casefile/casefile.hpp"

namespace peers {

enum class OgreSetup {
  focused,
  lispsm,        ///< as its constructor leaves it: a tenth of the simple n_opt
  lispsm_n_opt,  ///< the n_opt of the paper, general form, unscaled
  pssm,  ///< four maps of LiSPSM at its own splits (lambda 0.95), with its own padding and factors: n_opt
         ///< times 5, 1, 0 and 0, where 0 means no warp
  pssm_n_opt,  ///< the same with factor 1 for all
};

struct OgreMaps {
  static constexpr int kMaxCount = 4;
  std::array<glm::dmat4, kMaxCount> clip_from_world;
  std::array<double, kMaxCount + 1> border{};  ///< view depths between the maps, from the camera's near plane
  int count = 0;
};

/// One case as an OGRE scene. Its camera stands still between calls; one that moves costs OGRE 3 % more.
class OgreScene {
 public:
  explicit OgreScene(const gnomon::Case& c);
  ~OgreScene();
  OgreScene(const OgreScene&) = delete;
  OgreScene& operator=(const OgreScene&) = delete;
  /// Lets OGRE compute its maps; only then are they read.
  void set_up(OgreSetup setup);
  [[nodiscard]] OgreMaps maps(OgreSetup setup) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// OGRE's singletons, as far as the set-ups need them. One, before any OgreScene.
class OgreRoot {
 public:
  OgreRoot();
  ~OgreRoot();
  OgreRoot(const OgreRoot&) = delete;
  OgreRoot& operator=(const OgreRoot&) = delete;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace peers
