// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace rondel::interpolation {

// Weights may be more than 1, so that a sum goes beyond the largest number and comes back: it is taken of values that
// are so much smaller then.
inline constexpr double scale_of_large = 0x1p-8;

}  // namespace rondel::interpolation
