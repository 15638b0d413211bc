// From OGRE's camera to a plan, and from a plan to OGRE's shadow cameras.
#include "gnomon_setup.hpp"

namespace sample {

glm::dmat4 glm_from(const Ogre::Matrix4& m) {
  glm::dmat4 result(0.0);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result[column][row] = static_cast<double>(m[static_cast<std::size_t>(row)][column]);
  return result;
}

Ogre::Matrix4 ogre_from(const glm::mat4& m) {
  Ogre::Matrix4 result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result[static_cast<std::size_t>(row)][column] = m[column][row];
  return result;
}

glm::dvec3 glm_from(const Ogre::Vector3& v) {
  return {v.x, v.y, v.z};
}

Ogre::Vector3 ogre_from(const glm::dvec3& v) {
  return {static_cast<Ogre::Real>(v.x), static_cast<Ogre::Real>(v.y), static_cast<Ogre::Real>(v.z)};
}

void GnomonSetup::getShadowCamera(const Ogre::SceneManager*, const Ogre::Camera* viewer,
                                  const Ogre::Viewport* viewport, const Ogre::Light* light,
                                  Ogre::Camera* texture_camera, std::size_t iteration) const {
  if (iteration == 0) {
    // OGRE keeps projections in OpenGL's clip space, whatever the render system.
    const gnomon::CameraFrom from = gnomon::camera_from(
        glm_from(Ogre::Matrix4(viewer->getViewMatrix(true))), glm_from(viewer->getProjectionMatrix()),
        gnomon::kOpenGl, viewport->getActualWidth(), viewport->getActualHeight());
    if (from.error != gnomon::CameraError::none || light->getType() != Ogre::Light::LT_DIRECTIONAL)
      OGRE_EXCEPT(Ogre::Exception::ERR_INVALIDPARAMS,
                  from.error == gnomon::CameraError::none ? "only directional lights are planned for"
                                                          : std::string(gnomon::to_string(from.error)),
                  "GnomonSetup::getShadowCamera");
    plan_ = gnomon::make_plan(from.camera, gnomon::DirectionalLight{glm_from(light->getDerivedDirection())},
                              {boxes_, boxes_}, options_);
  }
  // A texture beyond the plan's maps sees nothing: all of the world is behind its far plane.
  glm::mat4 clip_from_world(0.0f);
  clip_from_world[3] = {0.0f, 0.0f, 2.0f, 1.0f};
  if (iteration < plan_.maps().size()) clip_from_world = glm::mat4(plan_.map[iteration].clip_from_world);
  texture_camera->setCustomViewMatrix(true, Ogre::Affine3::IDENTITY);
  texture_camera->setCustomProjectionMatrix(true, ogre_from(clip_from_world));
}

}  // namespace sample
