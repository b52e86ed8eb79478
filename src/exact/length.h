// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lengths, the same bits on every platform: std::hypot differs between C libraries.
#pragma once

#include "exact/vector.h"

namespace rondel::exact {

// The length of any vector, whose squares may over- or underflow.
template <ThreeNumbers V>
double length_of(const V& v) {
  return largest_coordinate(v) * norm(scaled(v));
}

}  // namespace rondel::exact
