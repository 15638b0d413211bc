// The street in OpenSceneGraph: a scene, a sun, shaders that read a depth map, and a picture of it all.
#pragma once

#include <osg/LightSource>
#include <osg/PolygonOffset>
#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowedScene>
#include <osgShadow/ViewDependentShadowMap>
#include <osgViewer/Viewer>

#include <chrono>
#include <functional>
#include <string>

#include "gnomon/gnomon.hpp"
#include "street.hpp"

namespace sample {

/// A technique's settings of the sample, and what it looks at.
struct Watch {
  double slope_factor = 0.0;         ///< of the rasterizer
  osg::ref_ptr<osg::Camera> camera;  ///< the shadow camera of the last frame
  double microseconds = 0.0;         ///< that its set-up took in the last frame
};

/// A technique with a watch.
template <class Technique>
class Watched : public Technique {
 public:
  template <class... Arguments>
  explicit Watched(Watch& watch, const Arguments&... arguments) : Technique(arguments...), watch_(watch) {}

  void init() override {
    Technique::init();
    this->_shadowCastingStateSet->setAttributeAndModes(
        new osg::PolygonOffset(static_cast<float>(watch_.slope_factor), 0.0f),
        osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  }
  bool computeShadowCameraSettings(typename Technique::Frustum& frustum, typename Technique::LightData& light,
                                   osg::Matrixd& projection, osg::Matrixd& view) override {
    watch_.microseconds = 0.0;
    return timed([&] { return Technique::computeShadowCameraSettings(frustum, light, projection, view); });
  }
  bool adjustPerspectiveShadowMapCameraSettings(osgUtil::RenderStage* stage,
                                                typename Technique::Frustum& frustum,
                                                typename Technique::LightData& light,
                                                osg::Camera* camera) override {
    return timed(
        [&] { return Technique::adjustPerspectiveShadowMapCameraSettings(stage, frustum, light, camera); });
  }
  void cullShadowCastingScene(osgUtil::CullVisitor* visitor, osg::Camera* camera) const override {
    watch_.camera = camera;
    Technique::cullShadowCastingScene(visitor, camera);
  }

 private:
  template <class SetUp>
  bool timed(SetUp&& set_up) {
    const auto begin = std::chrono::steady_clock::now();
    const bool done = set_up();
    watch_.microseconds +=
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
    return done;
  }

  Watch& watch_;
};

class Stage {
 public:
  Stage(const Street& street, int width, int height);

  /// Draws from now on by this technique, with one map of `texels` squared.
  void use(osgShadow::ViewDependentShadowMap* technique,
           osgShadow::ShadowSettings::ShadowMapProjectionHint hint, int texels);
  void look(const gnomon::Camera& camera);
  /// Draws twice: the map's camera is set in the first frame, and `bias_of` says for the second what look-ups
  /// take off their depths.
  [[nodiscard]] Drawn draw(const std::function<double()>& bias_of);
  [[nodiscard]] std::string device();

 private:
  osg::ref_ptr<osg::Image> image_ = new osg::Image;
  osg::ref_ptr<osg::Uniform> bias_ = new osg::Uniform("bias", 0.0f);
  osg::ref_ptr<osgShadow::ShadowedScene> scene_ = new osgShadow::ShadowedScene;
  osgViewer::Viewer viewer_;
};

}  // namespace sample
