// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The latitudes of Gaussian grids.
//
// in    the number of rows between a pole and the equator
// out   degrees
// index rows, and lines between rows, from north to south
#pragma once

#include <cstddef>
#include <vector>

namespace rondel::grids {

// Returns the latitudes of the 2 `number` rows.
std::vector<double> gaussian_latitudes(std::size_t number);

// Returns the parallels half way between rows, and the poles, which are the first and the last one.
std::vector<double> lines_between(const std::vector<double>& latitudes);

}  // namespace rondel::grids
