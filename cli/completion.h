// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Scripts that let a shell complete command lines of the tool: names of commands and options, the
/// words that an argument or the value of an option may be, and files where it is one.
///
/// in    the commands and options as the parser knows them
/// out   the text of a script for bash, zsh or fish
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
}  // namespace CLI

namespace rondel::cli {

/// An option as a shell needs to know it.
struct CompletedOption {
  /// The names with their dashes, the short ones first.
  std::vector<std::string> names;
  /// One line that says what it does.
  std::string what;
  bool has_value = false;
  /// The value is the name of a file or a folder.
  bool is_file = false;
  /// The words of which the value is one, if there are such.
  std::vector<std::string> words;
};

/// A command, or the tool itself.
struct CompletedCommand {
  /// The words that call it, "mesh scvt"; empty for the tool.
  std::string words;
  /// One line that says what it does.
  std::string what;
  std::vector<CompletedOption> options;
  /// The commands that it has, each with its line. Then it takes no other argument.
  std::vector<CompletedCommand> commands;
  /// The words of which its argument is one, if there are such.
  std::vector<std::string> arguments;
  /// True if an argument is the name of a file.
  bool takes_files = false;
};

/// Returns the commands below an application of the parser, and their options.
CompletedCommand completed(CLI::App& app);

/// Returns the script for a shell, which reads it by `source`, or finds it in a folder of its own.
std::string bash_completion(const CompletedCommand& tool);
std::string zsh_completion(const CompletedCommand& tool);
std::string fish_completion(const CompletedCommand& tool);

}  // namespace rondel::cli
