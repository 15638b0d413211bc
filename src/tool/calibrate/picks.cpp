// How good are the planner's picks? They are held against what a sweep measured of all techniques.
#include "picks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>

namespace gnomon::tool {
namespace {

double beyond_front(const PricedTechnique& pick, std::span<const PricedTechnique> all,
                    double PricedTechnique::*cost) noexcept {
  double most = 1.0;
  for (const PricedTechnique& other : all)
    most = std::max(most, std::min(pick.*cost / other.*cost, pick.error / other.error));
  return most;
}

void add(const PricedTechnique& priced, double weight, PricedTechnique& sum) noexcept {
  sum.ms += weight * priced.ms;
  sum.model_ms += weight * priced.model_ms;
  sum.error += weight * priced.error;
}

/// What was measured of a row; the model's time is not known yet.
PricedTechnique measured(const report::Row& row) noexcept {
  // A technique without a wrong pixel is not infinitely better than one with a single one.
  const double least = 0.5 / static_cast<double>(std::max<std::uint64_t>(row.errors.pixels, 1));
  return {row.times.total_ms.median, 0.0, std::max(wrong_pixels(row), least)};
}

std::size_t row_of(const View& frame, const report::Technique& technique) {
  const auto row = std::find_if(frame.rows.begin(), frame.rows.end(),
                                [&](const report::Row& r) { return r.technique == technique; });
  if (row == frame.rows.end())
    throw std::runtime_error(frame.name + ": " + technique.name() + " was not measured, as in other frames");
  return static_cast<std::size_t>(row - frame.rows.begin());
}

/// One frame: its techniques with their prices, and what the planner picks of them.
class PickedFrame {
 public:
  PickedFrame(const View& view, const report::StoredCostModel& model) : view_(view), replanned_(view) {
    std::set<std::string> filters, page_filters;
    for (const report::Row& row : view.rows) {
      (row.technique.pages.empty() ? filters : page_filters).insert(row.technique.filter);
      priced_.push_back(measured(row));
      priced_.back().model_ms = report::predicted_ms(model, replanned_.observe(row));
    }
    known_ = model;
    const auto keep = [&](const char* what, const std::set<std::string>& measured,
                          report::StoredCosts& costs) {
      std::erase_if(costs.filters, [&](const auto& filter) { return !measured.contains(filter.name); });
      if (costs.filters.empty() && !measured.empty())
        throw std::runtime_error(std::string("the cost model knows none of the ") + what + " of " +
                                 view.name);
    };
    keep("filters", filters, known_);
    keep("filters of pages", page_filters, known_.pages);
  }

  /// In the order of the rows.
  [[nodiscard]] const std::vector<PricedTechnique>& priced() const noexcept { return priced_; }

  /// A row, and what the planner expects of it.
  struct Picked {
    std::size_t row;
    double expected;
    std::int64_t texels;
  };
  /// None where there is nothing to choose: no maps.
  [[nodiscard]] std::optional<Picked> pick(const Budget& request) const {
    const Replanned::Choice choice = replanned_.choose(view_, request, known_);
    if (choice.status != PlanStatus::ok) return std::nullopt;
    const auto row = std::find_if(view_.rows.begin(), view_.rows.end(),
                                  [&](const report::Row& r) { return r.technique == choice.technique; });
    if (row == view_.rows.end())
      throw std::runtime_error(view_.name + ": the sweep is no full product, the pick was not measured");
    return Picked{static_cast<std::size_t>(row - view_.rows.begin()), choice.error, choice.texels};
  }

 private:
  const View& view_;
  Replanned replanned_;
  std::vector<PricedTechnique> priced_;
  report::StoredCostModel known_;  ///< of the filters that were measured
};

/// One request along a flight.
struct FlightRequest {
  Budget request;
  const report::Technique *first, *hardest, *now;  ///< picked; nullptr: nothing to choose yet
  double hardness;                                 ///< of the hardest
  PricedTechnique renewed;                         ///< mean of each frame's pick

  void add(const report::Technique& technique, const PickedFrame::Picked& picked) noexcept {
    now = &technique;
    if (first == nullptr) first = now;
    const double hard = request.target_error > 0.0 ? static_cast<double>(picked.texels) : picked.expected;
    if (hardest != nullptr && hard <= hardness) return;
    hardest = now;
    hardness = hard;
  }
};

}  // namespace

Score score_of(const PricedTechnique& pick, std::span<const PricedTechnique> all,
               const Budget& request) noexcept {
  Score result{pick, beyond_front(pick, all, &PricedTechnique::ms),
               beyond_front(pick, all, &PricedTechnique::model_ms)};
  // What is limited, and what should be least.
  const bool by_time = request.milliseconds > 0.0;
  const auto limited = by_time ? &PricedTechnique::ms : &PricedTechnique::error;
  const auto wanted = by_time ? &PricedTechnique::error : &PricedTechnique::ms;
  const double limit = by_time ? request.milliseconds : request.target_error;
  double least = std::numeric_limits<double>::infinity();
  for (const PricedTechnique& other : all)
    if (other.*limited <= limit) least = std::min(least, other.*wanted);
  result.over_request = std::max(pick.*limited / limit, 1.0);
  result.off_request = std::max(result.over_request, pick.*wanted / least);
  return result;
}

std::vector<Budget> requests_between(std::span<const PricedTechnique> all) {
  PricedTechnique least = all.front(), most = all.front();
  for (const PricedTechnique& one : all) {
    least = {std::min(least.ms, one.ms), 0.0, std::min(least.error, one.error)};
    most = {std::max(most.ms, one.ms), 0.0, std::max(most.error, one.error)};
  }
  std::vector<Budget> requests;
  for (const double share : {0.25, 0.5, 0.75}) {
    Budget by_time, by_error;
    by_time.milliseconds = least.ms * std::pow(most.ms / least.ms, share);
    by_error.target_error = least.error * std::pow(most.error / least.error, share);
    requests.push_back(by_time);
    requests.push_back(by_error);
  }
  return requests;
}

FlightPicks picks_of(const std::vector<const View*>& frames, const report::StoredCostModel& model) {
  const View& first = *frames.front();
  const double weight = 1.0 / static_cast<double>(frames.size());
  std::vector<PricedTechnique> mean(first.rows.size());  // in the order of the first frame's rows
  for (const View* const frame : frames) {
    for (std::size_t i = 0; i < mean.size(); ++i)
      add(measured(frame->rows[row_of(*frame, first.rows[i].technique)]), weight, mean[i]);
  }
  std::vector<FlightRequest> asked;
  for (const Budget& request : requests_between(mean))
    asked.push_back({request, nullptr, nullptr, nullptr, 0.0, {}});

  FlightPicks picks;
  for (const View* const frame : frames) {
    const PickedFrame picked(*frame, model);
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i].model_ms += weight * picked.priced()[row_of(*frame, first.rows[i].technique)].model_ms;
    for (const PricedTechnique& one : picked.priced()) {
      const Score alone = score_of(one, picked.priced(), asked.front().request);
      ++picks.techniques;
      picks.on_front += alone.beyond_front <= kHit ? 1 : 0;
      picks.on_front_by_model += alone.beyond_front_by_model <= kHit ? 1 : 0;
    }
    for (FlightRequest& a : asked) {
      if (const auto pick = picked.pick(a.request)) {
        a.add(frame->rows[pick->row].technique, *pick);
        picks.of_frames.push_back({frame->name, a.request, a.now->name(), pick->expected,
                                   score_of(picked.priced()[pick->row], picked.priced(), a.request)});
      }
      // A frame without maps has nothing to choose: what was picked before stays, and all cost the same.
      add(picked.priced()[a.now == nullptr ? 0 : row_of(*frame, *a.now)], weight, a.renewed);
    }
  }
  if (frames.size() == 1) return picks;
  for (const FlightRequest& a : asked) {
    if (a.first == nullptr) continue;
    const auto kept = [&](const report::Technique& technique) {
      return Pick{first.flight, a.request, technique.name(), std::nullopt,
                  score_of(mean[row_of(first, technique)], mean, a.request)};
    };
    picks.first_kept.push_back(kept(*a.first));
    picks.hardest_kept.push_back(kept(*a.hardest));
    picks.renewed.push_back(
        {first.flight, a.request, {}, std::nullopt, score_of(a.renewed, mean, a.request)});
  }
  return picks;
}

}  // namespace gnomon::tool
