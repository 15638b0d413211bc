// Which technique has the least error within a budget of time, on this machine, and how sure is that?
#include "budgets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kTime = "total_ms";
/// With fewer views a sign test has more than 5 % chance, whatever they say: 2 / 2^n.
constexpr std::size_t kFewestForSign = 6;

/// Loads of the machine while it measured, least and most.
std::pair<double, double> loads_of(const std::vector<Row>& rows) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Row& row : rows) {
    least = std::min(least, row.machine.load);
    most = std::max(most, row.machine.load);
  }
  return {least, most};
}

std::string as_good_text(const BudgetChoice& choice, const Summary& summary) {
  constexpr std::size_t kMost = 3;
  std::string out;
  const std::size_t count = choice.as_good.size(), shown = count > kMost + 1 ? kMost : count;
  for (std::size_t i = 0; i < shown; ++i)
    out += (i > 0 ? "; " : "") + summary.techniques[choice.as_good[i]].name();
  return shown < count ? out + "; and " + std::to_string(count - shown) + " more" : out;
}

std::string choice_row(const BudgetChoice& choice, const Summary& summary, const Measure& error) {
  const Measure& time = measures()[measure_index(kTime)];
  std::string less = "-";
  if (choice.test) {
    less = std::to_string(choice.test->less) + " of " + std::to_string(choice.test->less + choice.test->more);
    if (choice.test->chance < kSure) less = "<b>" + less + "</b>";
  }
  return "<tr><td>" + short_number(choice.budget_ms) + "</td><td>" +
         escaped(summary.techniques[choice.technique].name()) + "</td><td>" +
         escaped(with_interval(error, choice.error)) + "</td><td>" + escaped(with_interval(time, choice.ms)) +
         "</td><td>" + less + "</td><td>" + escaped(as_good_text(choice, summary)) + "</td></tr>\n";
}

/// What the noise of the clock and the number of views do not allow to be said.
std::string noise_text(const std::vector<Row>& rows, const ViewTable& table) {
  std::string out;
  if (!table.again.empty())
    out +=
        " The baseline was timed twice in the same rounds, as two techniques: in 95 % of the frames the two "
        "times differ by less than a factor of " +
        short_number(table.noise()) + ". Budgets that are closer than that may be equal.";
  if (table.views < kFewestForSign)
    out += " With " + counted(table.views, "view") + " no error is surely less than another: that takes " +
           std::to_string(kFewestForSign) + " views.";
  const auto [least, most] = loads_of(rows);
  const Machine& m = rows.front().machine;
  out += " Machine: " + m.renderer + ", " + m.cpu + ", " +
         counted(static_cast<std::size_t>(m.cores), "core") + ", load " + short_number(least) + " to " +
         short_number(most) + ".";
  // The load of the last minute holds this run's own threads: they are as many as cores where software draws.
  if (most > 1.5 * m.cores) out += " Other programs ran beside: a quiet machine is faster.";
  return out;
}

Json interval_json(const Estimate& e) {
  return {{"median", e.median}, {"low", e.low}, {"high", e.high}};
}

}  // namespace

std::vector<BudgetChoice> budget_choices(const ViewTable& table, const Summary& summary,
                                         std::string_view error) {
  struct Timed {
    std::size_t technique;
    Estimate error, ms;
  };
  std::vector<Timed> order;
  for (std::size_t t = 0; t < summary.techniques.size(); ++t)
    if (table.everywhere(error, t) && table.everywhere(kTime, t))
      order.push_back({t, *table.over(error, t), *table.over(kTime, t)});
  std::stable_sort(order.begin(), order.end(),
                   [](const Timed& a, const Timed& b) { return a.ms.high < b.ms.high; });
  std::vector<BudgetChoice> choices;
  for (const Timed& one : order) {
    if (!choices.empty() && !(one.error.median < choices.back().error.median)) continue;
    BudgetChoice choice{one.ms.high, one.technique, one.error, one.ms, {}, {}};
    if (!choices.empty()) choice.test = table.compared(error, one.technique, choices.back().technique);
    choices.push_back(std::move(choice));
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Timed& a, const Timed& b) { return a.error.median < b.error.median; });
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const double next =
        i + 1 < choices.size() ? choices[i + 1].budget_ms : std::numeric_limits<double>::infinity();
    for (const Timed& other : order) {
      if (other.technique == choices[i].technique || !(other.ms.high < next)) continue;
      const SignTest test = table.compared(error, choices[i].technique, other.technique);
      if (!(test.less > test.more && test.chance < kSure)) choices[i].as_good.push_back(other.technique);
    }
  }
  return choices;
}

std::string budget_part(const std::vector<Row>& rows, const Summary& summary) {
  const ViewTable table = view_table(rows, summary);
  if (table.views < 2) return {};
  std::string out =
      "<h3 id=\"budgets\">Which technique for which budget</h3>\n<p class=\"note\">On this machine, over " +
      counted(table.views, "view") +
      ". <b>from</b>: milliseconds of a frame's shadows from which the technique is within the budget, the "
      "upper "
      "end of the interval of its median time. Up to the next row's budget no other technique has less "
      "median "
      "error. Intervals are of 95 %. <b>less in</b>: views in which it has less error than the row above, of "
      "those in which they differ; bold where a sign test calls it chance with less than 5 %. <b>as "
      "good</b>: "
      "within the same budget, and not shown to have more error." +
      escaped(noise_text(rows, table)) + "</p>\n";
  for (const std::string_view key : kErrors) {
    const std::vector<BudgetChoice> choices = budget_choices(table, summary, key);
    if (choices.empty()) continue;
    const Measure& error = measures()[measure_index(key)];
    out += scroll_box("Budgets by " + std::string(error.column)) +
           "<table class=\"words\"><thead><tr><th>from, ms</th><th>technique</th><th>" +
           escaped(error.column) +
           "</th><th>time, ms</th><th>less in</th><th>as good</th></tr></thead><tbody>\n";
    for (const BudgetChoice& choice : choices) out += choice_row(choice, summary, error);
    out += "</tbody></table></div>\n";
  }
  return out;
}

std::string budgets_json(const std::vector<Row>& rows, const Summary& summary) {
  const ViewTable table = view_table(rows, summary);
  Json json{{"schema", "gnomon-budgets/1"}, {"views", table.views}, {"noise_factor", table.noise()}};
  if (!rows.empty()) {
    const Machine& m = rows.front().machine;
    const auto [least, most] = loads_of(rows);
    json["machine"] = {{"renderer", m.renderer}, {"context", m.context}, {"software", m.software},
                       {"cpu", m.cpu},           {"cores", m.cores},     {"version", m.version},
                       {"load_least", least},    {"load_most", most}};
  }
  const auto name_of = [&](std::size_t t) { return summary.techniques[t].name(); };
  json["errors"] = Json::object();
  json["choices"] = Json::object();
  for (const std::string_view key : kErrors) {
    Json list = Json::array();
    if (table.views >= 2) {
      for (const BudgetChoice& choice : budget_choices(table, summary, key)) {
        Json one{{"budget_ms", choice.budget_ms},
                 {"technique", name_of(choice.technique)},
                 {"error", interval_json(choice.error)},
                 {"ms", interval_json(choice.ms)}};
        if (choice.test)
          one["less_in"] = {
              {"less", choice.test->less}, {"more", choice.test->more}, {"chance", choice.test->chance}};
        one["as_good"] = Json::array();
        for (const std::size_t t : choice.as_good) one["as_good"].push_back(name_of(t));
        list.push_back(std::move(one));
      }
    }
    json["errors"][std::string(key)] = measures()[measure_index(key)].name;
    json["choices"][std::string(key)] = std::move(list);
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::report
