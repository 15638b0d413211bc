// From OpenSceneGraph's frustum to a plan, and from a plan to its shadow camera.
#include "gnomon_shadow_map.hpp"

#include <glm/gtc/type_ptr.hpp>

namespace sample {

// A row that is multiplied from the left lies in memory as a column that is multiplied from the right.
glm::dmat4 glm_from(const osg::Matrixd& m) {
  return glm::make_mat4(m.ptr());
}

osg::Matrixd osg_from(const glm::dmat4& m) {
  return osg::Matrixd(glm::value_ptr(m));
}

bool GnomonShadowMap::computeShadowCameraSettings(Frustum& frustum, LightData& light,
                                                  osg::Matrixd& projection, osg::Matrixd& view) {
  // Without a viewport at hand: pixels count by the ratio of the sides alone.
  constexpr int kRows = 1024;
  const glm::dmat4 clip_from_view = glm_from(frustum.projectionMatrix);
  const auto columns = static_cast<int>(kRows * clip_from_view[1][1] / clip_from_view[0][0]);
  const gnomon::CameraFrom from =
      gnomon::camera_from(glm_from(frustum.modelViewMatrix), clip_from_view, gnomon::kOpenGl, columns, kRows);
  if (from.error != gnomon::CameraError::none || !light.directionalLight) return false;  // no shadow
  plan_ = gnomon::make_plan(
      from.camera, gnomon::DirectionalLight{{light.lightDir.x(), light.lightDir.y(), light.lightDir.z()}},
      {boxes_, boxes_}, options_);
  if (plan_.maps().empty()) return false;
  view.makeIdentity();
  projection = osg_from(plan_.map[0].clip_from_world);
  return true;
}

void GnomonShadowMap::cullShadowCastingScene(osgUtil::CullVisitor* visitor, osg::Camera* camera) const {
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  ViewDependentShadowMap::cullShadowCastingScene(visitor, camera);
}

}  // namespace sample
