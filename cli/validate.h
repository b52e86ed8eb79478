// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Checks of option values, for CLI::Option::check: the empty string, or what is wrong.
#pragma once

#include <cstdint>
#include <string>

namespace rondel::cli {

std::string finite_error(const std::string& text);
std::string positive_error(const std::string& text);
/// A number in [min, max].
std::string range_error(const std::string& text, double min, double max);
/// The decimal digits of a whole number that is written with a point or an exponent, as 1e6; other
/// text as it is.
std::string digits_of_whole(std::string text);
/// A number of bytes: digits, or a decimal number and K, M, G or T, or k, m, g or t, powers of 1024.
std::string bytes_error(const std::string& text);
/// \pre bytes_error(text) is empty.
std::uint64_t bytes_of(const std::string& text);
/// A whole number in [min, max], decimal.
std::string whole_error(const std::string& text, std::uint64_t min, std::uint64_t max);

/// The seed of random numbers.
std::string seed_error(const std::string& text);

}  // namespace rondel::cli
