// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values of enumerations, which Python passes by their names.
#pragma once

#include <nanobind/nanobind.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/names.h"

namespace rondel::python {

// Returns the names of all values of an enumeration, as a tuple.
template <class Value>
nb::tuple names_in_python() {
  nb::list names;
  for (const std::string_view name : names_of<Value>()) {
    names.append(nb::str(name.data(), name.size()));
  }
  return nb::tuple(names);
}

// Returns the value with the name that Python has passed as `argument`. Raises ValueError for
// anything but one of the names. Call this with the lock of the interpreter.
template <class Value>
Value named(const char* argument, nb::handle given) {
  if (nb::isinstance<nb::str>(given)) {
    const nb::str name(given);
    if (const auto value = from_name<Value>(name.c_str())) return *value;
  }
  const std::vector<std::string_view> names = names_of<Value>();
  std::string text = std::string(argument) + (names.size() > 2 ? " must be one of " : " must be ");
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += names.size() > 2 ? ", " : " or ";
    text += "'" + std::string(names[k]) + "'";
  }
  text += std::string(", not ") + nb::repr(given).c_str();
  throw nb::value_error(text.c_str());
}

}  // namespace rondel::python
