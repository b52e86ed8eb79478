// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of values of an enumeration.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace rondel::system {

// Returns the name of a value, whose number is the position of its name; empty for other numbers.
template <class Value>
std::string_view name_in(std::initializer_list<std::string_view> names, Value value) {
  const auto k = static_cast<std::size_t>(value);
  return k < names.size() ? names.begin()[k] : std::string_view();
}

}  // namespace rondel::system
