// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The command line tool: finds the command, runs it, and turns every failure into one line on
// stderr and an exit status.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command.h"
#include "help.h"
#include "job.h"
#include "process.h"
#include "python_libraries.h"
#include "rondel/version.h"

namespace rondel::cli {
namespace {

// Prints one line; line ends within the message become spaces.
int fail(ExitStatus status, std::string message) {
  std::ranges::replace(message, '\n', ' ');
  std::fprintf(stderr, "rondel: %s\n", message.c_str());
  return status;
}

// Puts commands below a heading of `rondel --help`, and adds them to a list.
void add_group(std::vector<Command>& all, const char* heading, std::vector<Command>&& commands) {
  for (Command& command : commands) {
    command.parser->group(heading);
    all.push_back(std::move(command));
  }
}

// Adds all commands, in the order in which `rondel --help` shows them.
std::vector<Command> add_commands(CLI::App& tool) {
  std::vector<Command> all;
  add_group(all, "Commands for triangulations and cells",
            {add_delaunay_command(tool), add_triangulate_command(tool), add_voronoi_command(tool),
             add_hull_command(tool), add_check_command(tool)});
  add_group(all, "Commands for regions, polygons and lines",
            {add_regions_command(tool), add_overlay_command(tool), add_relate_command(tool),
             add_repair_command(tool), add_buffer_command(tool), add_simplify_command(tool)});
  add_group(all, "Commands for neighbors and places",
            {add_nearest_command(tool), add_locate_command(tool), add_graph_command(tool)});
  add_group(all, "Commands for values at sites",
            {add_interpolate_command(tool), add_contours_command(tool)});
  add_group(all, "Commands for fields on grids",
            {add_regrid_command(tool), add_remap_command(tool), add_apply_command(tool),
             add_check_weights_command(tool)});
  add_group(all, "Commands for meshes of models", {add_mesh_command(tool)});
  add_group(all, "Commands for pictures", {add_plot_command(tool)});
  add_group(all, "Commands to begin with",
            {add_info_command(tool), add_generate_command(tool), add_completion_command(tool)});
  return all;
}

// Returns the command that the command line chose, or null if there was only `rondel`.
const Command* selected(const std::vector<Command>& commands) {
  const auto at = std::ranges::find_if(
      commands, [](const Command& command) { return command.parser->parsed(); });
  return at == commands.end() ? nullptr : &*at;
}

// Describes the tool itself: its name, version and help.
void configure(CLI::App& tool) {
  tool.name("rondel");
  tool.set_version_flag("--version", std::string("rondel ") + version, "Print the version");
  tool.set_help_flag("--help,-h", "Print this help");
  tool.formatter(std::make_shared<HelpFormatter>());
  tool.footer(
      "'rondel help COMMAND' explains a command, as 'rondel COMMAND --help' does.\n\n"
      "A first try:\n"
      "  rondel generate uniform -n 1000 -o sites.csv\n"
      "  rondel delaunay sites.csv -o triangles.ply\n"
      "  rondel voronoi sites.csv -o cells.geojson\n"
      "  rondel plot sites.csv -o globe.html");
}

// Names the unknown command; the parser would only say that it did not expect the word.
void require_known_command(const std::vector<Command>& commands, int argc,
                           const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string name = argv[1];
  const auto found = std::ranges::find_if(
      commands, [&](const Command& command) { return command.parser->get_name() == name; });
  if (found == commands.end()) {
    std::error_code ignored;
    const bool is_file = std::filesystem::exists(name, ignored);
    throw UsageError("'" + name + "' is " +
                     (is_file ? "a file; 'rondel info " + name +
                                    "' says what is in it and which commands take it"
                              : "not a command") +
                     " (see rondel --help)");
  }
  const std::vector<const CLI::App*> parts = std::as_const(*found->parser).get_subcommands({});
  if (parts.empty()) return;
  const std::string hint = " (see rondel " + name + " --help)";
  if (argc == 2) throw UsageError("no command of 'rondel " + name + "'" + hint);
  const std::string part = argv[2];
  if (part.empty() || part.front() == '-') return;
  if (std::ranges::none_of(parts, [&](const CLI::App* app) { return app->get_name() == part; })) {
    throw UsageError("'" + part + "' is not a command of 'rondel " + name + "'" + hint);
  }
}

// Returns a hint if the name of a file was taken for an option.
std::string file_like_an_option(int argc, const char* const* argv) {
  for (const std::string name : std::span(argv, static_cast<std::size_t>(argc)).subspan(1)) {
    std::error_code ignored;
    if (name.size() < 2 || name.front() != '-' || !std::filesystem::exists(name, ignored)) continue;
    return "; the file is ./" + name;
  }
  return {};
}

// Names an option whose value is empty, "--value=", for which the parser would take the next
// argument.
void require_option_values(std::span<const char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1) {
      throw UsageError(std::string(argument.substr(0, argument.size() - 1)) +
                       ": its value is empty");
    }
  }
}

// Names an option whose value is an empty argument, as that of a variable that a script has not set:
// it would be as if the option were not there.
void refuse_empty_values(const CLI::App& app) {
  for (const CLI::Option* const option : app.get_options()) {
    if (option->get_lnames().empty() || std::ranges::count(option->results(), "") == 0) continue;
    throw UsageError("--" + option->get_lnames().front() + ": its value is empty");
  }
}

// Returns the parser of the command that the arguments chose.
const CLI::App& parsed_app(const CLI::App& tool) {
  const CLI::App* app = &tool;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

// Returns its name, " mesh scvt".
std::string name_of_parsed(const CLI::App& tool) {
  std::string name;
  for (const CLI::App* app = &parsed_app(tool); app != &tool; app = app->get_parent()) {
    name.insert(0, ' ' + app->get_name());
  }
  return name;
}

// Returns the least number of letters to change, insert or remove between two words.
std::size_t distance_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t changed = diagonal + (a[i - 1] == b[k - 1] ? 0 : 1);
      diagonal = std::exchange(row[k], std::min({row[k] + 1, row[k - 1] + 1, changed}));
    }
  }
  return row.back();
}

// Returns the option of a command that an unknown word may mean: one that it begins, or that differs
// in one or two letters; an empty text if there is none, or more than one.
std::string option_meant_by(const std::string& word, const CLI::App& app) {
  std::vector<std::string> begun;
  std::vector<std::string> near;
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const std::string known = "--" + name;
      if (word.size() > 3 && known.starts_with(word)) begun.push_back(known);
      if (distance_between(word, known) <= 2) near.push_back(known);
    }
  }
  if (begun.size() == 1) return begun.front();
  return begun.empty() && near.size() == 1 ? near.front() : std::string();
}

// Returns a sentence on the first word of the arguments that begins as an option and is none of the
// command's; an empty text if there is no such word. The parser's own message may be on what is
// missing instead.
std::string unknown_option(const CLI::App& tool, std::span<const char* const> arguments) {
  const std::vector<std::string> unknown = tool.remaining(true);
  for (const std::string_view argument : arguments) {
    const std::string word(argument.substr(0, argument.find('=')));
    if (!word.starts_with("--") || word == "--" || std::ranges::count(unknown, argument) == 0) {
      continue;
    }
    const std::string meant = option_meant_by(word, parsed_app(tool));
    return word + " is no option of 'rondel" + name_of_parsed(tool) + '\'' +
           (meant.empty() ? "" : "; " + meant + " is one");
  }
  return {};
}

// Turns "help COMMAND" into "COMMAND --help".
std::vector<const char*> without_help_command(std::span<const char* const> arguments) {
  std::vector<const char*> result(arguments.begin(), arguments.end());
  if (result.size() < 2 || std::string_view(result[1]) != "help") return result;
  result.erase(result.begin() + 1);
  result.push_back("--help");
  return result;
}

// Parses the command line and runs the command. Asking for help or the version is a success.
int run(int argc, const char* const* argv) {
  CLI::App tool{"Exact Delaunay triangulations and Voronoi diagrams on the sphere."};
  configure(tool);
  const std::vector<Command> commands = add_commands(tool);
  require_known_command(commands, argc, argv);
  require_option_values({argv, static_cast<std::size_t>(argc)});
  try {
    tool.parse(argc, argv);
  } catch (const CLI::CallForVersion& text) {
    print(text.what() + std::string("\n"));
    return done;
  } catch (const CLI::Success&) {
    print(tool.help());
    return done;
  } catch (const CLI::ParseError& error) {
    const bool is_on_words = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                             dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const std::string unknown =
        is_on_words ? unknown_option(tool, {argv, static_cast<std::size_t>(argc)}) : "";
    throw UsageError((unknown.empty() ? error.what() : unknown) + " (see rondel" +
                     name_of_parsed(tool) + " --help)" + file_like_an_option(argc, argv));
  }
  const Command* command = selected(commands);
  if (command == nullptr) throw UsageError("no command (see rondel --help)");
  refuse_empty_values(parsed_app(tool));
  return command->run();
}

// Turns exceptions into exit statuses (ExitStatus in command.h).
int run_and_report(int argc, const char* const* argv) {
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    return fail(usage, error.what());
  } catch (const std::bad_alloc&) {
    return fail(failed, "not enough memory");
  } catch (const std::exception& error) {
    return fail(failed, error.what());
  }
}

}  // namespace
}  // namespace rondel::cli

int main(int argc, char** argv) {
  rondel::cli::prepare_process();
  if (argc > 0) rondel::cli::use_netcdf_of_python(argv[0]);
  const std::vector<const char*> arguments =
      rondel::cli::without_help_command(rondel::cli::arguments_of_process(argc, argv));
  return rondel::cli::run_and_report(static_cast<int>(arguments.size()), arguments.data());
}
