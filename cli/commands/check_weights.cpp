// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel check-weights: tells what is wrong with a file of weights.
// in    a file of weights: ESMF, SCRIP (as CDO writes it), or .npz (SciPy)
// out   a summary or one JSON object; nothing is written
// index rows are targets, columns are sources, from 0
//
// The checks themselves are those of rondel/weight_check.h; this file prints their report.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "job.h"
#include "report.h"
#include "rondel/weight_check.h"
#include "rondel/weight_files.h"

namespace rondel::cli {
namespace {

// The options of `rondel check-weights`.
struct CheckWeightsOptions {
  CommonOptions common;      // INPUT: the weights
  WeightCheckOptions check;  // --allow-negative
};

// Returns a number in three digits, for the summary.
std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

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
std::string reason_of(const WeightReport& report) {
  std::string text;
  for (const WeightFault& fault : report.faults) text += (text.empty() ? "" : "; ") + fault.what;
  return text;
}

// Returns the faults as an array of objects; its keys are a contract, like those of json_of().
nlohmann::ordered_json faults_of(const WeightReport& report) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const WeightFault& fault : report.faults) {
    faults.push_back({{"kind", fault.kind}, {"count", fault.count}, {"what", fault.what}});
  }
  return faults;
}

// Returns the object of --json; a number that the file does not allow to compute is null.
nlohmann::ordered_json json_of(const WeightFile& file, const WeightReport& report) {
  const auto maybe = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const Weights& weights = file.weights;
  return {{"valid", report.faults.empty()},
          {"reason", reason_of(report)},
          {"faults", faults_of(report)},
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
}

// Reads the weights and prints the report. The exit status is `failed` if there is a fault: with
// --json the report is the message, otherwise FileError is thrown with all faults in one line.
ExitStatus run_check_weights(const CheckWeightsOptions& options) {
  const CommonOptions& common = options.common;
  Job job(common);
  const WeightFile file = read_weights(common.source());
  tell(common.input, file.remarks);
  const WeightReport report = check_weights(file, options.check);
  std::string summary = summary_of(file, report);
  for (const WeightFault& fault : report.faults) summary += "wrong: " + fault.what + '\n';
  job.report(json_of(file, report).dump(2) + '\n', summary);
  if (report.faults.empty()) return done;
  if (common.json) return failed;
  throw FileError(common.input + ": " + reason_of(report));
}

}  // namespace

Command add_check_weights_command(CLI::App& tool) {
  auto options = std::make_shared<CheckWeightsOptions>();
  CLI::App* parser = tool.add_subcommand("check-weights", "Check a file of weights");
  add_weights_input(*parser, options->common, "");
  parser->add_flag("--allow-negative", options->check.allow_negative,
                   "Negative weights are right whatever the file says of its method");
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
      "Example:\n"
      "  rondel check-weights weights.nc");
  return {parser, [options] { return run_check_weights(*options); }};
}

}  // namespace rondel::cli
