// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "comparison_report.h"

#include <cstddef>
#include <cstdio>
#include <optional>

#include "report.h"

namespace rondel::cli {
namespace {

// Returns the last decade in which there are errors and those around it, as "1e-16: 800, 1e-15: 12":
// how many are below each power of ten and not below the one before.
std::string distribution_of(const ErrorDistribution& errors) {
  std::string text;
  for (std::size_t bin = 0; bin < ErrorDistribution::num_bins; ++bin) {
    if (errors.counts[bin] == 0) continue;
    const bool is_last = bin + 1 == ErrorDistribution::num_bins;
    text += (text.empty() ? "" : ", ") + std::to_string(errors.counts[bin]) +
            (is_last ? " from 1 on" : " below " + short_number(ErrorDistribution::end_of(bin)));
  }
  return text;
}

std::string line_of(const ComparedRow& row) {
  char place[64];
  std::snprintf(place, sizeof place, "%.4f, %.4f", row.place.lon_deg, row.place.lat_deg);
  return "  target " + std::to_string(row.target) + " at " + place + ": " +
         count(row.wrong, "weight", "weights") + ", together " + short_number(row.error) +
         " off, most of source " + std::to_string(row.worst.source) + " (" +
         short_number(row.worst.given) + " instead of " + short_number(row.worst.exact) +
         "); sum " + short_number(row.sum) + " instead of " + short_number(row.exact_sum) + '\n';
}

nlohmann::ordered_json json_of_row(const ComparedRow& row) {
  return {{"target", row.target},
          {"place", {row.place.lon_deg, row.place.lat_deg}},
          {"error", row.error},
          {"wrong", row.wrong},
          {"sum", row.sum},
          {"exact_sum", row.exact_sum},
          {"worst",
           {{"source", row.worst.source}, {"given", row.worst.given}, {"exact", row.worst.exact}}}};
}

}  // namespace

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string comparison_summary(const WeightComparison& comparison, const std::string& said) {
  std::string text = "exact areas: " + count(comparison.pieces, "piece", "pieces") +
                     "; normalization " + std::string(name_of(comparison.norm)) +
                     (said.empty() ? std::string() : " (the file says " + said + ")") + '\n';
  if (comparison.are_sums) {
    text += "weights of second order: their sums are compared, not the weights\n";
  } else {
    text += "weights wrong: " + std::to_string(comparison.count("wrong weight")) +
            ", missing: " + std::to_string(comparison.count("missing piece")) +
            ", needless: " + std::to_string(comparison.count("needless weight")) +
            "; errors: largest " + short_number(comparison.max_error) + ", mean " +
            short_number(comparison.mean_error) + ", root of mean square " +
            short_number(comparison.rms_error) + '\n';
    text += "errors by size: " + distribution_of(comparison.errors) + '\n';
  }
  text += "sums of rows are right to " + short_number(comparison.row_sums) +
          ", areas that sources give away to " + short_number(comparison.local_conservation) +
          " (each), " + short_number(comparison.global_conservation) + " (all together)\n";
  if (comparison.source_areas && comparison.target_areas) {
    text += "areas in the file are those of the cells to " +
            short_number(*comparison.source_areas) + " (sources), " +
            short_number(*comparison.target_areas) + " (targets)\n";
  }
  if (comparison.worst_rows.empty()) return text;
  text += "worst rows:\n";
  for (const ComparedRow& row : comparison.worst_rows) text += line_of(row);
  return text;
}

nlohmann::ordered_json comparison_json(const WeightComparison& comparison) {
  const auto maybe = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  nlohmann::ordered_json errors = nlohmann::ordered_json::array();
  for (std::size_t bin = 0; bin < ErrorDistribution::num_bins; ++bin) {
    const bool is_last = bin + 1 == ErrorDistribution::num_bins;
    errors.push_back({{"below", is_last ? nlohmann::ordered_json()
                                        : nlohmann::ordered_json(ErrorDistribution::end_of(bin))},
                      {"count", comparison.errors.counts[bin]}});
  }
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ComparedRow& row : comparison.worst_rows) rows.push_back(json_of_row(row));
  return {{"normalization", name_of(comparison.norm)},
          {"sums_only", comparison.are_sums},
          {"pieces", comparison.pieces},
          {"wrong", comparison.count("wrong weight")},
          {"missing", comparison.count("missing piece")},
          {"needless", comparison.count("needless weight")},
          {"max_error", comparison.max_error},
          {"mean_error", comparison.mean_error},
          {"rms_error", comparison.rms_error},
          {"errors", errors},
          {"row_sums", comparison.row_sums},
          {"local_conservation", comparison.local_conservation},
          {"global_conservation", comparison.global_conservation},
          {"source_areas", maybe(comparison.source_areas)},
          {"target_areas", maybe(comparison.target_areas)},
          {"worst_rows", rows}};
}

}  // namespace rondel::cli
