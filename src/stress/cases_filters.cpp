// Extreme cases of what a filter finds in a texel, by its reference in double. Shaders are held to these
// references by the renderer's own tests.
#include "case_list.hpp"

#ifdef GNOMON_STRESS_HAS_FILTERS
#include <limits>
#include <random>

#include "gnomon/render/filter.hpp"

namespace gnomon::stress {

void case_hostile_texels(Check& check) {
  using render::StoredTexel;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const double hard[] = {0.0,  -0.0,  1.0,   -1.0, 0.5,  0.25,   kInf, -kInf,    kNan, 65504.0,
                         3e38, -3e38, 1e-40, 2.0,  1e-7, 1e-300, 1e19, 0.999999, 88.8, -65504.0};
  std::mt19937 random(11);
  long answers = 0;
  for (const render::Filter* filter : render::all_filters()) {
    if (filter->info.reads == render::MapRead::depth) continue;
    render::FilterSettings settings = render::default_settings(*filter);
    for (int i = 0; i < 2000; ++i) {
      StoredTexel texel{};
      for (double& channel : texel) channel = hard[random() % std::size(hard)];
      render::FilterLookup at;
      at.map_depth = [](int, int) { return 1.0; };
      at.depth = static_cast<double>(random() % 5) / 4.0;
      const double answer = filter->reference.visibility(texel, at, settings);
      check.that(answer >= 0.0 && answer <= 1.0, std::string(filter->info.name) + " stays within [0, 1]");
      ++answers;
      if (!check.passed()) return;
    }
  }
  check.note("answers", static_cast<double>(answers));
}

}  // namespace gnomon::stress
#else
namespace gnomon::stress {

void case_hostile_texels(Check& check) {
  check.skip("built without the renderer, and so without filters");
}

}  // namespace gnomon::stress
#endif
