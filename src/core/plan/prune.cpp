// The rules by name.
#include "gnomon/options.hpp"

#include <array>

namespace gnomon {
namespace {

constexpr std::array<PruneRuleInfo, kPruneRuleCount> kRules{{
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) \
  {PruneRule::name, #name, PruneCertainty::certainty, PruneSource::source, what, premise, proof},
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
}};

}  // namespace

std::span<const PruneRuleInfo, kPruneRuleCount> prune_rules() noexcept {
  return kRules;
}

PruneRules prune_rules_of(PruneSource source) noexcept {
  PruneRules rules = kPruneNothing;
  for (const PruneRuleInfo& info : kRules) {
    if (info.source == source) rules = rules.with(info.rule);
  }
  return rules;
}

const PruneRuleInfo* find_prune_rule(std::string_view name) noexcept {
  for (const PruneRuleInfo& info : kRules) {
    if (info.name == name) return &info;
  }
  return nullptr;
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
    const PruneRuleInfo* const info = find_prune_rule(name);
    if (info == nullptr) return false;
    read = read.with(info->rule);
    if (!last) text.remove_prefix(comma + 1);
  }
  rules = read;
  return true;
}

}  // namespace gnomon
