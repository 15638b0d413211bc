// Does any text, taken for a case, become a plan of finite numbers or a refusal of one line?
#include "fuzz.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "plan_promises.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const gnomon::Case in = gnomon::read_case(gnomon::fuzz::as_text(data, size));
    const gnomon::ShadowPlan plan = gnomon::make_plan(in.camera, in.light, in.bounds(), in.options);
    gnomon::fuzz::check_plan(plan, in.options);
    if (plan.status == gnomon::PlanStatus::invalid_input)
      gnomon::fuzz::require_one_line(gnomon::invalid_input_text(plan.invalid_field));
  } catch (const gnomon::CaseError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
