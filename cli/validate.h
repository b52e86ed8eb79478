// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Checks of option values, for CLI::Option::check. They return an empty string, or what is wrong.
///
/// in    the text of an option's value
/// out   an empty text, or "'...' is not ..." for the message of a usage error
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace rondel::cli {

/// Returns the two parts of a text with one comma, such as "u,v"; nothing for another text.
std::optional<std::pair<std::string, std::string>> parts_at_comma(std::string_view text);

/// Checks a number that is neither infinite nor NaN.
std::string finite_error(const std::string& text);
/// Checks a finite number that is greater than 0.
std::string positive_error(const std::string& text);
/// Checks a number in [min, max].
std::string range_error(const std::string& text, double min, double max);
/// Returns the decimal digits of a whole number that is written with a point or an exponent, such
/// as 1e6; returns other text unchanged.
std::string digits_of_whole(std::string text);
/// Checks a number of bytes: digits, or a decimal number and K, M, G or T, or k, m, g or t, which
/// are powers of 1024.
std::string bytes_error(const std::string& text);
/// Returns the number of bytes. \pre bytes_error(text) is empty
std::uint64_t bytes_of(const std::string& text);
/// Checks a whole decimal number in [min, max].
std::string whole_error(const std::string& text, std::uint64_t min, std::uint64_t max);

/// Checks a number of sites: at least 1, at most as many as an index can count.
std::string count_error(const std::string& text);

/// Checks the seed of random numbers.
std::string seed_error(const std::string& text);

}  // namespace rondel::cli
