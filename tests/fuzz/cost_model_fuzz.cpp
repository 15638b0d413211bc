// Does any text, taken for a cost model, become finite costs that are not below zero, written as they were
// read, or a refusal of one line?
#include <cmath>

#include "fuzz.hpp"
#include "rows/cost_model_text.hpp"

namespace {

using gnomon::fuzz::require;

void require_cost(double value) {
  require(std::isfinite(value) && value >= 0.0, "a cost is a number, and not below zero");
}

void check(const gnomon::report::StoredCostModel& model) {
  const gnomon::DrawingCosts& d = model.drawing;
  for (const double cost :
       {d.per_frame, d.per_map, d.per_megatexel, d.per_kilodraw, d.per_megatriangle, d.per_megatexel_covered,
        d.per_megatexel_tested, model.depth_error, model.prefilter_error, model.lookup_error})
    require_cost(cost);
  std::vector<gnomon::FilterCost> costs;
  const gnomon::CostModel view = model.view(costs);
  for (const gnomon::report::StoredCostModel::Filter& filter : model.filters)
    for (const char c : filter.name) require(static_cast<unsigned char>(c) >= 0x20, "names are printable");
  require(view.filters.size() == model.filters.size(), "as many filters as in the file");
  for (const gnomon::FilterCost& c : costs)
    for (const double cost :
         {c.prefilter_ms_per_map, c.prefilter_ms_per_megatexel, c.lookup_ms_per_megapixel, c.bytes_per_texel,
          c.error_ratio, c.error_power, c.kernel_texels, c.extent.texels, c.extent.world})
      require_cost(cost);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using gnomon::report::cost_model_from_text;
  try {
    const gnomon::report::StoredCostModel model =
        cost_model_from_text(gnomon::fuzz::as_text(data, size), "fuzz");
    check(model);
    const std::string text = to_text(model);
    require(to_text(cost_model_from_text(text, "again")) == text, "a model is read as it was written");
  } catch (const gnomon::report::ReportError& refusal) {
    gnomon::fuzz::require_one_line(refusal.what());
  }
  return 0;
}
