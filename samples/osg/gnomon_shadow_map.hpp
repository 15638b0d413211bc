// gnomon as a shadow technique of OpenSceneGraph 3.6: the matrix of a plan for the camera that it draws with.
#pragma once

#include <osgShadow/ViewDependentShadowMap>

#include <vector>

#include "gnomon/gnomon.hpp"

namespace sample {

class GnomonShadowMap : public osgShadow::ViewDependentShadowMap {
 public:
  /// `boxes`: of what casts and receives shadows. An engine would keep them up to date. `options`: one map.
  GnomonShadowMap(std::vector<gnomon::Box> boxes, const gnomon::PlanOptions& options)
      : boxes_(std::move(boxes)), options_(options) {}

  /// OpenSceneGraph calls it once a frame for each light that casts shadows.
  bool computeShadowCameraSettings(Frustum& frustum, LightData& light, osg::Matrixd& projection,
                                   osg::Matrixd& view) override;
  /// Keeps the plan's near and far plane, which the base would move, and what is drawn between them.
  void cullShadowCastingScene(osgUtil::CullVisitor* visitor, osg::Camera* camera) const override;

  /// The last frame's plan. The receivers' shader takes its bias.
  [[nodiscard]] const gnomon::ShadowPlan& plan() const { return plan_; }

 private:
  std::vector<gnomon::Box> boxes_;
  gnomon::PlanOptions options_;
  gnomon::ShadowPlan plan_;
};

/// OpenSceneGraph's matrices as GLM's, and the other way: it multiplies rows from the left, in double as
/// well.
[[nodiscard]] glm::dmat4 glm_from(const osg::Matrixd& m);
[[nodiscard]] osg::Matrixd osg_from(const glm::dmat4& m);

}  // namespace sample
