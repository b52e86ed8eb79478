// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Corrects weights so that their sum in doubles is 1.
//
// in    the weights of a row, whose sum is 1 up to rounding
// out   the same weights up to rounding errors, with the sum 1
#pragma once

#include <algorithm>
#include <cmath>

#include "interpolation/row.h"

namespace rondel::interpolation {

// Rounds weights between 0 and 1 to multiples of 2^-53, for which sums up to 1 are exact.
template <class R>
void round_to_exact_sums(R& row) {
  for (auto& share : row) share.weight = std::rint(share.weight * 0x1p53) * 0x1p-53;
  std::erase_if(row, [](const auto& share) { return share.weight == 0; });
}

// Corrects weights whose sum is not 1 because of rounding: the largest weight takes the difference.
// Where large weights cancel, all are first rounded to multiples of one power of two, for which
// sums are exact.
template <class R>
void take_up_rounding(R& row) {
  constexpr double much = 1.5;
  double absolute = 0;
  double sum = 0;
  for (const auto& share : row) {
    absolute += std::abs(share.weight);
    sum += share.weight;
  }
  if (absolute > much) {
    const double large = std::ldexp(1.5, std::ilogb(absolute) + 2);
    sum = 0;
    for (auto& share : row) {
      share.weight = (share.weight + large) - large;
      sum += share.weight;
    }
  }
  if (sum == 1) return;
  const auto largest =
      std::ranges::max_element(row, {}, [](const auto& share) { return std::abs(share.weight); });
  largest->weight += 1 - sum;
}

}  // namespace rondel::interpolation
