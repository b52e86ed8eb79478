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
/// A decimal number in [min, max].
std::string whole_error(const std::string& text, std::uint64_t min, std::uint64_t max);

}  // namespace rondel::cli
