// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// How the help pages look.
///
/// in    the commands and options as the parser knows them
/// out   the text of `rondel COMMAND --help`
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rondel::cli {

/// Shows what to type, as in "--threads N"; the rest is left to the description.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(25); }

  /// Returns the word for the value of an option, " N"; nothing for a flag.
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_items_expected_max() == 0 ? "" : option->get_type_name();
    return type.empty() ? "" : " " + type;
  }

  /// Returns the line "Usage: ..." with the arguments that must be given; the others are [OPTIONS].
  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = "\nUsage: " + name;
    if (!app->get_subcommands({}).empty()) return usage + " COMMAND [OPTIONS]\n";
    for (const CLI::Option* option : app->get_options()) {
      if (!option->get_required()) {
        if (option->get_positional()) usage += " [" + option->get_name() + ']';
        continue;
      }
      usage += ' ' + shortest_name(*option);
      if (!option->get_positional()) usage += make_option_opts(option);
    }
    return usage + " [OPTIONS]\n";
  }

 private:
  /// Returns "-o" for -o,--output, and the name without dashes for a positional argument.
  static std::string shortest_name(const CLI::Option& option) {
    if (option.get_positional()) return option.get_name();
    if (!option.get_snames().empty()) return '-' + option.get_snames().front();
    return "--" + option.get_lnames().front();
  }
};

}  // namespace rondel::cli
