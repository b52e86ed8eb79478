// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Levels of values: given, or multiples of a step.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace rondel::cli {

/// What a list of levels, "0,5,10", is not, for CLI::Option::check: numbers that increase.
std::string levels_error(const std::string& text);
/// \pre levels_error(text) is empty.
std::vector<double> levels_of(const std::string& text);

/// The multiples of a step above the least of the values and not above the largest one, rounded to 15
/// digits, as people write them. Values that are no numbers do not count.
/// \throws UsageError, which begins with the option, if they are more than 10,000.
std::vector<double> levels_at(double step, std::span<const double> values,
                              const std::string& option);

}  // namespace rondel::cli
