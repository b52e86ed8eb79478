// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// What the commands of the tool share: their common options, a job whose stages are timed and
/// whose progress is shown, and the report at the end. A command is two functions: one describes
/// its arguments to the parser, the other runs when they have been parsed.
///
///     Command add_plot_command(CLI::App& tool) {
///       auto options = std::make_shared<PlotOptions>();   // holds a CommonOptions `common`
///       CLI::App* parser = tool.add_subcommand("plot", "...");
///       add_input_options(*parser, options->common); ...
///       return {parser, [options] { return run_plot(*options); }};
///     }
///
/// in    the command line
/// out   files, a report on standard output, remarks and errors on standard error, an exit status
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "files_of_command.h"
#include "rondel/error.h"
#include "rondel/io.h"
#include "rondel/mesh_files.h"
#include "rondel/triangulation.h"

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
class Option;
}  // namespace CLI

namespace rondel::cli {

/// The exit status of the tool. An exception becomes one line on stderr, "rondel: <what>", and one
/// of these: FileError, InvalidInput, bad_alloc, anything else -> failed; UsageError -> usage.
enum ExitStatus : int { done = 0, failed = 1, usage = 2 };

/// The command line asks for something that the tool does not offer.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A command of the tool and what it does once the command line is parsed.
struct Command {
  CLI::App* parser = nullptr;
  std::function<ExitStatus()> run;
};

/// An option that changes nothing unless a condition holds, which other options decide.
struct OptionEffect {
  const CLI::Option* option;
  std::function<bool()> has_effect;
  std::string otherwise;  ///< ends "--count has no effect ...", such as "without --kind circles"
};

/// The options that mean the same in every command that has them.
struct CommonOptions {
  std::string input;                  ///< INPUT; "-": standard input
  std::string input_format;           ///< --input-format
  std::string output;                 ///< -o, --output; "-": standard output
  std::string output_format;          ///< --format
  ReadOptions read;                   ///< --lon --lat --x --y --z --radius --radians
  Options build;                      ///< --model --center --squared-radius
  unsigned threads = 0;               ///< --threads
  bool json = false;                  ///< --json
  bool quiet = false;                 ///< --quiet
  std::vector<OptionEffect> effects;  ///< see require_effect()

  [[nodiscard]] FileName source() const { return {input, input_format}; }
  /// Returns INPUT and another file that the command reads; --input-format is for the one of them
  /// that is standard input, or else for INPUT.
  [[nodiscard]] FileName source_beside(const std::string& other) const;
  [[nodiscard]] FileName other_source(const std::string& other) const;
  [[nodiscard]] FileName target() const { return {output, output_format}; }
  /// Returns the format of the output in lower case, "ply": the named one, or the ending.
  [[nodiscard]] std::string format() const;
};

/// Makes it a usage error to give an option that has no effect. The conditions are checked when the
/// command line has been parsed, if the command calls add_report_options(); what they refer to must
/// live until then.
/// \param options  the options of the command, where the condition is kept
/// \param option  the option that may have no effect
/// \param has_effect  answers after parsing whether the option changes anything
/// \param otherwise  says when there is none: "--count has no effect without --kind circles"
void require_effect(CommonOptions& options, const CLI::Option* option,
                    std::function<bool()> has_effect, std::string otherwise);

/// The help text of INPUT where it has sites.
inline constexpr const char* default_input_help =
    "The sites: .csv .tsv .xyz .txt .npy .geojson, the places of a netCDF file, or - for\n"
    "standard input. Longitude and latitude in degrees, or x, y, z.";

/// Returns the files from which a command reads sites or values.
using TablesRead = std::function<std::vector<FileName>()>;

/// Returns "-" for the name that the system has for a standard stream, and other names unchanged.
std::string standard(const std::string& name, const char* stream);

/// Adds INPUT and the options that say how to read it. \pre this comes before add_build_options(),
/// since --radius sets the model, which --model may contradict.
/// \param what  the help text of INPUT
/// \param tables  returns the files to which the names of columns, --delimiter and --radians apply;
/// --radius applies to the first one. By default that is INPUT alone.
void add_input_options(CLI::App& command, CommonOptions& options,
                       const std::string& what = default_input_help, const TablesRead& tables = {});
/// Does the same for a command that takes points in space: x, y, z only.
void add_point_input_options(CLI::App& command, CommonOptions& options);
/// Adds --output, which the caller may require, and --format. `what` says for the help what is
/// written, and to which endings.
CLI::Option* add_output_option(CLI::App& command, CommonOptions& options, const std::string& what);
/// Adds --model, --center and --squared-radius, which say what is triangulated, and --threads.
void add_build_options(CLI::App& command, CommonOptions& options);
/// Tells that names of columns in `read`, which are for another file, change nothing for this one.
void tell_of_columns(const std::string& netcdf, const ReadOptions& read);
/// Throws UsageError if --radians is given and none of the tables has angles.
void require_angles(const ReadOptions& read, std::span<const SiteTable* const> tables);
/// Adds --threads; without it a command has one thread for each core.
void add_threads_option(CLI::App& command, CommonOptions& options);
/// Adds --json and --quiet, and checks after parsing the options that require_effect() names.
void add_report_options(CLI::App& command, CommonOptions& options);

/// Throws UsageError unless the output has a format that the command writes, if output and report
/// both want standard output, and as require_separate_files() does. It is called before any work.
/// \param is_known  true if the command writes the format of OUTPUT
/// \param endings  the formats that it writes, for the message: ".csv .npy"
/// \param inputs  the files that the command reads beside INPUT
/// \param outputs  the files that it writes beside OUTPUT
void require_output(const CommonOptions& options, bool is_known, const std::string& endings,
                    const std::vector<NamedFile>& inputs = {},
                    const std::vector<NamedFile>& outputs = {});

/// The stages of a job that a command times itself.
enum class Stage { dual, locator, query, write };

/// Wall time of a job and of its stages, in seconds. A stage that a command does not time is a part
/// of `total` only.
struct Seconds {
  double read = 0;
  double dual = 0;
  double locator = 0;
  double query = 0;
  double write = 0;
  double total = 0;
};

/// One run of a command: reads, triangulates, times each stage, shows
/// progress on a terminal, and reports in the end.
class Job {
 public:
  explicit Job(const CommonOptions& options);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Reads the sites of INPUT. \throws FileError if it cannot be read
  SiteTable read();
  /// Reads the sites of another file. From netCDF it reads the sites of the variables `names`,
  /// which become the columns, unless FILE:NAME names a variable. Sites that netCDF masks are left
  /// out. \throws FileError if it cannot be read
  SiteTable read(const FileName& file, const ReadOptions& read,
                 std::span<const std::string> names = {});
  /// Does the same, but keeps sites that netCDF masks, and returns what the file says of their
  /// grid. \throws FileError if it cannot be read
  NetcdfSites read_grid(const FileName& file, const ReadOptions& read,
                        std::span<const std::string> names = {});
  /// Triangulates the sites. \throws FileError with the file and line of a site that the library
  /// does not accept. The result refers to the table's sites, which must outlive it.
  Triangulation triangulate(const SiteTable& table);
  /// Returns the convex hull of the sites. \throws FileError like triangulate()
  Triangulation hull(const SiteTable& table);
  /// Returns the values as they are shown: where several sites are in one place, each has the first
  /// value there. The report will say how many sites have no value, and how many have another value
  /// than the one shown.
  /// \param values  a value for each site, by the index of the input; NaN: none
  /// \param name  the column that the values come from
  /// \param consequence  what becomes of sites without a value: "cells without a value have no
  /// color"
  std::vector<double> shown_values(const Triangulation& triangulation,
                                   const std::vector<double>& values, const std::string& name,
                                   const std::string& consequence);
  /// Runs `work` on the clock of `stage`.
  void time(Stage stage, const std::function<void()>& work);
  /// Returns the wanted number of threads, and a progress, which is empty if none is shown.
  [[nodiscard]] Execution execution() const;
  /// Returns the times up to now.
  [[nodiscard]] Seconds seconds() const;

  /// Prints the summary, or the JSON object of --json; prints nothing with --quiet, or if the
  /// output goes to standard output. `what` says what was written to OUTPUT, for example "the
  /// triangulation". \throws FileError if stdout cannot be written
  void report(const Triangulation& triangulation, const std::string& what);
  /// Does the same for a command with its own report; `json` is printed with --json.
  void report(const std::string& json, const std::string& summary);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns work(), which calls the library with the sites of `table`. An InvalidInput becomes a
/// FileError that names the site's place in the file.
template <class Work>
auto with_places(const SiteTable& table, Work&& work) {
  try {
    return work();
  } catch (const InvalidInput& error) {
    const bool has_place = error.index() != InvalidInput::no_index;
    throw FileError((has_place ? table.where(error.index()) : table.name) + ": " + error.what());
  }
}

/// \throws UsageError if the name of a result beside OUTPUT has an ending other than .npy; it may
/// have none
void require_array(const char* option, const std::string& path);

/// Writes to stdout and flushes. \throws FileError
void print(const std::string& text);

/// Each of these functions adds a command with its arguments and its help to the tool. They are in
/// commands.cpp if no other file is named.
Command add_delaunay_command(CLI::App& tool);
Command add_voronoi_command(CLI::App& tool);
Command add_hull_command(CLI::App& tool);
Command add_check_command(CLI::App& tool);
Command add_contours_command(CLI::App& tool);  // contours.cpp
Command add_graph_command(CLI::App& tool);     // graph.cpp
Command add_plot_command(CLI::App& tool);      // plot.cpp
Command add_generate_command(CLI::App& tool);
Command add_info_command(CLI::App& tool);
Command add_locate_command(CLI::App& tool);
Command add_nearest_command(CLI::App& tool);
Command add_interpolate_command(CLI::App& tool);    // remap_commands.cpp
Command add_apply_command(CLI::App& tool);          // remap_commands.cpp
Command add_check_weights_command(CLI::App& tool);  // remap_commands.cpp
Command add_remap_command(CLI::App& tool);          // remap_commands.cpp
Command add_mesh_command(CLI::App& tool);           // mesh.cpp

}  // namespace rondel::cli
