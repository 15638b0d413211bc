// From a case to OGRE's objects, and from its shadow cameras to matrices.
#include "ogre_setups.hpp"

#include <Ogre.h>
#include <OgreDefaultHardwareBufferManager.h>
#include <OgreShadowCameraSetupFocused.h>
#include <OgreShadowCameraSetupLiSPSM.h>
#include <OgreShadowCameraSetupPSSM.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <variant>

namespace peers {
namespace {

Ogre::Vector3 vector_of(const glm::dvec3& v) {
  return {static_cast<Ogre::Real>(v.x), static_cast<Ogre::Real>(v.y), static_cast<Ogre::Real>(v.z)};
}

Ogre::AxisAlignedBox box_of(const std::vector<gnomon::Box>& boxes) {
  Ogre::AxisAlignedBox all;
  for (const gnomon::Box& box : boxes)
    all.merge(Ogre::AxisAlignedBox(vector_of(box.min), vector_of(box.max)));
  return all;
}

glm::dmat4 matrix_of(const Ogre::Matrix4& m) {
  glm::dmat4 result(0.0);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      result[column][row] = static_cast<double>(m[static_cast<std::size_t>(row)][column]);
  }
  return result;
}

/// A scene without objects that knows the bounds of objects: what OGRE finds while it culls is filled in.
class BoundedScene : public Ogre::SceneManager {
 public:
  BoundedScene() : Ogre::SceneManager("case") {}
  const Ogre::String& getTypeName() const override {
    static const Ogre::String name = "BoundedScene";
    return name;
  }
  void set_bounds(const Ogre::Camera* viewer, const Ogre::Camera* shadow, const Ogre::Light* light,
                  const Ogre::AxisAlignedBox& casters, const Ogre::AxisAlignedBox& receivers) {
    Ogre::VisibleObjectsBoundsInfo seen, lit;
    seen.aabb = receivers;
    seen.aabb.merge(casters);
    seen.receiverAabb = receivers;
    lit.aabb = casters;
    lit.receiverAabb = receivers;
    mCamVisibleObjectsMap[viewer] = seen;
    mCamVisibleObjectsMap[shadow] = lit;
    mShadowRenderer.mShadowCamLightMapping[shadow] = light;
  }
};

}  // namespace

struct OgreScene::Parts {
  BoundedScene scene;
  Ogre::Camera* viewer = nullptr;
  std::array<Ogre::Camera*, OgreMaps::kMaxCount> shadow{};
  Ogre::Light* light = nullptr;
  Ogre::FocusedShadowCameraSetup focused;
  Ogre::LiSPSMShadowCameraSetup lispsm;
  Ogre::LiSPSMShadowCameraSetup lispsm_n_opt{1.0f, false};
  Ogre::PSSMShadowCameraSetup pssm, pssm_n_opt;

  explicit Parts(const gnomon::Case& c);
  [[nodiscard]] const Ogre::ShadowCameraSetup& setup(OgreSetup which) const {
    switch (which) {
      case OgreSetup::focused:
        return focused;
      case OgreSetup::lispsm:
        return lispsm;
      case OgreSetup::lispsm_n_opt:
        return lispsm_n_opt;
      case OgreSetup::pssm:
        return pssm;
      case OgreSetup::pssm_n_opt:
        break;
    }
    return pssm_n_opt;
  }
};

OgreScene::Parts::Parts(const gnomon::Case& c) {
  Ogre::SceneNode* root = scene.getRootSceneNode();
  viewer = scene.createCamera("viewer");
  const gnomon::CameraAxes axes = gnomon::camera_axes(c.camera);
  Ogre::SceneNode* eye = root->createChildSceneNode(vector_of(c.camera.position));
  eye->setOrientation(Ogre::Quaternion(vector_of(axes.right), vector_of(axes.up), vector_of(-axes.forward)));
  eye->attachObject(viewer);
  viewer->setFOVy(Ogre::Radian(static_cast<Ogre::Real>(2.0 * std::atan(c.camera.top))));
  viewer->setAspectRatio(static_cast<Ogre::Real>(c.camera.right / c.camera.top));
  viewer->setNearClipDistance(static_cast<Ogre::Real>(c.camera.near_depth));
  viewer->setFarClipDistance(static_cast<Ogre::Real>(c.camera.far_depth));

  light = scene.createLight("sun");
  light->setType(Ogre::Light::LT_DIRECTIONAL);
  Ogre::SceneNode* sun = root->createChildSceneNode();
  sun->attachObject(light);
  sun->setDirection(vector_of(glm::normalize(std::get<gnomon::DirectionalLight>(c.light).direction)),
                    Ogre::Node::TS_WORLD);
  for (std::size_t i = 0; i < shadow.size(); ++i) {
    shadow[i] = scene.createCamera("shadow " + std::to_string(i));
    root->createChildSceneNode()->attachObject(shadow[i]);
    scene.set_bounds(viewer, shadow[i], light, box_of(c.casters), box_of(c.receivers));
  }
  for (Ogre::PSSMShadowCameraSetup* s : {&pssm, &pssm_n_opt})
    s->calculateSplitPoints(OgreMaps::kMaxCount, viewer->getNearClipDistance(), viewer->getFarClipDistance());
  for (std::size_t i = 0; i < OgreMaps::kMaxCount; ++i) pssm_n_opt.setOptimalAdjustFactor(i, 1.0f);
  root->_update(true, true);
}

OgreScene::OgreScene(const gnomon::Case& c) : parts_(std::make_unique<Parts>(c)) {}
OgreScene::~OgreScene() = default;

namespace {

std::size_t map_count(OgreSetup setup) {
  return setup == OgreSetup::pssm || setup == OgreSetup::pssm_n_opt ? OgreMaps::kMaxCount : 1;
}

}  // namespace

void OgreScene::set_up(OgreSetup setup) {
  const Ogre::ShadowCameraSetup& s = parts_->setup(setup);
  for (std::size_t i = 0; i < map_count(setup); ++i)
    s.getShadowCamera(&parts_->scene, parts_->viewer, nullptr, parts_->light, parts_->shadow[i], i);
}

OgreMaps OgreScene::maps(OgreSetup setup) const {
  OgreMaps result;
  const std::size_t count = map_count(setup);
  result.count = static_cast<int>(count);
  result.border[0] = static_cast<double>(parts_->viewer->getNearClipDistance());
  for (std::size_t i = 0; i < count; ++i) {
    const Ogre::Camera& camera = *parts_->shadow[i];
    result.clip_from_world[i] =
        matrix_of(camera.getProjectionMatrix()) * matrix_of(Ogre::Matrix4(camera.getViewMatrix()));
    result.border[i + 1] = static_cast<double>(count > 1 ? parts_->pssm.getSplitPoints()[i + 1]
                                                         : parts_->viewer->getFarClipDistance());
  }
  return result;
}

struct OgreRoot::Parts {
  Ogre::LogManager log;
  std::unique_ptr<Ogre::Root> root;
  std::unique_ptr<Ogre::DefaultHardwareBufferManager> buffers;
};

OgreRoot::OgreRoot() : parts_(std::make_unique<Parts>()) {
  parts_->log.createLog("", true, false, true);  // the default log, neither printed nor written
  parts_->root = std::make_unique<Ogre::Root>("", "", "");
  parts_->buffers = std::make_unique<Ogre::DefaultHardwareBufferManager>();
  Ogre::MaterialManager::getSingleton().initialise();
}
OgreRoot::~OgreRoot() = default;

}  // namespace peers
