// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "remap.h"
#include "report.h"
#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

// A row sums up to 1 to this much, which weights of other programs reach: ESMF's own check has 1e-10 or
// more.
constexpr double row_tolerance = 1e-9;

struct WeightsReport {
  std::size_t empty_rows = 0;
  std::size_t bad_rows = 0;    // that do not sum up to 1
  std::size_t not_finite = 0;  // weights
  std::size_t repeated = 0;    // entries of a column that the row has had
  double least = 0;
  double greatest = 0;
  double worst_row = 0;                   // deviation of a sum from 1
  std::optional<double> worst_column;     // deviation of the area that a source gives from its own
  std::optional<double> worst_direction;  // |u x sum of w x|
  [[nodiscard]] bool is_wrong() const { return bad_rows + not_finite + repeated > 0; }
};

double length_of_cross(const Point& a, const Point& b) {
  const double x = a.y * b.z - a.z * b.y;
  const double y = a.z * b.x - a.x * b.z;
  const double z = a.x * b.y - a.y * b.x;
  return std::sqrt(x * x + y * y + z * z);
}

// `sum_wanted`: what the row should sum up to.
void check_row(const Weights& weights, std::size_t row, double sum_wanted,
               std::vector<std::size_t>& last_row, WeightsReport& report) {
  const std::uint64_t begin = weights.offsets[row];
  const std::uint64_t end = weights.offsets[row + 1];
  if (begin == end) ++report.empty_rows;
  if (begin == end) return;
  double sum = 0;
  for (std::uint64_t k = begin; k < end; ++k) {
    const double weight = weights.values[k];
    sum += weight;
    if (!std::isfinite(weight)) ++report.not_finite;
    report.least = k == 0 ? weight : std::min(report.least, weight);
    report.greatest = k == 0 ? weight : std::max(report.greatest, weight);
    std::size_t& last = last_row[weights.columns[k]];
    if (last == row + 1) ++report.repeated;
    last = row + 1;
  }
  const double deviation = std::abs(sum - sum_wanted);
  report.worst_row = std::max(report.worst_row, deviation);
  if (!(deviation <= row_tolerance)) ++report.bad_rows;
}

// Conservation: the area that all targets take of a source is that of its part that they cover.
std::optional<double> worst_column(const WeightFile& file) {
  const std::vector<double>& to = file.target.areas;
  const std::vector<double>& from = file.source.areas;
  if (to.empty() || from.empty()) return std::nullopt;
  const Weights& weights = file.weights;
  std::vector<double> taken(weights.num_columns);
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    const bool is_shared = file.normalization == "fracarea" && !file.target.fractions.empty();
    const double area = to[r] * (is_shared ? file.target.fractions[r] : 1);
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      taken[weights.columns[k]] += weights.values[k] * area;
    }
  }
  double worst = 0;
  for (std::size_t c = 0; c < taken.size(); ++c) {
    const double fraction = file.source.fractions.empty() ? 1 : file.source.fractions[c];
    if (from[c] > 0) worst = std::max(worst, std::abs(taken[c] / from[c] - fraction));
  }
  return worst;
}

std::optional<double> worst_direction(const WeightFile& file) {
  if (file.source.points.empty() || file.target.points.empty()) return std::nullopt;
  const Weights& weights = file.weights;
  const std::vector<Point> sources = unit_vectors(file.source.points);
  const std::vector<Point> targets = unit_vectors(file.target.points);
  double worst = 0;
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    Point sum;
    for (std::uint64_t k = weights.offsets[r]; k < weights.offsets[r + 1]; ++k) {
      const Point& x = sources[weights.columns[k]];
      sum.x += weights.values[k] * x.x;
      sum.y += weights.values[k] * x.y;
      sum.z += weights.values[k] * x.z;
    }
    worst = std::max(worst, length_of_cross(targets[r], sum));
  }
  return worst;
}

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

std::string summary_of(const WeightFile& file, const WeightsReport& report) {
  const Weights& weights = file.weights;
  std::string text = count(weights.num_rows(), "row", "rows") + " of " +
                     count(weights.num_columns, "column", "columns") + ", " +
                     count(weights.values.size(), "entry", "entries") +
                     "; empty rows: " + std::to_string(report.empty_rows) + '\n';
  text += "weights from " + short_number(report.least) + " to " + short_number(report.greatest) +
          "; sums of rows are 1 to " + short_number(report.worst_row) + '\n';
  if (report.worst_column) {
    text += "areas of sources are given away to " + short_number(*report.worst_column) + '\n';
  }
  if (report.worst_direction) {
    text +=
        "weighted sources point to the targets to " + short_number(*report.worst_direction) + '\n';
  }
  return text;
}

std::string reason_of(const WeightsReport& report) {
  if (report.not_finite > 0) {
    return count(report.not_finite, "weight is", "weights are") + " not finite";
  }
  if (report.repeated > 0) {
    return count(report.repeated, "entry repeats", "entries repeat") + " a column of the row";
  }
  return count(report.bad_rows, "row sums", "rows sum") + " up to something else than 1";
}

nlohmann::ordered_json json_of(const WeightFile& file, const WeightsReport& report) {
  const auto maybe = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const Weights& weights = file.weights;
  return {{"valid", !report.is_wrong()},
          {"reason", report.is_wrong() ? reason_of(report) : ""},
          {"rows", weights.num_rows()},
          {"columns", weights.num_columns},
          {"entries", weights.values.size()},
          {"empty_rows", report.empty_rows},
          {"bad_rows", report.bad_rows},
          {"least", report.least},
          {"greatest", report.greatest},
          {"row_sums", report.worst_row},
          {"column_sums", maybe(report.worst_column)},
          {"direction", maybe(report.worst_direction)},
          {"method", file.method},
          {"normalization", file.normalization},
          {"source_hash", hash_text(weights.sites_hash)},
          {"target_hash", hash_text(weights.targets_hash)}};
}

}  // namespace

ExitStatus run_check_weights(const CommonOptions& options) {
  Job job(options);
  const WeightFile file = read_weights(options.source());
  WeightsReport report;
  std::vector<std::size_t> last_row(file.weights.num_columns);
  for (std::size_t r = 0; r < file.weights.num_rows(); ++r) {
    const bool is_part = file.normalization == "destarea" && !file.target.fractions.empty();
    check_row(file.weights, r, is_part ? file.target.fractions[r] : 1, last_row, report);
  }
  report.worst_column = worst_column(file);
  report.worst_direction = worst_direction(file);
  job.report(json_of(file, report).dump(2) + '\n', summary_of(file, report));
  if (!report.is_wrong()) return done;
  if (options.json) return failed;
  throw FileError(options.input + ": " + reason_of(report));
}

}  // namespace rondel::cli
