// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel completion: prints a script that lets a shell complete command lines of the tool.
// in    the name of a shell; the commands and options as the parser knows them
// out   the script on standard output
#include "completion.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "command.h"
#include "job.h"

namespace rondel::cli {
namespace {

// Returns the script for a shell that the parser has let through.
std::string script_for(const std::string& shell, const CompletedCommand& tool) {
  if (shell == "bash") return bash_completion(tool);
  return shell == "zsh" ? zsh_completion(tool) : fish_completion(tool);
}

}  // namespace

Command add_completion_command(CLI::App& tool) {
  auto shell = std::make_shared<std::string>();
  CLI::App* parser =
      tool.add_subcommand("completion", "Print a script that completes command lines in a shell");
  parser->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->type_name("")
      ->check(one_of({"bash", "zsh", "fish"}, "is not bash, zsh or fish"));
  parser->footer(
      "Packages install the scripts. Without one, a line in the shell's start file is enough:\n"
      "  bash, ~/.bashrc                    source <(rondel completion bash)\n"
      "  zsh, ~/.zshrc, after compinit      source <(rondel completion zsh)\n"
      "  fish, ~/.config/fish/config.fish   rondel completion fish | source\n\n"
      "Example:\n"
      "  rondel completion bash > rondel.bash");
  return {parser, [shell, &tool] {
            print(script_for(*shell, completed(tool)));
            return done;
          }};
}

}  // namespace rondel::cli
