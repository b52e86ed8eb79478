// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The options that several commands share.
///
/// in    the command line
/// out   their values; usage errors for options that change nothing
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "command.h"
#include "files_of_command.h"
#include "rondel/cell_rings.h"
#include "rondel/io.h"
#include "rondel/names.h"
#include "rondel/polygon_files.h"
#include "rondel/triangulation.h"

namespace rondel::cli {

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
  /// Returns format_of() OUTPUT.
  [[nodiscard]] std::string format() const { return format_of(target()); }
};

/// True if a file is GeoJSON by its format or its ending.
bool is_geojson(const FileName& file);
/// True if GDAL reads files of this format, which may have sites or features.
bool is_of_gdal(const FileName& file);
/// True for the same, and for standard input without a format.
bool may_have_features(const FileName& file);

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
    "The sites: .csv .tsv .xyz .txt .npy .geojson, with GDAL installed .gpkg .fgb .shp\n"
    ".parquet, the places of a netCDF file, or - for standard input. Longitude and\n"
    "latitude in degrees, or x, y, z.";

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

/// \throws UsageError if the name of a result beside OUTPUT has an ending other than .npy; it may
/// have none
void require_array(const char* option, const std::string& path);

/// Adds --delimiter, --radius, --lon, --lat, --x, --y, --z and --radians like add_input_options(),
/// for a table that is not INPUT. They are usage errors if all of `tables` are netCDF or grids;
/// --radius is one if the first of them is.
void add_table_options(CLI::App& command, CommonOptions& options, const TablesRead& tables);

/// Adds a required input file, which may be standard input.
CLI::Option* add_input_file(CLI::App& parser, const std::string& name, std::string& file,
                            const std::string& what);

/// Adds INPUT, its format and --output of a command that changes features.
void add_feature_files(CLI::App& parser, CommonOptions& options);

/// Adds --input-format of an INPUT that has polygons.
void add_polygon_format_option(CLI::App& parser, CommonOptions& options);

/// Adds a file of weights as INPUT. `of_others` ends the help of --input-format.
void add_weights_input(CLI::App& parser, CommonOptions& options, const std::string& of_others);

/// Adds --kind and --deflate.
/// \param written  returns the outputs of the command that are netCDF; none if there is no such
/// output
void add_netcdf_options(CLI::App& parser, CommonOptions& common, NetcdfOptions& options,
                        const std::function<std::vector<FileName>()>& written);

/// Returns the file if its format is one of these, else nothing.
std::vector<FileName> if_of_format(const FileName& file,
                                   std::initializer_list<std::string_view> formats);

/// Returns a name of the library as the tool has it, with - for _.
inline std::string word_of(std::string_view name) {
  std::string word(name);
  std::ranges::replace(word, '_', '-');
  return word;
}

/// Returns the values of an enumeration by the names that the library gives them, with - for _.
template <class Value>
std::unordered_map<std::string, Value> named_values() {
  std::unordered_map<std::string, Value> values;
  for (const std::string_view name : names_of<Value>()) {
    values.emplace(word_of(name), *from_name<Value>(name));
  }
  return values;
}

/// Returns the words of choices, sorted.
template <class Value>
std::vector<std::string> keys_of(const std::unordered_map<std::string, Value>& choices) {
  std::vector<std::string> words;
  words.reserve(choices.size());
  for (const auto& choice : choices) words.push_back(choice.first);
  std::ranges::sort(words);
  return words;
}

/// Returns a check that a text is one of these words, which shells complete (completion.h).
/// \param otherwise  ends the message "'foo' is none of linear, nearest"; empty: like this
CLI::Validator one_of(const std::vector<std::string>& words, const std::string& otherwise = {});

/// Returns the words that the check of an option lets through; none if it has no such check.
std::vector<std::string> words_of(CLI::Option& option);

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
      ->check(one_of(keys_of(choices)))
      ->type_name("WORD");
}

/// Adds --edges.
/// \param of  whose positions they join
CLI::Option* add_edges_option(CLI::App& parser, PolygonEdges& target,
                              const std::string& of = "INPUT");

/// Adds --invalid, the treatment of polygons that are not valid, or of what else is named.
CLI::Option* add_invalid_option(CLI::App& parser, InvalidPolygons& target,
                                const std::string& what = "polygons");

/// Adds --corners, for grids of two dimensions that have centers alone.
CLI::Option* add_corners_option(CLI::App& parser, MissingCorners& target);

}  // namespace rondel::cli
