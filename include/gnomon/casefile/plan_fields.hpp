// The options of a plan as files and command lines name them: one table of key, place in PlanOptions, range
// and words.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gnomon/plan.hpp"

namespace gnomon {

/// Where a field lies in PlanOptions.
template <class Value>
using PlanMember = Value& (*)(PlanOptions& options);

/// A field whose value is one of several names.
struct PlanChoice {
  /// All names, in the order in which help lists them.
  std::vector<std::string> (*names)();
  /// False, and the options as they were, for a name that is unknown.
  bool (*set)(std::string_view name, PlanOptions& options);
  /// The name of the present value.
  std::string (*get)(const PlanOptions& options);
};

/// SplitOptions::given.
using SplitDepths = std::array<double, kMaxMaps - 1>;

/// WarpOptions::planes.
using WarpPlanes = std::array<WarpPlane, kMaxWarpPlanes>;

/// One key of "options" in a case file.
struct PlanField {
  std::string_view key;      ///< also of the command line, where it is --key with dashes
  std::string_view summary;  ///< half a line for help
  /// Place, and by it the type of the value. SplitDepths reads a list of numbers, WarpPlanes
  /// a list of planes.
  std::variant<PlanMember<bool>, PlanMember<int>, PlanMember<std::int64_t>, PlanMember<double>, PlanChoice,
               PlanMember<Box>, PlanMember<BiasOptions>, PlanMember<ClipSpace>, PlanMember<SplitDepths>,
               PlanMember<WarpPlanes>>
      place;
  /// Its name in ShadowPlan::invalid_field, and the values that it may have; empty where no value is refused.
  std::string_view invalid_field = {}, must = {};
  double least = 0.0, most = 0.0;  ///< of numbers that a command line may check by itself; equal: not there
  double unit = 1.0;  ///< of numbers: the option's value is the file's times this, as angles are in degrees
};

/// All of them, in the order in which they are applied.
[[nodiscard]] std::span<const PlanField> plan_fields();
/// The field of a key; throws std::out_of_range where there is none.
[[nodiscard]] const PlanField& plan_field(std::string_view key);

}  // namespace gnomon
