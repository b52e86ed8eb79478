// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "remap.h"
#include "report.h"
#include "rondel/weight_check.h"

namespace rondel::cli {
namespace {

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string hash_text(std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return hash == 0 ? std::string() : text;
}

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
          (report.sums_are_at_most_1 && report.least_row
               ? ", the least " + short_number(*report.least_row) +
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

std::string reason_of(const WeightReport& report) {
  std::string text;
  for (const WeightFault& fault : report.faults) text += (text.empty() ? "" : "; ") + fault.what;
  return text;
}

nlohmann::ordered_json faults_of(const WeightReport& report) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const WeightFault& fault : report.faults) {
    faults.push_back({{"kind", fault.kind}, {"count", fault.count}, {"what", fault.what}});
  }
  return faults;
}

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
          {"least_row_sum", maybe(report.least_row)},
          {"column_sums", maybe(report.worst_column)},
          {"direction", maybe(report.worst_direction)},
          {"method", file.method},
          {"normalization", file.normalization},
          {"source_hash", hash_text(weights.sites_hash)},
          {"target_hash", hash_text(weights.targets_hash)}};
}

}  // namespace

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

}  // namespace rondel::cli
