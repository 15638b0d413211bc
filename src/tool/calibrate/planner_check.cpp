// What the planner predicts and picks, beside what a sweep measured.
#include "planner_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "output.hpp"
#include "picks.hpp"

namespace gnomon::tool {
namespace {

std::string text_of(const Budget& request) {
  return request.milliseconds > 0.0 ? fmt::format("{:.1f} ms", request.milliseconds)
                                    : fmt::format("{:.2f} %", 100.0 * request.target_error);
}

/// Picks that are on the front, and those that meet their request.
class Hits {
 public:
  explicit Hits(const std::vector<Pick>& picks) {
    for (const Pick& pick : picks) {
      const Score& score = pick.score;
      ++picks_;
      by_measured_ += score.beyond_front <= kHit ? 1 : 0;
      by_model_ += score.beyond_front_by_model <= kHit ? 1 : 0;
      met_ += score.over_request <= kHit ? 1 : 0;
      log_off_ += std::log(score.off_request);
    }
  }
  [[nodiscard]] std::string front() const {
    return fmt::format("{} of {} picks by measured times, {} by the model's", by_measured_, picks_,
                       by_model_);
  }
  [[nodiscard]] std::string requests() const {
    return fmt::format("{} of {}; off the best technique for it by a factor of {:.2f}, geometric mean", met_,
                       picks_, std::exp(log_off_ / std::max(picks_, 1)));
  }

 private:
  int picks_ = 0, by_measured_ = 0, by_model_ = 0, met_ = 0;
  double log_off_ = 0.0;
};

nlohmann::json json_of(const Pick& pick) {
  const Score& score = pick.score;
  nlohmann::json json{{"view", pick.view},
                      {"asked", text_of(pick.request)},
                      {"pick", pick.technique},
                      {"predicted_ms", score.priced.model_ms},
                      {"ms", score.priced.ms},
                      {"wrong", score.priced.error},
                      {"beyond_front", score.beyond_front},
                      {"beyond_front_by_model", score.beyond_front_by_model},
                      {"over_request", score.over_request},
                      {"off_request", score.off_request}};
  if (pick.expected) json["expected_wrong"] = *pick.expected;
  return json;
}

nlohmann::json json_of(const std::vector<Pick>& picks) {
  nlohmann::json list = nlohmann::json::array();
  for (const Pick& pick : picks) list.push_back(json_of(pick));
  return list;
}

void print_title(const char* view, const char* pick) {
  print_line(fmt::format(
      "| {} | request | {} | ms, by the model | ms | misclassified pixels, expected | misclassified pixels | "
      "beyond the front | beyond it by the model's ms | off the request |\n"
      "|--|--|--|--:|--:|--:|--:|--:|--:|--:|",
      view, pick));
}

void print(const Pick& pick, const std::string& technique) {
  const Score& score = pick.score;
  const std::string expected = pick.expected ? fmt::format("{:.2f} %", 100.0 * *pick.expected) : "";
  print_line(fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {} | {:.2f} % | {:.2f} | {:.2f} | {:.2f} |",
                         pick.view, text_of(pick.request), technique, score.priced.model_ms, score.priced.ms,
                         expected, 100.0 * score.priced.error, score.beyond_front,
                         score.beyond_front_by_model, score.off_request));
}

void print_flights(const FlightPicks& all) {
  print_line("\nMeans over the frames of each flight:\n");
  print_title("flight", "pick of the first frame, of the hardest, and of each");
  for (std::size_t i = 0; i < all.first_kept.size(); ++i) {
    print(all.first_kept[i], all.first_kept[i].technique);
    print(all.hardest_kept[i], all.hardest_kept[i].technique);
    print(all.renewed[i], "each");
  }
}

void append(const std::vector<Pick>& more, std::vector<Pick>& picks) {
  picks.insert(picks.end(), more.begin(), more.end());
}

std::vector<std::vector<const View*>> flights_of(const std::vector<View>& views) {
  std::vector<std::vector<const View*>> flights;
  for (const View& view : views) {
    const auto known = std::find_if(flights.begin(), flights.end(), [&](const auto& flight) {
      return flight.front()->flight == view.flight;
    });
    if (known == flights.end()) {
      flights.push_back({&view});
    } else {
      known->push_back(&view);
    }
  }
  return flights;
}

void print_summary(const FlightPicks& all) {
  const auto percent = [&](int count) { return 100.0 * count / std::max(all.techniques, 1); };
  const Hits frames(all.of_frames);
  print_line(
      fmt::format("\nwithin 10 % of the front of measured misclassified pixels: {}\n"
                  "of all techniques: {:.0f} % by measured times, {:.0f} % by the model's\n"
                  "requests met within 10 %: {}",
                  frames.front(), percent(all.on_front), percent(all.on_front_by_model), frames.requests()));
  if (all.first_kept.empty()) return;
  const std::pair<const char*, const std::vector<Pick>*> ways[] = {
      {"the first frame's pick", &all.first_kept},
      {"the hardest frame's pick", &all.hardest_kept},
      {"each frame's pick", &all.renewed}};
  for (const auto& [name, picks] : ways) {
    const Hits hits(*picks);
    print_line(
        fmt::format("over whole flights, {}: {}\n    requests met: {}", name, hits.front(), hits.requests()));
  }
}

}  // namespace

int check_planner(const report::StoredCostModel& model, const std::vector<report::Row>& rows, bool json) {
  FlightPicks all;
  if (!json) print_title("view", "pick");
  const std::vector<View> views = views_of(rows);
  for (const std::vector<const View*>& frames : flights_of(views)) {
    const FlightPicks flight = picks_of(frames, model);
    if (!json)
      for (const Pick& pick : flight.of_frames) print(pick, pick.technique);
    append(flight.of_frames, all.of_frames);
    append(flight.first_kept, all.first_kept);
    append(flight.hardest_kept, all.hardest_kept);
    append(flight.renewed, all.renewed);
    all.techniques += flight.techniques;
    all.on_front += flight.on_front;
    all.on_front_by_model += flight.on_front_by_model;
  }
  if (json) {
    print_line(nlohmann::json{{"picks", json_of(all.of_frames)},
                              {"flights_by_first_frame", json_of(all.first_kept)},
                              {"flights_by_hardest_frame", json_of(all.hardest_kept)},
                              {"flights_by_each_frame", json_of(all.renewed)}}
                   .dump());
    return 0;
  }
  if (!all.first_kept.empty()) print_flights(all);
  print_summary(all);
  return 0;
}

}  // namespace gnomon::tool
