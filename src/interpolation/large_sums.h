// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How sums of products with large weights are protected from overflow.
#pragma once

namespace rondel::interpolation {

// Weights may be larger than 1, so that a partial sum may overflow although the sum does not. The
// sum is then taken again with all values multiplied by this number, and divided by it.
inline constexpr double scale_of_large = 0x1p-8;

}  // namespace rondel::interpolation
