// Which work can a frame omit? Every rule by its name, with its premise and why nothing (or how
// little) is lost. The exact rules are on unless switched off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon {

enum class PruneRule : std::uint8_t {
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) name,
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
};
inline constexpr std::size_t kPruneRuleCount = 0
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) +1
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
    ;

enum class PruneCertainty : std::uint8_t {
  exact,    ///< the shadow mask is the same to the last bit
  bounded,  ///< it may differ, by no more than PruneRuleInfo::proof says
};

enum class PruneSource : std::uint8_t {
  this_frame,  ///< the rule prunes from what this frame alone knows
  last_frame,  ///< the rule reuses what the last frame drew: a frame drawn alone has none of it
};

/// One entry of the registry prune_rules.def.
struct PruneRuleInfo {
  PruneRule rule{};            ///< the rule
  std::string_view name;       ///< as in files and on command lines
  PruneCertainty certainty{};  ///< exact or bounded
  PruneSource source{};        ///< the frame that the rule draws from
  std::string_view what;       ///< the rule omits
  std::string_view premise;    ///< where this does not hold, the rule does nothing
  std::string_view proof;      ///< that no pixel changes; of bounded rules: the bound
};
/// All rules, in the order in which a frame applies them.
[[nodiscard]] std::span<const PruneRuleInfo, kPruneRuleCount> prune_rules() noexcept;

/// Which of them are on.
struct PruneRules {
  static constexpr std::uint32_t kAll =
      (std::uint32_t{1} << kPruneRuleCount) - 1;  ///< every bit that a rule has
  std::uint32_t bits = kAll;                      ///< bit i stands for the rule of value i

  /// Exact and bounded rules.
  [[nodiscard]] static constexpr PruneRules all() noexcept { return {kAll}; }

  /// True where the rule is on.
  [[nodiscard]] constexpr bool has(PruneRule rule) const noexcept {
    return (bits >> static_cast<unsigned>(rule) & 1u) != 0;
  }
  /// These rules and `rule`.
  [[nodiscard]] constexpr PruneRules with(PruneRule rule) const noexcept {
    return {bits | (std::uint32_t{1} << static_cast<unsigned>(rule))};
  }
  /// These rules except `rule`.
  [[nodiscard]] constexpr PruneRules without(PruneRule rule) const noexcept {
    return {bits & ~(std::uint32_t{1} << static_cast<unsigned>(rule))};
  }
  /// The same rules are on.
  bool operator==(const PruneRules&) const = default;
};
inline constexpr PruneRules kPruneNothing{0};
/// The rules that change no bit of the shadow mask.
[[nodiscard]] constexpr PruneRules exact_prune_rules() noexcept {
  PruneRules rules = kPruneNothing;
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) \
  if (PruneCertainty::certainty == PruneCertainty::exact) rules = rules.with(PruneRule::name);
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
  return rules;
}
/// The exact rules, and light_depths: depths fitted to what is there are only stored more finely.
[[nodiscard]] constexpr PruneRules default_prune_rules() noexcept {
  return exact_prune_rules().with(PruneRule::light_depths);
}
/// The rules that draw from this source.
[[nodiscard]] PruneRules prune_rules_of(PruneSource source) noexcept;
/// The rule of this name; nullptr where there is none.
[[nodiscard]] const PruneRuleInfo* find_prune_rule(std::string_view name) noexcept;

/// Reads "default", "all", "none", "exact" or names divided by commas. False, and `rules` unchanged, where a
/// name is unknown.
[[nodiscard]] bool parse_prune_rules(std::string_view text, PruneRules& rules) noexcept;

/// Work that a rule saved in one frame.
struct PruneSaving {
  std::uint64_t texels = 0;     ///< of shadow maps, not drawn
  std::uint64_t triangles = 0;  ///< not drawn into maps
  std::uint64_t instances = 0;  ///< the same
  std::uint64_t maps = 0;       ///< cascades that were omitted, or maps that were not drawn at all
  std::uint64_t filtered = 0;   ///< texels that a filter did not store and blur
};

}  // namespace gnomon
