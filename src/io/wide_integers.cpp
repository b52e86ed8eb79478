// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "io/wide_integers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/bad_value.h"
#include "io/netcdf_reader.h"
#include "io/number.h"

namespace rondel::io {
namespace {

template <class Integer>
bool is_double_of(Integer value) {
  const auto rounded = static_cast<double>(value);
  constexpr double end = std::is_signed_v<Integer> ? 0x1p63 : 0x1p64;
  return rounded < end && static_cast<Integer>(rounded) == value;
}

// The attributes of the same type, or none.
template <class Integer>
std::vector<Integer> numbers_of(const NetcdfVariable& variable, std::string_view name) {
  std::vector<Integer> numbers;
  const NetcdfAttribute* const attribute = find_attribute(variable.attributes, name);
  if (attribute == nullptr || attribute->type != variable.type) return numbers;
  for (const std::int64_t bits : attribute->integers) numbers.push_back(static_cast<Integer>(bits));
  return numbers;
}

template <class Integer>
bool is_missing_integer(const NetcdfVariable& variable, Integer value, Integer default_fill) {
  for (const char* name : {"_FillValue", "missing_value"}) {
    const std::vector<Integer> numbers = numbers_of<Integer>(variable, name);
    if (std::ranges::find(numbers, value) != numbers.end()) return true;
    // Numbers of another type are compared as doubles.
    const NetcdfAttribute* const attribute = find_attribute(variable.attributes, name);
    if (attribute == nullptr || attribute->type == variable.type) continue;
    const std::vector<double>& others = attribute->numbers;
    if (std::ranges::find(others, static_cast<double>(value)) != others.end()) return true;
  }
  if (find_attribute(variable.attributes, "_FillValue") == nullptr && value == default_fill) {
    return true;
  }
  const std::vector<Integer> least = numbers_of<Integer>(variable, "valid_min");
  const std::vector<Integer> most = numbers_of<Integer>(variable, "valid_max");
  const std::vector<Integer> range = numbers_of<Integer>(variable, "valid_range");
  return (least.size() == 1 && value < least[0]) || (most.size() == 1 && value > most[0]) ||
         (range.size() == 2 && (value < range[0] || value > range[1]));
}

template <class Integer>
void convert(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
             std::span<double> out, bool may_round, Integer default_fill) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto value = static_cast<Integer>(integers[i]);
    out[i] = static_cast<double>(value);
    if (is_double_of(value)) continue;
    if (is_missing_integer(variable, value, default_fill)) {
      out[i] = std::numeric_limits<double>::quiet_NaN();
    } else if (!may_round) {
      throw BadValue("variable " + in_quotes(variable.name) + ": " + std::to_string(value) +
                     " is no double");
    }
  }
}

// The double nearest to a bound among those that it allows.
template <class Integer>
double inner_bound(Integer bound, bool is_lower) {
  const auto rounded = static_cast<double>(bound);
  if (is_double_of(bound)) return rounded;
  constexpr double end = std::is_signed_v<Integer> ? 0x1p63 : 0x1p64;
  const bool is_above = rounded >= end || static_cast<Integer>(rounded) > bound;
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

void to_doubles(const NetcdfVariable& variable, std::span<const std::int64_t> integers,
                std::span<double> out, bool may_round) {
  if (variable.type == NetcdfType::uint64) {
    convert(variable, integers, out, may_round, default_fill_of_uint64);
  } else {
    convert(variable, integers, out, may_round, default_fill_of_int64);
  }
}

}  // namespace rondel::io
