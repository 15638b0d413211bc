// The textbook curves dp/ds(z) under an overhead light: oracles for the metric.
// Based on: Scherzer, Wimmer, Purgathofer, "A Survey of Real-Time Hard Shadow Mapping Methods", 2011,
// section 3.
#include "gnomon/study/dpds.hpp"

#include <cmath>

#include "lanes/elementary.hpp"

namespace gnomon::dpds {

double uniform(double z, double n, double f) noexcept {
  return (f - n) / z;
}

double perspective(double z, double n, double f, double projection_near) noexcept {
  const double range = f - n, big_n = projection_near, u = z - n;
  return (range / (big_n + range)) * ((big_n + u) / big_n) * ((big_n + u) / z);
}

double psm(double z, double n, double f) noexcept {
  return z * (f - n) / (f * n);
}

double lispsm(double z, double n, double f) noexcept {
  return perspective(z, n, f, std::sqrt(n) * (std::sqrt(n) + std::sqrt(f)));
}

double logarithmic(double, double n, double f) noexcept {
  return elementary::log1p((f - n) / n);
}

}  // namespace gnomon::dpds
