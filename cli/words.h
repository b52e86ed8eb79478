// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Options whose values are words.
///
/// in    a word of the command line
/// out   the value that it stands for, or a usage error that quotes the word
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

#include "command.h"
#include "rondel/names.h"

namespace rondel::cli {

/// Returns the values of an enumeration by the names that the library gives them.
template <class Value>
std::unordered_map<std::string, Value> named_values() {
  std::unordered_map<std::string, Value> values;
  for (const std::string_view name : names_of<Value>()) {
    values.emplace(name, *from_name<Value>(name));
  }
  return values;
}

/// Adds an option that takes one of the words in `choices`.
/// \param name  the option, "--edges"
/// \param target  gets the value of the word; it must live until the command line has been parsed
/// \param what  the help text, which names the words
template <typename Value>
CLI::Option* add_word(CLI::App& parser, const std::string& name, Value& target,
                      const std::unordered_map<std::string, Value>& choices,
                      const std::string& what) {
  return parser
      .add_option_function<std::string>(
          name, [&target, choices](const std::string& text) { target = choices.at(text); }, what)
      ->check([choices](const std::string& text) {
        return choices.contains(text) ? std::string() : "'" + text + "' is not a choice";
      })
      ->type_name("WORD");
}

}  // namespace rondel::cli
