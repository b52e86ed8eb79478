// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The sum of weighted values of which some may be missing, or which goes beyond the largest number and
// comes back: for rows of weights that are stored (rondel/weights.h) and for those that are not.
//
// in    a function that visits all entries of a row, each as (weight, value)
// out   the value of the row by the rules of ApplyOptions
#pragma once

#include <cmath>

#include "interpolation/settled_mean.h"
#include "interpolation/vertex_fields.h"
#include "rondel/weights.h"

namespace rondel::interpolation {

template <class VisitEntries>
double sum_of_present(const VisitEntries& visit_entries, const ApplyOptions& options) {
  double sum = 0;
  double small_sum = 0;
  double present = 0;
  double all = 0;
  double absolute_missing = 0;
  double absolute = 0;
  MeanBounds bounds;
  visit_entries([&](double weight, double value) {
    all += weight;
    absolute += std::abs(weight);
    if (std::isnan(value)) {
      absolute_missing += std::abs(weight);
      bounds.add_missing(weight);
    } else {
      bounds.add(weight, value);
      sum += weight * value;
      small_sum += weight * (scale_of_large * value);
      present += weight;
    }
  });
  const bool is_whole = absolute_missing == 0;
  const bool is_enough = may_be_missing(absolute_missing, absolute, options.max_missing);
  if (!is_whole && (!is_enough || present == 0)) return options.fill;
  const bool is_mean = is_whole || !options.keeps_sums;
  const double share = is_whole || options.keeps_sums ? 1 : all / present;
  const double value = std::isfinite(sum) ? sum * share : small_sum * share / scale_of_large;
  return is_mean ? bounds.settled(value) : value;
}

}  // namespace rondel::interpolation
