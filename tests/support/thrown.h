// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the exceptions say that functions under test throw.
#pragma once

#include <cstddef>
#include <string>

#include "rondel/error.h"

namespace rondel::test {

// Returns the message of the exception that `action` throws; empty if it throws none.
template <class Error, class Action>
std::string thrown_message(const Action& action) {
  try {
    static_cast<void>(action());
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

// Returns the index that the InvalidInput names which `action` throws, or `otherwise`.
template <class Action>
std::size_t thrown_index(const Action& action, std::size_t otherwise = 99) {
  try {
    static_cast<void>(action());
  } catch (const InvalidInput& error) {
    return error.index();
  }
  return otherwise;
}

}  // namespace rondel::test
