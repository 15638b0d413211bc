// Which promises were broken how often, and the smallest input that breaks each.
#include "failures.hpp"

#include <algorithm>
#include <sstream>

#include "shrink.hpp"

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

const Finding* find(const std::vector<Finding>& findings, std::string_view kind) {
  const auto found =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.kind == kind; });
  return found == findings.end() ? nullptr : &*found;
}

}  // namespace

Failures::Failures(const std::vector<Kind>& kinds) {
  for (const Kind& kind : kinds) kinds_.push_back({kind.name, 0, 0, 0.0, 0, {}, {}});
}

void Failures::add(const std::vector<Finding>& findings, std::uint64_t number, const Json& value) {
  for (KindFound& kind : kinds_) {
    const Finding* f = find(findings, kind.kind);
    if (f == nullptr) continue;
    if (kind.cases++ == 0) {
      kind.first = number;
      kind.text = f->text;
      kind.case_file = value.dump(1) + "\n";
    }
    if (!(f->amount <= kind.worst)) {
      kind.worst = f->amount;
      kind.worst_case = number;
    }
  }
}

void Failures::shrink(const std::function<std::vector<Finding>(const Json&)>& check, int most_tries) {
  for (KindFound& kind : kinds_) {
    if (kind.cases == 0) continue;
    // What is no case any more does not fail in the same way.
    const auto fails = [&](const Json& value) {
      try {
        return find(check(value), kind.kind) != nullptr;
      } catch (const CaseError&) {
        return false;
      }
    };
    const Json small = shrink_case(Json::parse(kind.case_file), fails, most_tries);
    kind.case_file = small.dump(1) + "\n";
    const std::vector<Finding> findings = check(small);
    if (const Finding* f = find(findings, kind.kind)) kind.text = f->text;
  }
}

std::vector<KindFound> Failures::found() const {
  std::vector<KindFound> all;
  std::copy_if(kinds_.begin(), kinds_.end(), std::back_inserter(all),
               [](const KindFound& k) { return k.cases > 0; });
  return all;
}

std::string failure_lines(const std::vector<KindFound>& found) {
  std::ostringstream text;
  for (const KindFound& k : found)
    text << "fails: " << k.kind << ": " << k.cases << " cases, first " << k.first << ", worst " << k.worst
         << " (case " << k.worst_case << "): " << k.text << '\n';
  return text.str();
}

}  // namespace gnomon::stress
