// Makes a case that fails as small as it can be and still fail.
// Based on: Zeller, Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", 2002 (removing ever
// smaller runs of a list).
#include "shrink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace gnomon::stress {
namespace {

using Json = nlohmann::ordered_json;

class Shrinker {
 public:
  Shrinker(const Json& value, const std::function<bool(const Json&)>& fails, int most_tries)
      : best_(value), fails_(fails), left_(most_tries) {}

  Json run() {
    for (bool smaller = true; smaller && left_ > 0;) {
      smaller = false;
      for (const char* list : {"casters", "receivers", "objects", "lights"})
        smaller = drop_boxes(list) || smaller;
      for (const char* keys : {"/options", "/frame"})
        smaller = drop_keys(Json::json_pointer(keys)) || smaller;
      smaller = round_numbers() || smaller;
    }
    return best_;
  }

 private:
  bool take(const Json& candidate) {
    if (left_-- <= 0 || candidate == best_ || !fails_(candidate)) return false;
    best_ = candidate;
    return true;
  }

  /// Half of the boxes at once, then ever fewer.
  bool drop_boxes(const char* name) {
    bool smaller = false;
    if (!best_.contains(name) || !best_[name].is_array()) return false;
    for (std::size_t run = std::max<std::size_t>(best_[name].size() / 2, 1); run >= 1; run /= 2) {
      for (std::size_t begin = 0; begin < best_[name].size() && best_[name].size() > 1 && left_ > 0;) {
        Json candidate = best_;
        auto& boxes = candidate[name];
        const std::size_t end = std::min(begin + run, boxes.size());
        if (end - begin == boxes.size()) break;
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(begin),
                    boxes.begin() + static_cast<std::ptrdiff_t>(end));
        if (take(candidate))
          smaller = true;
        else
          begin += run;
      }
    }
    return smaller;
  }

  bool drop_keys(const Json::json_pointer& at) {
    bool smaller = false;
    if (!best_.contains(at)) return false;
    std::vector<std::string> keys;
    for (const auto& entry : best_[at].items()) keys.push_back(entry.key());
    for (const std::string& key : keys) {
      Json candidate = best_;
      candidate[at].erase(key);
      if (key == "given_splits" || key == "split") {  // one without the other is no case
        candidate[at].erase("split");
        candidate[at].erase("given_splits");
      }
      if (take(candidate)) {
        smaller = true;
      } else if (best_[at].contains(key) && best_[at][key].is_object() && key != "focus") {
        smaller = drop_keys(at / key) || smaller;
      }
    }
    return smaller;
  }

  static double rounded(double value, int digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    return std::strtod(text, nullptr);
  }

  void list_numbers(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& out) {
    if (value.is_number()) out.push_back(at);
    if (value.is_object()) {
      for (const auto& entry : value.items()) list_numbers(entry.value(), at / entry.key(), out);
    }
    if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) list_numbers(value[i], at / i, out);
    }
  }

  /// 0, 1, then as few digits as will do.
  bool round_numbers() {
    std::vector<Json::json_pointer> numbers;
    list_numbers(best_, Json::json_pointer(), numbers);
    // Of thousands of boxes rounding is not what matters.
    constexpr std::size_t kMaxNumbers = 120;
    if (numbers.size() > kMaxNumbers) return false;
    bool smaller = false;
    for (const auto& at : numbers) {
      const double value = best_[at].get<double>();
      if (value == 0.0 || value == 1.0) continue;
      const bool whole = best_[at].is_number_integer();
      std::vector<double> tries{0.0, 1.0};
      for (const int digits : {1, 2, 4, 8}) tries.push_back(rounded(value, digits));
      for (const double simple : tries) {
        if (simple == value) break;  // as simple as it gets
        Json candidate = best_;
        if (whole)
          candidate[at] = static_cast<std::int64_t>(simple);
        else
          candidate[at] = simple;
        if (take(candidate)) {
          smaller = true;
          break;
        }
      }
    }
    return smaller;
  }

  Json best_;
  const std::function<bool(const Json&)>& fails_;
  int left_;
};

}  // namespace

Json shrink_case(const Json& value, const std::function<bool(const Json&)>& fails, int most_tries) {
  return Shrinker(value, fails, most_tries).run();
}

}  // namespace gnomon::stress
