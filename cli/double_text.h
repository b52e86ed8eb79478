// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Reads doubles from text, which std::from_chars() of LLVM's C++ library before 20 cannot.
///
/// in    the text of an argument or of a cell of a table
/// out   the nearest double, and where reading ended; it does not depend on the locale
#pragma once

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace rondel::cli {

/// The place where a number ends in the text, and whether there is a number.
struct DoubleEnd {
  const char* ptr;
  /// invalid_argument if the text begins with no number; result_out_of_range if the digits are
  /// beyond the largest double.
  std::errc ec;
};

/// Reads the number with which the text begins; `value` is kept where there is none.
inline DoubleEnd double_from(const char* first, const char* last, double& value) {
  double read = 0;
  const auto [end, error] = fast_float::from_chars(first, last, read);
  if (error == std::errc::invalid_argument) return {first, error};
  value = read;
  // Versions of fast_float differ in what they say of digits that are infinite.
  const bool has_digit = std::any_of(first, end, [](char c) { return '0' <= c && c <= '9'; });
  return {end, std::isinf(read) && has_digit ? std::errc::result_out_of_range : std::errc()};
}

}  // namespace rondel::cli
