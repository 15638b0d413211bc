// gnomon as a ShadowCameraSetup of OGRE 1.12: the matrices of a plan for the camera that OGRE draws with.
#pragma once

#include <Ogre.h>

#include <vector>

#include "gnomon/gnomon.hpp"

namespace sample {

class GnomonSetup : public Ogre::ShadowCameraSetup {
 public:
  /// `boxes`: of the objects that cast and receive shadows. An engine would keep them up to date.
  GnomonSetup(std::vector<gnomon::Box> boxes, const gnomon::PlanOptions& options)
      : boxes_(std::move(boxes)), options_(options) {}

  /// OGRE calls it once for each shadow texture, in order. The first call makes the plan.
  void getShadowCamera(const Ogre::SceneManager* scene, const Ogre::Camera* viewer,
                       const Ogre::Viewport* viewport, const Ogre::Light* light, Ogre::Camera* texture_camera,
                       std::size_t iteration) const override;

  /// The last frame's plan. Shaders select by its view depths, and take its biases.
  [[nodiscard]] const gnomon::ShadowPlan& plan() const { return plan_; }

 private:
  std::vector<gnomon::Box> boxes_;
  gnomon::PlanOptions options_;
  mutable gnomon::ShadowPlan plan_;
};

/// OGRE's matrices and vectors as GLM's, and the other way. OGRE counts rows first.
[[nodiscard]] glm::dmat4 glm_from(const Ogre::Matrix4& m);
[[nodiscard]] Ogre::Matrix4 ogre_from(const glm::mat4& m);
[[nodiscard]] glm::dvec3 glm_from(const Ogre::Vector3& v);
[[nodiscard]] Ogre::Vector3 ogre_from(const glm::dvec3& v);

}  // namespace sample
