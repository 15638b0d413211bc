// Which names have warps, shapes, splits and other choices? The lists of the core, by index.
#include <cstring>
#include <iterator>

#include "c/convert.hpp"
#include "gnomon/version.hpp"

static_assert(GNOMON_C_ABI_VERSION == 0);

namespace gnomon::c {
namespace {

struct Entry {
  const char* name = nullptr;  // nullptr: none
  const char* summary = "";
};

// The core's names and summaries are whole literals, so that their data ends in a zero; a test holds them to
// it.
template <typename List>
Entry entry_of(const List& list, std::size_t index) noexcept {
  if (index >= list.size()) return {};
  return {list[index]->name.data(), list[index]->summary.data()};
}
template <typename Enum>
Entry enumerator(Enum last, std::size_t index) noexcept {
  if (index > static_cast<std::size_t>(last)) return {};
  return {to_string(static_cast<Enum>(index)).data(), ""};
}

// Not by prune_rules(): its premises and proofs would go into every web page.
Entry prune_rule(std::size_t index) noexcept {
  constexpr Entry kRules[] = {
#define GNOMON_PRUNE_RULE(name, certainty, source, what, premise, proof) {#name, what},
#include "gnomon/prune_rules.def"
#undef GNOMON_PRUNE_RULE
  };
  return index < std::size(kRules) ? kRules[index] : Entry{};
}

Entry status(std::size_t index) noexcept {
  if (index == GNOMON_OUT_OF_MEMORY) return {"out_of_memory", ""};
  return enumerator(PlanStatus::invalid_input, index);
}

Entry entry(std::int32_t list, std::int32_t at) noexcept {
  if (at < 0) return {};
  const auto index = static_cast<std::size_t>(at);
  switch (list) {
    case GNOMON_WARPS:
      return entry_of(all_warps(), index);
    case GNOMON_SHAPES:
      return entry_of(all_shapes(), index);
    case GNOMON_FITS:
      return enumerator(Fit::warped_stable, index);
    case GNOMON_SPLITS:
      return enumerator(SplitScheme::given, index);
    case GNOMON_PARTITIONS:
      return enumerator(Partition::receiver_clusters, index);
    case GNOMON_SELECTIONS:
      return enumerator(MapSelection::finest, index);
    case GNOMON_OBJECTIVES:
      return enumerator(Objective::picture, index);
    case GNOMON_PRUNE_RULES:
      return prune_rule(index);
    case GNOMON_PAGE_POLICIES:
      return entry_of(all_page_policies(), index);
    case GNOMON_STATUSES:
      return status(index);
    default:
      return {};
  }
}

}  // namespace
}  // namespace gnomon::c

extern "C" {

int32_t gnomon_count(int32_t list) {
  int32_t count = 0;
  while (gnomon::c::entry(list, count).name != nullptr) ++count;
  return count;
}

const char* gnomon_name(int32_t list, int32_t index) {
  return gnomon::c::entry(list, index).name;
}

const char* gnomon_summary(int32_t list, int32_t index) {
  const gnomon::c::Entry found = gnomon::c::entry(list, index);
  return found.name != nullptr ? found.summary : nullptr;
}

int32_t gnomon_find(int32_t list, const char* name) {
  if (name == nullptr) return GNOMON_UNKNOWN;
  for (int32_t i = 0;; ++i) {
    const char* known = gnomon::c::entry(list, i).name;
    if (known == nullptr) return GNOMON_UNKNOWN;
    if (std::strcmp(known, name) == 0) return i;
  }
}

const char* gnomon_version(void) {
  return gnomon::kVersion.data();
}

}  // extern "C"
