// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Numbers and names in messages.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "rondel/export.h"

namespace rondel::system {

// The shortest text that reads back as this double, as std::to_chars writes it.
RONDEL_API std::string shortest_text(double value);

// What shortest_text() gives, without std::to_chars, whose tables of powers of ten would be a third of
// a module of WebAssembly: up to 17 attempts, for machines where size counts.
std::string shortest_text_without_tables(double value);

// Returns the name of a value, whose number is the position of its name; empty for other numbers.
template <class Value>
std::string_view name_in(std::initializer_list<std::string_view> names, Value value) {
  const auto k = static_cast<std::size_t>(value);
  return k < names.size() ? names.begin()[k] : std::string_view();
}

}  // namespace rondel::system
