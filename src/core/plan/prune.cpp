// The rules by name.
#include "gnomon/prune.hpp"

#include <array>

namespace gnomon {
namespace {

constexpr std::array<PruneRuleInfo, kPruneRuleCount> kRules{{
#define GNOMON_PRUNE_RULE(name, certainty, what, premise, proof) \
  {PruneRule::name, #name, PruneCertainty::certainty, what, premise, proof},
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
}};

}  // namespace

std::span<const PruneRuleInfo, kPruneRuleCount> prune_rules() noexcept {
  return kRules;
}

bool parse_prune_rules(std::string_view text, PruneRules& rules) noexcept {
  struct Named {
    std::string_view name;
    PruneRules rules;
  };
  constexpr Named kSets[] = {{"default", default_prune_rules()},
                             {"all", PruneRules::all()},
                             {"none", kPruneNothing},
                             {"exact", exact_prune_rules()}};
  for (const Named& set : kSets) {
    if (set.name != text) continue;
    rules = set.rules;
    return true;
  }
  PruneRules read = kPruneNothing;
  for (bool last = false; !last;) {
    const std::size_t comma = text.find(',');
    last = comma == std::string_view::npos;
    const std::string_view name = text.substr(0, comma);
    bool known = false;
    for (const PruneRuleInfo& info : kRules) {
      if (info.name != name) continue;
      read = read.with(info.rule);
      known = true;
    }
    if (!known) return false;
    if (!last) text.remove_prefix(comma + 1);
  }
  rules = read;
  return true;
}

}  // namespace gnomon
