// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Means without what rounding does to them: sums of weights times values, of weights that sum up to 1.
//
//   weights        0.1  0.2  0.7        their sum in double precision: 0.9999999999999999
//   values         280.1 of all         the sum of products:           280.09999999999997
//   settled mean   280.1
//
// in    a sum in double precision, and a function that visits its entries, each as (weight, value)
// out   the sum, so that constants are exact and means are within the bounds of their values
//
// 1. If all values are equal, the mean is this value.
// 2. If no weight is negative, the mean is not beyond the smallest and the largest value.
// 3. Otherwise, and where the weights do not sum up to 1, the sum stays as it is.
//
// A sum of n entries has an error of at most n u times the largest value M, u = 2^-53. If it is beyond
// the largest value of a row without negative weights, so is the mean less than n u M below that value;
// an entry of weight w, at least 1 / n, has then a value that is less than n^2 u M below it. The sum is
// near the value of the largest weight in every case in which 1 or 2 changes it (n < 2^13), and other sums
// cost one comparison.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/eft.h"

namespace rondel::interpolation {

// 2 n^2 u for n = 2^13.
inline constexpr double nearness = 0x1p-26;

// True if a sum may have to be settled, or is not finite. `main` is the value that has the largest weight.
// Below the smallest normal number products have no relative precision.
inline bool may_be_settled(double sum, double main) noexcept {
  const double step = std::abs(sum - main);
  const double near = nearness * std::abs(main) + std::numeric_limits<double>::min();
  const auto is_far = static_cast<unsigned>(step > near);
  const auto is_finite = static_cast<unsigned>(step < std::numeric_limits<double>::infinity());
  return ((is_far & is_finite) | static_cast<unsigned>(step == 0)) == 0;
}

// Collects the entries of a row.
class MeanBounds {
 public:
  void add(double weight, double value) {
    add_missing(weight);
    if (weight == 0) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  // Adds the weight of a value that is missing.
  void add_missing(double weight) {
    add_term(weight, all_);
    absolute_ += std::abs(weight);
    has_negative_ |= weight < 0;
    ++number_;
  }
  // Returns the mean for a sum that has been divided by the share of the weights that have values.
  [[nodiscard]] double settled(double sum) const {
    // The weights are quotients of areas that are sums themselves.
    const double rounding =
        (64 + static_cast<double>(number_)) * std::numeric_limits<double>::epsilon() * absolute_;
    if (std::isnan(sum) || !(std::abs(all_.hi - 1 + all_.lo) <= rounding)) return sum;
    if (low_ == high_) return low_;
    return has_negative_ || low_ > high_ ? sum : std::clamp(sum, low_, high_);
  }

 private:
  exact::DoubleDouble all_{};
  double absolute_ = 0;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  std::size_t number_ = 0;
  bool has_negative_ = false;
};

// Returns the mean of the values that a function visits, which is never beyond the smallest or the largest
// of them.
template <class VisitValues>
double mean_of(const VisitValues& visit_values) {
  std::size_t number = 0;
  double sum = 0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  visit_values([&](double value) {
    ++number;
    sum += value;
    low = std::min(low, value);
    high = std::max(high, value);
  });
  const auto count = static_cast<double>(number);
  if (std::isnan(sum) || low > high) return sum / count;
  if (!std::isinf(sum)) return std::clamp(sum / count, low, high);
  // Parts of the largest numbers have a sum, or one that rounding alone makes too large.
  const double largest = std::max(std::abs(low), std::abs(high));
  double mean = 0;
  visit_values([&](double value) { mean += value / count; });
  return std::clamp(mean, -largest, largest);
}

// Returns what a sum is as a mean over the entries that a function visits.
template <class VisitEntries>
double settled_mean(double sum, const VisitEntries& visit_entries) {
  MeanBounds bounds;
  visit_entries([&](double weight, double value) { bounds.add(weight, value); });
  return bounds.settled(sum);
}

}  // namespace rondel::interpolation
