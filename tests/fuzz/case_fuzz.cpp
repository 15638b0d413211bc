// Does any text, taken for a case, become a plan of finite numbers or a refusal of one line?
#include <cmath>
#include <vector>

#include "fuzz.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "plan_promises.hpp"

namespace {

/// Every size a power of two, every place inside the pool, every number finite.
void check_lights(const gnomon::Case& in) {
  std::vector<std::byte> memory(gnomon::light_memory(in.lights.size(), in.seen.size()));
  gnomon::LightOptions options = in.light_options;
  options.plan = in.options;
  const gnomon::LightPlan plan = gnomon::plan_lights({.camera = in.camera, .points_world = in.seen},
                                                     in.lights, in.bounds(), options, memory);
  if (plan.status == gnomon::PlanStatus::invalid_input)
    gnomon::fuzz::require_one_line(gnomon::invalid_input_text(plan.invalid_field));
  for (const gnomon::LightMaps& light : plan.lights) {
    gnomon::fuzz::require(std::isfinite(light.m) && light.share >= 0.0 && light.share <= 1.0,
                          "share or error");
    gnomon::fuzz::require((light.size & (light.size - 1)) == 0, "size");
    for (int k = 0; k < light.map_count; ++k) {
      const gnomon::TexelRect& r = light.place[static_cast<std::size_t>(k)];
      gnomon::fuzz::require(
          r.x >= 0 && r.y >= 0 && r.x + light.size <= plan.pool_width && r.y + light.size <= plan.pool_height,
          "place");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const gnomon::Case in = gnomon::read_case(gnomon::fuzz::as_text(data, size));
    const gnomon::ShadowPlan plan = gnomon::make_plan(in.camera, in.light, in.bounds(), in.options);
    gnomon::fuzz::check_plan(plan, in.options);
    if (plan.status == gnomon::PlanStatus::invalid_input)
      gnomon::fuzz::require_one_line(gnomon::invalid_input_text(plan.invalid_field));
    if (!in.lights.empty()) check_lights(in);
  } catch (const gnomon::CaseError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
