// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Each script has a table of the commands: what may follow the words that are typed already. A
// shell asks it for the word at the cursor. Names of files are left to the shell, which knows how
// to quote them.
#include "completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string_view>

#include "options.h"

namespace rondel::cli {
namespace {

// Returns the first line of a text, without the end of the sentence.
std::string first_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  while (!line.empty() && (line.back() == '.' || line.back() == ':')) line.pop_back();
  return line;
}

CompletedOption option_of(CLI::Option& option) {
  CompletedOption result;
  for (const std::string& name : option.get_snames()) result.names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  result.what = first_line(option.get_description());
  result.has_value = option.get_items_expected_max() != 0;
  const std::string type = option.get_type_name();
  result.is_file = result.has_value && (type.find("FILE") != std::string::npos || type == "DIR" ||
                                        type == "GRID" || type == "TARGET");
  result.words = words_of(option);
  return result;
}

// Adds a command and those below it to a list, the tool first.
void collect(const CompletedCommand& command, std::vector<const CompletedCommand*>& list) {
  list.push_back(&command);
  for (const CompletedCommand& below : command.commands) collect(below, list);
}

std::vector<const CompletedCommand*> all_of(const CompletedCommand& tool) {
  std::vector<const CompletedCommand*> list;
  collect(tool, list);
  return list;
}

// Returns the last of the words that call a command.
std::string last_word_of(const CompletedCommand& command) {
  return command.words.substr(command.words.rfind(' ') + 1);
}

// Returns the names of the options and commands that may follow, with spaces between them.
std::string followers_of(const CompletedCommand& command) {
  std::string names;
  for (const CompletedCommand& below : command.commands) names += last_word_of(below) + ' ';
  for (const CompletedOption& option : command.options) {
    for (const std::string& name : option.names) names += name + ' ';
  }
  if (!names.empty()) names.pop_back();
  return names;
}

// Returns the names of the options that take a value and fulfil a condition, as a pattern: "-o|--output".
template <class Condition>
std::string pattern_of(const CompletedCommand& command, const Condition& condition) {
  std::string pattern;
  for (const CompletedOption& option : command.options) {
    if (!option.has_value || !condition(option)) continue;
    for (const std::string& name : option.names) pattern += (pattern.empty() ? "" : "|") + name;
  }
  return pattern;
}

// Returns words with spaces between them.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// Returns a text in single quotes, as bash and zsh read it.
std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + '\'';
}

// Returns the lines of bash for the options of a command whose values are one of some words.
std::string bash_choices(const CompletedCommand& command) {
  std::string lines;
  for (const CompletedOption& option : command.options) {
    if (option.words.empty()) continue;
    std::string pattern;
    for (const std::string& name : option.names) {
      pattern += (pattern.empty() ? "" : "|") + in_quotes(command.words + '|' + name);
    }
    lines += "    " + pattern + ") choices=" + in_quotes(joined(option.words)) + " ;;\n";
  }
  return lines;
}

// Returns a text in single quotes for fish, which reads a backslash there before a quote or a
// backslash alone.
std::string in_quotes_of_fish(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + '\'';
}

// Returns a text with a backslash before each character that means something within a specification of _arguments.
std::string escaped_for_zsh(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

// Returns what _arguments says of the value of an option.
std::string zsh_value(const CompletedOption& option) {
  if (!option.words.empty()) return ":word:(" + joined(option.words) + ')';
  return option.is_file ? ":file:_files" : ":value: ";
}

// Returns the lines of _arguments for the options of a command: '(-o --output)'{-o,--output}'[what]:value:_files'.
std::string zsh_arguments(const CompletedCommand& command) {
  std::string lines;
  for (const CompletedOption& option : command.options) {
    std::string together;
    for (const std::string& name : option.names) together += (together.empty() ? "" : " ") + name;
    std::string what = '[' + escaped_for_zsh(option.what) + ']';
    if (option.has_value) what += zsh_value(option);
    for (const std::string& name : option.names) {
      std::string argument = '(' + together;
      argument.append(")").append(name).append(what);
      lines += " \\\n        " + in_quotes(argument);
    }
  }
  return lines;
}

// Returns the function that completes what follows the words of a command.
std::string zsh_function(const CompletedCommand& command) {
  std::string name = "_rondel" + (command.words.empty() ? "" : '_' + command.words);
  std::ranges::replace(name, ' ', '_');
  std::string text = name + "() {\n";
  if (command.commands.empty()) {
    text += "  _arguments -s" + zsh_arguments(command);
    if (!command.arguments.empty()) {
      text += " \\\n        '1:word:(" + joined(command.arguments) + ")'";
    }
    return text + (command.takes_files ? " \\\n        '*:file:_files'\n}\n" : "\n}\n");
  }
  text += "  local context state state_descr line\n  typeset -A opt_args\n  _arguments -C";
  text += zsh_arguments(command);
  text +=
      " \\\n        '1:command:->command' '*::argument:->argument'\n"
      "  case $state in\n  command)\n    local -a commands=(";
  for (const CompletedCommand& below : command.commands) {
    text += "\n      " + in_quotes(last_word_of(below) + ':' + below.what);
  }
  name += "_$line[1]";
  text += ")\n    _describe command commands\n    ;;\n  argument)\n    (( $+functions[";
  text.append(name).append("] )) && ").append(name);
  return text + "\n    ;;\n  esac\n}\n";
}

// Returns the condition of fish that the words typed so far call a command.
std::string fish_condition(const CompletedCommand& command) {
  return "-n " + in_quotes_of_fish("test (__rondel_command) = " + in_quotes_of_fish(command.words));
}

}  // namespace

CompletedCommand completed(CLI::App& app) {
  CompletedCommand result;
  for (const CLI::App* at = &app; at->get_parent() != nullptr; at = at->get_parent()) {
    result.words = at->get_name() + (result.words.empty() ? "" : " ") + result.words;
  }
  result.what = first_line(app.get_description());
  for (CLI::Option* const option : app.get_options()) {
    if (!option->get_positional()) {
      result.options.push_back(option_of(*option));
      continue;
    }
    const std::vector<std::string> words = words_of(*option);
    result.arguments.insert(result.arguments.end(), words.begin(), words.end());
    result.takes_files = result.takes_files || words.empty();
  }
  for (CLI::App* const below : app.get_subcommands(std::function<bool(CLI::App*)>())) {
    result.commands.push_back(completed(*below));
  }
  return result;
}

std::string bash_completion(const CompletedCommand& tool) {
  std::string followers;
  std::string groups;
  std::string choices;
  for (const CompletedCommand* command : all_of(tool)) {
    const std::string files =
        pattern_of(*command, [](const auto& option) { return option.is_file; });
    const std::string values =
        pattern_of(*command, [](const auto& option) { return !option.is_file; });
    followers += "    " + in_quotes(command->words) +
                 ")\n      words=" + in_quotes(followers_of(*command)) + '\n';
    if (!files.empty()) followers += "      files=" + in_quotes('|' + files + '|') + '\n';
    if (!values.empty()) followers += "      values=" + in_quotes('|' + values + '|') + '\n';
    if (!command->arguments.empty()) {
      followers += "      arguments=" + in_quotes(joined(command->arguments)) + '\n';
    }
    if (command->takes_files) followers += "      takes_files=1\n";
    choices += bash_choices(*command);
    followers += "      ;;\n";
    if (command->commands.empty()) continue;
    for (const CompletedCommand& below : command->commands) {
      groups += (groups.empty() ? "" : "|") + in_quotes(below.words);
    }
  }
  return "# Completion of rondel for bash, made by 'rondel completion bash'.\n"
         "_rondel() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local command= words= files= values= arguments= takes_files= choices= i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"${command:+$command }${COMP_WORDS[i]}\" in\n"
         "    " +
         groups +
         ") command=\"${command:+$command }${COMP_WORDS[i]}\" ;;\n"
         "    *) break ;;\n"
         "    esac\n"
         "  done\n"
         "  case \"$command\" in\n" +
         followers +
         "  esac\n"
         "  case \"$command|$previous\" in\n" +
         choices +
         "  esac\n"
         "  COMPREPLY=()\n"
         "  if [[ -n $choices ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$choices\" -- \"$current\")\n"
         "  elif [[ $files == *\"|$previous|\"* ]]; then\n"
         "    compopt -o filenames 2>/dev/null\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  elif [[ $values == *\"|$previous|\"* ]]; then\n"
         "    return\n"
         "  elif [[ $current == -* || $words == [a-z]* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "  elif [[ -n $arguments ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$arguments\" -- \"$current\")\n"
         "  elif [[ -n $takes_files ]]; then\n"
         "    compopt -o filenames 2>/dev/null\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "  fi\n"
         "}\n"
         "complete -F _rondel rondel\n";
}

std::string zsh_completion(const CompletedCommand& tool) {
  std::string functions;
  for (const CompletedCommand* command : all_of(tool)) functions += '\n' + zsh_function(*command);
  return "#compdef rondel\n# Completion of rondel for zsh, made by 'rondel completion zsh'.\n" +
         functions +
         "\nif [ \"$funcstack[1]\" = _rondel ]; then\n  _rondel \"$@\"\nelse\n  compdef _rondel "
         "rondel\nfi\n";
}

std::string fish_completion(const CompletedCommand& tool) {
  std::string groups;
  std::string lines;
  for (const CompletedCommand* command : all_of(tool)) {
    const std::string start = "complete -c rondel " + fish_condition(*command);
    for (const CompletedCommand& below : command->commands) {
      groups += ' ' + in_quotes_of_fish(below.words);
      lines +=
          start + " -f -a " + last_word_of(below) + " -d " + in_quotes_of_fish(below.what) + '\n';
    }
    if (!command->arguments.empty()) {
      lines += start + " -f -a " + in_quotes_of_fish(joined(command->arguments)) + '\n';
    } else if (!command->takes_files && command->commands.empty()) {
      lines += start + " -f\n";
    }
    for (const CompletedOption& option : command->options) {
      lines += start;
      for (const std::string_view name : option.names) {
        lines += name.starts_with("--") ? " -l " : " -s ";
        lines += name.substr(name.find_first_not_of('-'));
      }
      if (option.has_value) lines += option.is_file ? " -r -F" : " -x";
      if (!option.words.empty()) lines += " -a " + in_quotes_of_fish(joined(option.words));
      lines += " -d " + in_quotes_of_fish(option.what) + '\n';
    }
  }
  return "# Completion of rondel for fish, made by 'rondel completion fish'.\n"
         "function __rondel_command\n"
         "  set -l command ''\n"
         "  for word in (commandline -opc)[2..-1]\n"
         "    set -l longer (string trim \"$command $word\")\n"
         "    contains -- $longer" +
         groups +
         "; or break\n"
         "    set command $longer\n"
         "  end\n"
         "  echo $command\n"
         "end\n" +
         lines;
}

}  // namespace rondel::cli
