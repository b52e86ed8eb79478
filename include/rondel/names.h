// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Values of enumerations by their names. A name_of() beside each enumeration that users choose from
/// has the names of its values in the tool, in files and in Python.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace rondel {

/// Returns the names of all values of an enumeration, in the order of its enumerators.
/// \tparam Value  an enumeration with a name_of() that is empty for other numbers
template <class Value>
std::vector<std::string_view> names_of() {
  std::vector<std::string_view> names;
  for (std::size_t k = 0; !name_of(static_cast<Value>(k)).empty(); ++k) {
    names.push_back(name_of(static_cast<Value>(k)));
  }
  return names;
}

/// Returns the value with this name, or nothing.
/// \tparam Value  an enumeration as for names_of()
template <class Value>
std::optional<Value> from_name(std::string_view name) {
  const std::vector<std::string_view> names = names_of<Value>();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k] == name) return static_cast<Value>(k);
  }
  return std::nullopt;
}

}  // namespace rondel
