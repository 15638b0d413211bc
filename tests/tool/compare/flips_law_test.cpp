// Does a stable map's shadow stand still while the camera moves, pixel by pixel and exactly?
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gnomon/render/renderer.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "moved_eye.hpp"
#include "render/shared_context.hpp"

namespace gnomon::tool {
namespace {

/// Flips of one step along a scene's flight, as `gnomon compare` measures them.
class Steps {
 public:
  Steps(const std::string& scene, const render::Filter& filter)
      : scene_(load_builtin(scene)), tracer_(scene_), renderer_(scene_), filter_(renderer_.prepare(filter)) {
    for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
    options_.cascades = 1;
    options_.resolution.max_size = 512;
    render::set_margin(render::default_settings(filter), options_);
    before_ = default_path(scene_).at(0.4, 160, 90);
  }

  [[nodiscard]] double flips(Fit fit, const glm::dvec3& step) {
    options_.fit = fit;
    Camera after = before_;
    after.position += step;
    const std::vector<float> old_mask = mask(moved_eye(plan(before_), before_, after), after);
    const std::vector<float> new_mask = mask(plan(after), after);
    const trace::SurfacePoints points =
        trace::surface_points(tracer_, after, light_, renderer_.positions(), renderer_.normals());
    std::vector<float> truth;
    for (const trace::Verdict verdict : trace::hard_reference(tracer_, points, light_).pixels) {
      const bool judged = verdict == trace::Verdict::lit || verdict == trace::Verdict::shadow;
      truth.push_back(judged ? (verdict == trace::Verdict::lit ? 1.0f : 0.0f) : -1.0f);
    }
    EXPECT_GT(std::count(truth.begin(), truth.end(), 0.0f), 20);
    return report::excess_flips(old_mask, new_mask, truth, truth);
  }

 private:
  [[nodiscard]] ShadowPlan plan(const Camera& camera) const {
    return make_plan(camera, light_, {boxes_, boxes_}, options_);
  }
  [[nodiscard]] std::vector<float> mask(const ShadowPlan& plan, const Camera& camera) {
    renderer_.draw(plan, camera, filter_);
    const FloatImage image = renderer_.mask();
    std::vector<float> values;
    for (std::size_t i = 0; i < image.values.size(); i += 2) values.push_back(image.values[i]);
    return values;
  }

  Scene scene_;
  trace::Tracer tracer_;
  render::Renderer renderer_;
  render::PreparedFilter filter_;
  std::vector<Box> boxes_;
  PlanOptions options_;
  Camera before_;
  Light light_ = DirectionalLight{{-0.5, -0.6, 0.4}};
};

TEST(FlipsLaw, stable_maps_do_not_flip_at_all_under_translation) {
  (void)render::shared_context();
  for (const char* scene : {"fence", "city"}) {
    Steps steps(scene, render::filters::hard);
    for (const glm::dvec3& step : {glm::dvec3(0.0), glm::dvec3(0.003, 0.0, 0.001),
                                   glm::dvec3(0.05, 0.01, -0.08), glm::dvec3(0.4, -0.1, 0.3)}) {
      EXPECT_EQ(steps.flips(Fit::stable, step), 0.0) << scene << " step " << glm::length(step);
    }
  }
}

TEST(FlipsLaw, tight_maps_do) {
  (void)render::shared_context();
  Steps steps("fence", render::filters::hard);
  EXPECT_GT(steps.flips(Fit::tight, {0.05, 0.01, -0.08}), 0.001);
  EXPECT_EQ(steps.flips(Fit::tight, {0.0, 0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace gnomon::tool
