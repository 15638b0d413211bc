// The street in OGRE: a scene manager, a sun, a shader that reads depth maps, and a picture of it all.
#pragma once

#include <Ogre.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "street.hpp"

namespace sample {

inline constexpr std::size_t kMaxTextures = 4;

/// Numbers of each map that the shader needs beside OGRE's own matrices: the view depths that it serves, and
/// its bias, which look-ups take off.
struct MapNumbers {
  std::array<float, kMaxTextures> begin{}, end{}, bias{};
};

class Stage {
 public:
  Stage(const Street& street, int width, int height);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Cameras for `count` shadow textures of `texels` squared, drawn with this slope factor of the rasterizer.
  void use(const Ogre::ShadowCameraSetupPtr& setup, std::size_t count, int texels, double slope_factor);
  void look(const gnomon::Camera& camera);
  /// Draws twice: the maps' cameras are set in the first frame, and `numbers_of` reads them for the second.
  [[nodiscard]] Drawn draw(const std::function<MapNumbers()>& numbers_of);
  /// The camera of a shadow texture, as it was set for the last frame.
  [[nodiscard]] Ogre::Camera* texture_camera(std::size_t i) const;
  /// Calls the set-up for all textures once more, as a frame does.
  void set_up_again() const;
  [[nodiscard]] Ogre::Camera* viewer() const { return viewer_; }
  [[nodiscard]] std::string device() const;

 private:
  struct Singletons;
  [[nodiscard]] Ogre::MaterialPtr material(std::size_t textures);
  void add_boxes(const Street& street);

  std::unique_ptr<Singletons> singletons_;
  int width_, height_;
  Ogre::SceneManager* scene_ = nullptr;
  Ogre::Camera* viewer_ = nullptr;
  Ogre::SceneNode* eye_ = nullptr;
  Ogre::Light* sun_ = nullptr;
  Ogre::TexturePtr target_;
  Ogre::RenderTexture* image_ = nullptr;
  std::vector<Ogre::ManualObject*> boxes_;
  Ogre::ShadowCameraSetupPtr setup_;
  std::size_t count_ = 0;
  Ogre::MaterialPtr material_, caster_;
};

}  // namespace sample
