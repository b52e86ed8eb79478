// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel check-weights: tells what is wrong with a file of weights.
// in    a file of weights: ESMF, SCRIP (as CDO writes it), YAC, or .npz (SciPy); maybe the cells of
//       both sides
// out   a summary or one JSON object; nothing is written
// index rows are targets, columns are sources, from 0
//
// The checks themselves are those of rondel/weight_check.h and rondel/weight_comparison.h; this file
// prints their reports.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cell_sides.h"
#include "comparison_report.h"
#include "job.h"
#include "report.h"
#include "rondel/weight_check.h"
#include "rondel/weight_comparison.h"
#include "rondel/weight_files.h"
#include "validate.h"

namespace rondel::cli {
namespace {

// The options of `rondel check-weights`.
struct CheckWeightsOptions {
  CommonOptions common;             // INPUT: the weights
  WeightCheckOptions check;         // --allow-negative
  std::string source;               // --source
  std::string target;               // --target
  CellFileOptions cells;            // --sides --edges --invalid --corners
  WeightComparisonOptions compare;  // --tolerance --overlap

  [[nodiscard]] bool has_sides() const { return !source.empty() && !target.empty(); }
};

// What is known of a file: what it says itself, and what the cells of both sides say.
struct JudgedWeights {
  WeightFile file;
  WeightReport report;
  std::optional<WeightComparison> comparison = std::nullopt;

  // Returns the faults of both.
  [[nodiscard]] std::vector<WeightFault> faults() const {
    std::vector<WeightFault> all = report.faults;
    if (comparison) std::ranges::copy(comparison->faults, std::back_inserter(all));
    return all;
  }
};

// Returns a hash of points in 16 hexadecimal digits; empty for 0, which stands for no hash.
std::string hash_text(std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return hash == 0 ? std::string() : text;
}

// Returns a few lines: the size of the matrix, the range of the weights, and how far sums and
// directions are off. A line about areas or places is left out where the file has none.
std::string summary_of(const WeightFile& file, const WeightReport& report) {
  const Weights& weights = file.weights;
  std::string text = count(weights.num_rows(), "row", "rows") + " of " +
                     count(weights.num_columns, "column", "columns") + ", " +
                     count(weights.values.size(), "entry", "entries") +
                     "; empty rows: " + std::to_string(report.empty_rows) + '\n';
  text += "weights from " + short_number(report.least) + " to " + short_number(report.greatest) +
          "; sums of " + (report.sums_are_of_columns ? "columns" : "rows") + " are " +
          (report.sums_are_at_most_1   ? "at most 1"
           : report.sums_are_fractions ? "the fractions"
                                       : "1") +
          " to " + short_number(report.worst_row) +
          (report.sums_are_at_most_1 && report.min_row
               ? ", the least " + short_number(*report.min_row) +
                     " (the fractions of the targets are not known)"
               : "") +
          '\n';
  if (report.worst_column) {
    text += "areas of sources are given away to " + short_number(*report.worst_column) + '\n';
  }
  if (report.worst_direction) {
    text +=
        "weighted sources point to the targets to " + short_number(*report.worst_direction) + '\n';
  }
  return text;
}

// Returns all faults in one line; empty if there are none.
std::string reason_of(const std::vector<WeightFault>& faults) {
  std::string text;
  for (const WeightFault& fault : faults) text += (text.empty() ? "" : "; ") + fault.what;
  return text;
}

// Returns the faults as an array of objects; its keys are a contract, like those of json_of().
nlohmann::ordered_json json_of_faults(const std::vector<WeightFault>& all) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const WeightFault& fault : all) {
    faults.push_back({{"kind", fault.kind}, {"count", fault.count}, {"what", fault.what}});
  }
  return faults;
}

// Returns the object of --json; a number that the file does not allow to compute is null.
nlohmann::ordered_json json_of(const JudgedWeights& judged) {
  const auto& [file, report, comparison] = judged;
  const std::vector<WeightFault> faults = judged.faults();
  const auto maybe = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const Weights& weights = file.weights;
  nlohmann::ordered_json json = {{"valid", faults.empty()},
                                 {"reason", reason_of(faults)},
                                 {"faults", json_of_faults(faults)},
                                 {"rows", weights.num_rows()},
                                 {"columns", weights.num_columns},
                                 {"entries", weights.values.size()},
                                 {"empty_rows", report.empty_rows},
                                 {"bad_rows", report.count("row sum")},
                                 {"least", report.least},
                                 {"greatest", report.greatest},
                                 {"row_sums", report.worst_row},
                                 {"min_row_sum", maybe(report.min_row)},
                                 {"column_sums", maybe(report.worst_column)},
                                 {"direction", maybe(report.worst_direction)},
                                 {"method", file.method},
                                 {"normalization", file.normalization},
                                 {"source_hash", hash_text(weights.sites_hash)},
                                 {"target_hash", hash_text(weights.targets_hash)}};
  if (comparison) json["exact"] = comparison_json(*comparison);
  return json;
}

// Reads the weights, and the cells if they are given, and judges them.
JudgedWeights judge(const CheckWeightsOptions& options, Job& job) {
  const CommonOptions& common = options.common;
  WeightReadOptions read{.are_checked = true};
  CellSet source;
  CellSet target;
  if (options.has_sides()) {
    const CellSideOptions rules{options.cells, options.compare.overlap, common.read};
    job.time(Stage::dual, [&] {
      source = cells_of_side({options.source, {}}, rules, job);
      target = cells_of_side({options.target, {}}, rules, job);
    });
    read.num_sources = source.num_cells();
    read.num_targets = target.num_cells();
  }
  JudgedWeights judged{read_weights(common.source(), read), {}};
  WeightCheckOptions check = options.check;
  check.is_conservative = options.has_sides();
  check.targets_overlap = options.compare.overlap == CellOverlap::each;
  judged.report = check_weights(judged.file, check);
  if (!options.has_sides()) return judged;
  job.time(Stage::query, [&] {
    try {
      judged.comparison =
          compare_weights(judged.file, source, target, options.compare, job.execution());
    } catch (const InvalidInput& error) {
      throw FileError(common.input + ": " + error.what());
    }
  });
  return judged;
}

// Judges the weights and prints the report. The exit status is `failed` if there is a fault: with
// --json the report is the message, otherwise FileError is thrown with all faults in one line.
ExitStatus run_check_weights(const CheckWeightsOptions& options) {
  const CommonOptions& common = options.common;
  if (options.source.empty() != options.target.empty()) {
    throw UsageError("--source and --target are given together");
  }
  Job job(common);
  const JudgedWeights judged = judge(options, job);
  tell(common.input, judged.file.remarks);
  const std::vector<WeightFault> faults = judged.faults();
  std::string summary = summary_of(judged.file, judged.report);
  if (judged.comparison) {
    summary += comparison_summary(*judged.comparison, judged.file.normalization);
  }
  for (const WeightFault& fault : faults) summary += "wrong: " + fault.what + '\n';
  job.report(json_of(judged).dump(2) + '\n', summary);
  if (faults.empty()) return done;
  if (common.json) return failed;
  throw FileError(common.input + ": " + reason_of(faults));
}

// Adds the cells of both sides and what they are compared by.
void add_sides(CLI::App& parser, CheckWeightsOptions& options) {
  const char* const names[] = {"--source", "--target"};
  std::string* const sides[] = {&options.source, &options.target};
  const char* const whats[] = {
      "The cells of the sources, to compare the weights with exact areas: netCDF, the name\n"
      "of a grid, polygons, or sites, as for rondel remap",
      "The cells of the targets, in the same forms"};
  for (std::size_t k = 0; k < 2; ++k) {
    parser.add_option(names[k], *sides[k], whats[k])->type_name("GRID");
  }
  std::vector<const CLI::Option*> others;
  others.push_back(parser
                       .add_option("--tolerance", options.compare.tolerance,
                                   "How far a weight may be from the right one (default 1e-9)")
                       ->check([](const std::string& text) { return range_error(text, 0, 1); })
                       ->type_name("NUMBER"));
  const CLI::Option* const overlap = add_word<CellOverlap>(
      parser, "--overlap", options.compare.overlap, named_values<CellOverlap>(),
      "What becomes of a place that several cells of one side have, as for rondel remap;\n"
      "with each, also without cells, fractions of sources may be above 1");
  require_effect(
      options.common, overlap,
      [&options] { return options.has_sides() || options.compare.overlap == CellOverlap::each; },
      "without --source and --target");
  others.push_back(add_word<GridSides>(
      parser, "--sides", options.cells.sides, named_values<GridSides>(),
      "What cells of grids have in the north and south: parallels (default) or\n"
      "great-circles (ESMF's)"));
  others.push_back(add_word<PolygonEdges>(
      parser, "--edges", options.cells.edges, named_values<PolygonEdges>(),
      "What joins positions of polygons: lonlat (default) or geodesic (great circles)"));
  others.push_back(add_invalid_option(parser, options.cells.invalid, "cells and polygons"));
  others.push_back(add_corners_option(parser, options.cells.corners));
  add_threads_option(parser, options.common);
  for (const CLI::Option* const option : others) {
    require_effect(
        options.common, option, [&options] { return options.has_sides(); },
        "without --source and --target");
  }
}

}  // namespace

Command add_check_weights_command(CLI::App& tool) {
  auto options = std::make_shared<CheckWeightsOptions>();
  CLI::App* parser = tool.add_subcommand("check-weights", "Check a file of weights");
  add_weights_input(*parser, options->common, "");
  parser->add_flag("--allow-negative", options->check.allow_negative,
                   "Negative weights are right whatever the file says of its method");
  add_sides(*parser, *options);
  add_report_options(*parser, options->common);
  parser->footer(
      "A file is wrong if\n"
      "- a weight is not finite, or a source stands twice in one row;\n"
      "- a row with entries does not sum up to 1 or, normalized by destarea, to the fraction\n"
      "  of its target; where sources are given to their nearest targets (nearest_d2s, nearest\n"
      "  destination to source), a source with entries is not given away as a whole, once;\n"
      "- a fraction is above 1, negative or not a number, or an area negative or not finite;\n"
      "- cells of a conservative method with entries have no areas, or areas that are all 0, but\n"
      "  those of the other side have some;\n"
      "- a weight is negative although the method is an average: conservative of first order,\n"
      "  nearest, linear, laplace, sibson, largest share. Weights of second order, bilinear,\n"
      "  patch, hermite and cubic may be negative, and those of methods that are not known;\n"
      "- a cell that the file masks has a weight other than 0;\n"
      "- a conservative method gives nothing to a target with a fraction, or takes from a source\n"
      "  another area than its own times its fraction.\n"
      "Sums and fractions may be off by 1e-9 + (m + 1) 8 pi 2^-52 / A: m is the number of\n"
      "entries of the row or column, A the area of the cell in steradians, where it is known,\n"
      "and 8 pi 2^-52 what rounding makes of an area that is a difference of angles.\n\n"
      "Each kind of fault is one line with its number and the first place. Exit status: 0 if\n"
      "nothing is wrong, 1 if something is or the file cannot be read. Reported, but no fault:\n"
      "empty rows, the range, and the length of u x (sum of w x), u a target and x the sources\n"
      "(with points).\n\n"
      "With --source and --target, the cells for which conservative weights were made, each\n"
      "weight is compared with the area that its two cells have in common, whichever program\n"
      "made it (ESMF, CDO, YAC, TempestRemap ...). A file is then wrong, too, if\n"
      "- cells with a common area have no weight, or cells without one have one, which those of\n"
      "  second order may;\n"
      "- a weight is off by more than --tolerance and the rounding above; of second order, which\n"
      "  depends on gradients, the sum of a row or the area that a source gives away is;\n"
      "- the weights are normalized otherwise than the file says;\n"
      "- numbers of sources or targets are off by one, or places are outside of their cells.\n"
      "The report has the worst rows with their places, errors by size, and what is conserved.\n\n"
      "Examples:\n"
      "  rondel check-weights weights.nc\n"
      "  rondel check-weights weights.nc --source ocean.nc --target grid:10");
  return {parser, [options] { return run_check_weights(*options); }};
}

}  // namespace rondel::cli
