// What is the best technique for each kind of scene, and how sure is it?
#pragma once

#include <string>
#include <vector>

#include "gnomon/report/statistics.hpp"
#include "summary.hpp"

namespace gnomon::report {

/// The least median of one error over the views of one kind.
struct KindBest {
  std::string kind;                     ///< of a view's name what stands before ": "; "all": every view
  std::size_t measure = 0;              ///< of measures()
  std::size_t views = 0;                ///< that count
  std::size_t technique = 0, next = 0;  ///< of the summary; the next is the best of the other filters
  Estimate error, next_error;           ///< medians over the views with their intervals
  SignTest test;                        ///< of the technique against the next, view by view
};
/// By kind, in the order they appear, and by error: misclassified, pixel error, twinkling. Empty where no
/// view has a kind.
[[nodiscard]] std::vector<KindBest> best_of_kinds(const std::vector<Row>& rows, const Summary& summary);
/// Heading and table; empty where there is none.
[[nodiscard]] std::string kind_part(const std::vector<Row>& rows, const Summary& summary);
/// Each two techniques over the scenes and named views: the median of the ratio of their errors with its
/// interval, and in how many the first has less. Frames of one view count as one: they are alike. Empty for
/// more than 64 techniques.
[[nodiscard]] std::string pairs_csv(const Summary& summary);
[[nodiscard]] std::string kinds_csv(const std::vector<Row>& rows, const Summary& summary);

}  // namespace gnomon::report
