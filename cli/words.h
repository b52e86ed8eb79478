// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Options whose values are words, and options that need others.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <unordered_map>

#include "command.h"

namespace rondel::cli {

/// Adds an option that takes one of the words in `choices`.
template <typename Value>
void add_word(CLI::App& parser, const std::string& name, Value& target,
              const std::unordered_map<std::string, Value>& choices, const std::string& what) {
  parser
      .add_option_function<std::string>(
          name, [&target, choices](const std::string& text) { target = choices.at(text); }, what)
      ->check([choices](const std::string& text) {
        return choices.contains(text) ? std::string() : "'" + text + "' is not a choice";
      })
      ->type_name("WORD");
}

/// \throws UsageError if one of the options is given although it has no effect; `where` says where
/// that is: "without --clip"
inline void require_effect(const CLI::App& parser, bool has_effect,
                           std::initializer_list<const char*> names, const std::string& where) {
  for (const char* const name : names) {
    if (!has_effect && parser.count(name) > 0) {
      throw UsageError(std::string(name) + " has no effect " + where);
    }
  }
}

}  // namespace rondel::cli
