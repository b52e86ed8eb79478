// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/wide_integers.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/number.h"

namespace rondel::io {
namespace {

// The least number above all integers of a type.
template <class Integer>
constexpr double end_of = std::is_signed_v<Integer> ? 0x1p63 : 0x1p64;

template <class Integer>
bool is_double_of(Integer value) {
  const auto rounded = static_cast<double>(value);
  return rounded < end_of<Integer> && static_cast<Integer>(rounded) == value;
}

// Compares an integer with number i of an attribute of any type, exactly.
template <class Integer>
std::partial_ordering order_of(Integer value, const NetcdfAttribute& attribute, std::size_t i) {
  const auto exactly = [&](auto other) {
    if (std::cmp_equal(value, other)) return std::partial_ordering::equivalent;
    return std::cmp_less(value, other) ? std::partial_ordering::less
                                       : std::partial_ordering::greater;
  };
  if (i < attribute.integers.size()) {
    const std::int64_t bits = attribute.integers[i];
    return attribute.type == NetcdfType::uint64 ? exactly(static_cast<std::uint64_t>(bits))
                                                : exactly(bits);
  }
  const double number = attribute.numbers[i];
  const auto rounded = static_cast<double>(value);
  if (rounded != number) return rounded <=> number;
  if (rounded >= end_of<Integer>) return std::partial_ordering::less;
  return exactly(static_cast<Integer>(number));
}

// True if the attribute has the integer. Floating-point numbers are less precise, so that what rounds
// to one of them is it.
template <class Integer>
bool has_number(const NetcdfAttribute* attribute, Integer value) {
  if (attribute == nullptr) return false;
  for (std::size_t i = 0; i < attribute->numbers.size(); ++i) {
    const bool is_rounded =
        i >= attribute->integers.size() && attribute->numbers[i] == static_cast<double>(value);
    if (is_rounded || std::is_eq(order_of(value, *attribute, i))) return true;
  }
  return false;
}

template <class Integer>
bool is_missing_integer(const NetcdfVariable& variable, Integer value, Integer default_fill) {
  const auto named = [&](std::string_view name) {
    return find_attribute(variable.attributes, name);
  };
  const NetcdfAttribute* const fill = named("_FillValue");
  if (has_number(fill, value) || has_number(named("missing_value"), value)) return true;
  if (fill == nullptr && value == default_fill) return true;
  // True if the value is less, or greater, than number i of an attribute of so many numbers.
  const auto is_beyond = [&](std::string_view name, std::size_t count, std::size_t i,
                             bool is_lower) {
    const NetcdfAttribute* const bound = named(name);
    if (bound == nullptr || bound->numbers.size() != count) return false;
    const std::partial_ordering order = order_of(value, *bound, i);
    return is_lower ? std::is_lt(order) : std::is_gt(order);
  };
  return is_beyond("valid_min", 1, 0, true) || is_beyond("valid_max", 1, 0, false) ||
         is_beyond("valid_range", 2, 0, true) || is_beyond("valid_range", 2, 1, false);
}

template <class Integer>
std::size_t convert(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                    std::span<double> out, Integer default_fill) {
  std::size_t first = integers.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto value = static_cast<Integer>(integers[i]);
    out[i] = static_cast<double>(value);
    if (is_double_of(value)) continue;
    if (is_missing_integer(variable, value, default_fill)) {
      out[i] = std::numeric_limits<double>::quiet_NaN();
    } else {
      first = std::min(first, i);
    }
  }
  return first;
}

// The double nearest to a bound among those that it allows.
template <class Integer>
double inner_bound(Integer bound, bool is_lower) {
  const auto rounded = static_cast<double>(bound);
  if (is_double_of(bound)) return rounded;
  const bool is_above = rounded >= end_of<Integer> || static_cast<Integer>(rounded) > bound;
  constexpr double no_bound = std::numeric_limits<double>::infinity();
  if (is_lower) return is_above ? rounded : std::nextafter(rounded, no_bound);
  return is_above ? std::nextafter(rounded, -no_bound) : rounded;
}

}  // namespace

double bound_as_double(std::int64_t bits, NetcdfType type, bool is_lower) {
  return type == NetcdfType::uint64 ? inner_bound(static_cast<std::uint64_t>(bits), is_lower)
                                    : inner_bound(bits, is_lower);
}

bool is_double(std::int64_t bits, NetcdfType type) {
  return type == NetcdfType::uint64 ? is_double_of(static_cast<std::uint64_t>(bits))
                                    : is_double_of(bits);
}

std::string text_of(std::int64_t bits, NetcdfType type) {
  return type == NetcdfType::uint64 ? std::to_string(static_cast<std::uint64_t>(bits))
                                    : std::to_string(bits);
}

std::size_t round_to_doubles(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                             std::span<double> out) {
  return variable.type == NetcdfType::uint64
             ? convert(variable, integers, out, default_fill_of_uint64)
             : convert(variable, integers, out, default_fill_of_int64);
}

void to_doubles(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                std::span<double> out) {
  const std::size_t first = round_to_doubles(variable, integers, out);
  if (first == integers.size()) return;
  throw BadValue("variable " + in_quotes(variable.name) + ": " +
                 text_of(integers[first], variable.type) + " is no double");
}

}  // namespace rondel::io
