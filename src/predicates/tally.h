// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A decision of a ladder, and the rung that made it.
#pragma once

#include "rondel/types.h"

namespace rondel::predicates {

enum class Rung : std::uint8_t { filter, double_double, exact, perturbed };

struct Decision {
  Sign sign = Sign::zero;
  Rung rung = Rung::filter;
};

inline void count(Tally& tally, Rung rung) {
  switch (rung) {
    case Rung::filter:
      ++tally.filter;
      break;
    case Rung::double_double:
      ++tally.double_double;
      break;
    case Rung::exact:
      ++tally.exact;
      break;
    case Rung::perturbed:
      ++tally.perturbed;
      break;
  }
}

inline void add(Tally& sum, const Tally& tally) {
  sum.filter += tally.filter;
  sum.double_double += tally.double_double;
  sum.exact += tally.exact;
  sum.perturbed += tally.perturbed;
}

}  // namespace rondel::predicates
