// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// How the help pages look.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rondel::cli {

/// Shows what to type, "--threads N", and leaves the rest to the description.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(25); }

  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_items_expected_max() == 0 ? "" : option->get_type_name();
    return type.empty() ? "" : " " + type;
  }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = "\nUsage: " + name;
    if (!app->get_subcommands({}).empty()) return usage + " COMMAND [OPTIONS]\n";
    for (const CLI::Option* option : app->get_options()) {
      if (!option->get_required()) continue;
      const bool is_named = !option->get_snames().empty();
      usage += is_named ? " -" + option->get_snames().front() + make_option_opts(option)
                        : " " + option->get_name();
    }
    return usage + " [OPTIONS]\n";
  }
};

}  // namespace rondel::cli
