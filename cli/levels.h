// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Levels of values: a list, or the multiples of a step.
///
/// in    the text of --levels, or a step and the values at the sites
/// out   levels in increasing order, in the unit of the values
#pragma once

#include <span>
#include <string>
#include <vector>

namespace rondel::cli {

/// Returns what is wrong with a list of levels such as "0,5,10", whose numbers must increase; empty
/// if nothing is.
std::string levels_error(const std::string& text);
/// Returns the numbers of the list. \pre levels_error(text) is empty
std::vector<double> levels_of(const std::string& text);

/// Returns the multiples of a step that are greater than the least of the values and at most the
/// largest one, rounded to 15 digits, as people write them. NaN is ignored. \throws UsageError,
/// which begins with the option, if there are more than 10,000 or they are no doubles.
std::vector<double> levels_at(double step, std::span<const double> values,
                              const std::string& option);

}  // namespace rondel::cli
