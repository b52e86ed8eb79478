// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "regrid.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "rondel/extrapolate.h"
#include "rondel/names.h"
#include "rondel/regrid_ranks.h"

namespace rondel::cli {
namespace {

// Returns the word of the command line for the name of a value: "conservative-2nd".
std::string word_of(std::string_view name) {
  std::string word(name);
  std::ranges::replace(word, '_', '-');
  return word;
}

// Adds an option whose value is the word of a value of an enumeration.
template <class Value, class Take>
void add_word(CLI::App& command, const std::string& name, const Take& take,
              const std::string& what) {
  std::vector<std::string> words;
  for (const std::string_view each : names_of<Value>()) words.push_back(word_of(each));
  command
      .add_option_function<std::string>(
          name,
          [take](const std::string& word) {
            for (const std::string_view each : names_of<Value>()) {
              if (word_of(each) == word) take(*from_name<Value>(each));
            }
          },
          what)
      ->check(CLI::IsMember(words));
}

// Returns the two names of "u10,v10"; empty ones unless there is one comma.
std::pair<std::string, std::string> pair_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos) return {};
  return {text.substr(0, comma), text.substr(comma + 1)};
}

// Adds how cells are read, and what becomes of those that are missing or not valid.
void add_cells(CLI::App& command, RegridFileOptions& options) {
  CellFileOptions& cells = options.cells;
  add_word<CellOverlap>(
      command, "--overlap", [&options](CellOverlap overlap) { options.overlap = overlap; },
      "Cells of one side that overlap");
  add_word<GridSides>(
      command, "--sides", [&cells](GridSides sides) { cells.sides = sides; },
      "What cells of grids have in the north and south");
  add_word<PolygonEdges>(
      command, "--edges", [&cells](PolygonEdges edges) { cells.edges = edges; },
      "What joins positions of polygons");
  add_word<InvalidPolygons>(
      command, "--invalid", [&cells](InvalidPolygons invalid) { cells.invalid = invalid; },
      "What becomes of polygons that are not valid");
  add_word<MissingCorners>(
      command, "--corners", [&cells](MissingCorners corners) { cells.corners = corners; },
      "What to do where longitudes and latitudes of two dimensions have no bounds");
}

// Adds how targets without a value get one. The limits are for the method that --extrapolate names.
void add_extrapolation(CLI::App& command, RegridFileOptions& options) {
  const auto wanted = [&options]() -> ExtrapolationOptions& {
    if (!options.extrapolation) options.extrapolation.emplace();
    return *options.extrapolation;
  };
  CLI::Option* const method = command.add_option_function<std::string>(
      "--extrapolate",
      [wanted](const std::string& word) { wanted().method = *extrapolation_named(word); },
      "How targets without a value get one: nearest, idw or creep");
  method->check(
      CLI::IsMember({"nearest", "idw", "creep", "nearest_s2d", "inverse_dist", "creep_fill"}));
  command
      .add_option_function<double>(
          "--extrapolate-distance", [wanted](double km) { wanted().max_distance_km = km; },
          "How far from a target sources may be, in kilometers")
      ->needs(method)
      ->check(CLI::Range(0.0, 1e9));
  const auto whole = [&](const char* name, unsigned ExtrapolationOptions::*member, unsigned most,
                         const char* what) {
    command
        .add_option_function<unsigned>(
            name, [wanted, member](unsigned number) { wanted().*member = number; }, what)
        ->needs(method)
        ->check(CLI::Range(1U, most));
  };
  whole("--extrapolate-sources", &ExtrapolationOptions::neighbors, 1000, "idw: how many sources");
  whole("--extrapolate-exponent", &ExtrapolationOptions::exponent, 16,
        "idw: the power of the distance");
  whole("--extrapolate-levels", &ExtrapolationOptions::levels, 1'000'000,
        "creep: how many levels are filled");
}

// Adds vectors, limits of order 2 and the kind of netCDF.
void add_values(CLI::App& command, RegridFileOptions& options) {
  add_word<RemapLimiter>(
      command, "--limiter", [&options](RemapLimiter limiter) { options.limiter = limiter; },
      "conservative-2nd: none, bounds: no value is beyond those of its sources, or slopes: the "
      "gradient "
      "in a source leads to no value beyond those around it");
  command
      .add_option_function<std::vector<std::string>>(
          "--vector",
          [&options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) options.vectors.push_back(pair_of(text));
          },
          "EAST,NORTH: two variables that are components of vectors; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        const auto [east, north] = pair_of(text);
        return east.empty() || north.empty() ? "'" + text + "' is not EAST,NORTH" : std::string();
      });
  command
      .add_option_function<std::string>(
          "--kind",
          [&options](const std::string& word) {
            options.netcdf.kind = *from_name<NetcdfKind>(word);
          },
          "The format of netCDF: nc4, cdf5 or cdf2")
      ->check(CLI::IsMember({"nc4", "cdf5", "cdf2"}));
  command.add_option("--deflate", options.netcdf.deflate, "The compression of nc4, 0 to 9")
      ->check(CLI::Range(0, 9));
}

}  // namespace

CLI::App& add_regrid(CLI::App& tool, RegridArguments& arguments) {
  CLI::App& command = *tool.add_subcommand("regrid", "Bring the fields of a file to another grid");
  RegridFileOptions& options = arguments.options;
  command.add_option("INPUT", arguments.in, "netCDF with fields")->required();
  command.add_option("TARGET", arguments.target, "The name of a grid, or a file with cells")
      ->required();
  command.add_option("--output,-o", arguments.out, "Where to write the fields: .nc .nc4 .csv .npy")
      ->required();
  command.add_option("--value", options.names, "A variable; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--source", arguments.source,
                     "Where the fields are, if INPUT does not say it");
  add_word<FieldMethod>(
      command, "--method", [&options](FieldMethod method) { options.method = method; },
      "As of rondel regrid");
  add_word<RemapNorm>(
      command, "--norm", [&options](RemapNorm norm) { options.norm = norm; },
      "What sums are divided by");
  command.add_option("--max-missing", options.max_missing, "The share that may lack values")
      ->check(CLI::Range(0.0, 1.0));
  add_cells(command, options);
  add_extrapolation(command, options);
  add_values(command, options);
  command.add_option("--memory", options.memory, "The bytes of each process, such as 500M")
      ->transform(CLI::AsSizeValue(false));
  command.add_option("--tile", options.cells_per_tile, "The number of cells of a tile")
      ->check(CLI::Range(1U, 1'000'000'000U));
  command.add_flag("--resume", options.resume,
                   "Keep what is computed in OUTPUT.partial, and begin with what is there");
  command.add_option("--threads", arguments.threads, "Threads of each process; default: its share")
      ->check(CLI::Range(1U, 1024U));
  command.add_flag("--json", arguments.is_json, "Print a JSON object");
  command.add_flag("--quiet", arguments.is_quiet, "Print nothing");
  return command;
}

std::string common_part(const RegridArguments& arguments) {
  const RegridFileOptions& options = arguments.options;
  std::string text = "regrid\n";
  const auto add = [&](std::string_view part) { (text += part) += '\n'; };
  for (const std::string& part :
       {arguments.in, arguments.target, arguments.out, arguments.source}) {
    add(part);
  }
  for (const std::string& name : options.names) add(name);
  add(options.method ? name_of(*options.method) : "by kind");
  add(name_of(options.norm));
  add(name_of(options.overlap));
  add(name_of(options.cells.sides));
  add(std::to_string(options.max_missing));
  add(std::to_string(options.memory));
  add(std::to_string(options.cells_per_tile));
  add(options.resume ? "resume" : "");
  add(name_of(options.cells.edges));
  add(name_of(options.cells.invalid));
  add(name_of(options.cells.corners));
  add(name_of(options.limiter));
  for (const auto& [east, north] : options.vectors) {
    add(east);
    add(north);
  }
  add(name_of(options.netcdf.kind));
  add(std::to_string(options.netcdf.deflate));
  if (const auto& filling = options.extrapolation) {
    add(name_of(filling->method));
    add(filling->max_distance_km ? std::to_string(*filling->max_distance_km) : "any");
    for (const unsigned number : {filling->neighbors, filling->exponent, filling->levels}) {
      add(std::to_string(number));
    }
  }
  return text;
}

void regrid(Communicator& ranks, const RegridArguments& arguments, const Execution& execution) {
  const auto start = std::chrono::steady_clock::now();
  RegridFileOptions options = arguments.options;
  if (!arguments.source.empty()) options.source = FileName{arguments.source, {}};
  options.history = regrid_command(arguments.in, arguments.target, options);
  const RegridFileReport report = regrid_file(ranks, {arguments.in, {}}, {arguments.target, {}},
                                              {arguments.out, {}}, options, execution);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  if (ranks.rank() != 0) return;
  for (const std::string& remark : report.remarks) {
    std::fprintf(stderr, "rondel-mpi: %s\n", remark.c_str());
  }
  const auto number = [](std::uint64_t value) { return std::to_string(value); };
  if (arguments.is_json) {
    std::printf(
        "{\"sources\": %s, \"targets\": %s, \"fields\": %s, \"missing\": %s, \"tiles\": %s, "
        "\"extrapolated\": %s, \"resumed\": %s, \"ranks\": %d, \"seconds\": %.3f}\n",
        number(report.sources).c_str(), number(report.targets).c_str(),
        number(report.fields).c_str(), number(report.missing).c_str(), number(report.tiles).c_str(),
        number(report.extrapolated).c_str(), number(report.resumed).c_str(), ranks.size(),
        time.count());
  } else if (!arguments.is_quiet) {
    std::printf("%s fields from %s places to %s in %s, by %d processes in %.1f s\n",
                number(report.fields).c_str(), number(report.sources).c_str(),
                number(report.targets).c_str(), arguments.out.c_str(), ranks.size(), time.count());
  }
}

}  // namespace rondel::cli
