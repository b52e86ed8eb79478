// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/interpolate.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "column_values.h"
#include "process.h"
#include "remap.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace rondel::cli {
namespace {

// The sites that have a value, with their places in the file.
SiteTable with_values(const SiteTable& table, std::vector<double>& values) {
  SiteTable kept;
  kept.name = table.name;
  kept.first_line = table.first_line;
  std::vector<double> known;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    known.push_back(values[i]);
    kept.sites.push_back(table.sites[i]);
    if (!table.lines.empty()) {
      kept.lines.push_back(table.lines[i]);
    } else if (table.first_line != 0) {
      kept.lines.push_back(table.first_line + i);
    }
  }
  values = std::move(known);
  return kept;
}

struct InterpolateCounts {
  std::size_t sites = 0;
  std::size_t targets = 0;
  std::size_t left_out = 0;  // values of sites that are not there
  std::size_t missing = 0;   // values of targets, or rows, that are not there
};

void report(Job& job, const InterpolateOptions& options, const InterpolateCounts& counts) {
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"sites", counts.sites},
                                       {"targets", counts.targets},
                                       {"left_out", counts.left_out},
                                       {"missing", counts.missing},
                                       {"seconds",
                                        {{"read", seconds.read},
                                         {"interpolate", seconds.query},
                                         {"write", seconds.write},
                                         {"total", seconds.total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  std::string text =
      count(counts.sites, "site", "sites") + " to " + count(counts.targets, "target", "targets");
  if (counts.left_out > 0)
    text += ", left out " + std::to_string(counts.left_out) + " without value";
  text += "; targets without value: " + std::to_string(counts.missing) + '\n';
  if (!options.weights.empty()) text += "wrote the weights to " + options.weights + '\n';
  job.report(json.dump(2) + '\n', text);
}

Triangulation triangulated(Job& job, const InterpolateOptions& options, const SiteTable& table) {
  Triangulation triangulation = job.triangulate(table);
  const auto duplicates = triangulation.duplicates();
  if (options.interpolation.shared_place == SharedPlace::error && !duplicates.empty()) {
    throw FileError(table.where(duplicates.front().site) + ": the place of " +
                    table.where(duplicates.front().representative));
  }
  return triangulation;
}

// One triangulation for all columns without gaps, one more for each that has some.
void interpolate_columns(Job& job, const InterpolateOptions& options, const SiteTable& table,
                         const Targets& targets, InterpolateCounts& counts) {
  FieldSet fields;
  fields.num_points = targets.table.sites.size();
  std::optional<Interpolator> whole;
  for (const std::string& name : options.columns) {
    std::vector<double> values = column_values(table, name, "--value");
    const SiteTable kept = with_values(table, values);
    const bool is_whole = kept.sites.size() == table.sites.size();
    counts.left_out += table.sites.size() - kept.sites.size();
    std::optional<Interpolator> own;
    if (!is_whole) own.emplace(triangulated(job, options, kept));
    if (is_whole && !whole) whole.emplace(triangulated(job, options, table));
    FieldArray array;
    array.name = name;
    job.time(Stage::query, [&] {
      const Interpolator& interpolator = is_whole ? *whole : *own;
      array.values = with_places(targets.table, [&] {
        return interpolator.values(values, targets.table.sites, options.interpolation,
                                   job.execution());
      });
    });
    counts.missing += static_cast<std::size_t>(
        std::ranges::count_if(array.values, [](double value) { return std::isnan(value); }));
    fields.arrays.push_back(std::move(array));
  }
  job.time(Stage::write, [&] { write_fields(options.common.target(), fields, targets.side); });
}

constexpr const char* method_names[] = {"nearest", "linear",  "laplace",
                                        "sibson",  "hermite", "cubic"};

void write_weights_of(Job& job, const InterpolateOptions& options, const SiteTable& table,
                      Targets& targets, InterpolateCounts& counts) {
  const Triangulation triangulation = triangulated(job, options, table);
  const Interpolator interpolator(triangulation);
  WeightFile file;
  job.time(Stage::query, [&] {
    file.weights = with_places(targets.table, [&] {
      return interpolator.weights(targets.table.sites, options.interpolation, job.execution());
    });
  });
  file.method = method_names[static_cast<std::size_t>(options.interpolation.method)];
  file.normalization = "none";
  file.source.points = table.is_lonlat() ? table.positions : lonlats(table.sites);
  job.time(Stage::dual, [&] { file.source.areas = areas(triangulation, job.execution()); });
  file.target = std::move(targets.side);
  add_grid_cells(file.target);
  for (std::size_t r = 0; r < file.weights.num_rows(); ++r) {
    if (file.weights.offsets[r] == file.weights.offsets[r + 1]) ++counts.missing;
  }
  job.time(Stage::write, [&] { write_weights({options.weights, options.weight_format}, file); });
}

}  // namespace

ExitStatus run_interpolate(const InterpolateOptions& options) {
  const CommonOptions& common = options.common;
  const bool has_values = !options.columns.empty();
  if (has_values != !common.output.empty()) {
    throw UsageError("--value and --output go together: values of a column to a file");
  }
  if (!has_values && options.weights.empty()) {
    throw UsageError("nothing to do: --value COL -o FILE, or --weights FILE");
  }
  if (has_values) {
    require_output(common, can_write_fields(common.target()), ".csv .tsv .npy .nc");
  }
  Job job(common);
  ReadOptions read = common.read;
  read.keep_columns = has_values;
  const SiteTable table = job.read(common.source(), read);
  Targets targets = read_targets(options.target, common.read);
  InterpolateCounts counts{table.sites.size(), targets.table.sites.size(), 0, 0};
  if (has_values) interpolate_columns(job, options, table, targets, counts);
  if (!options.weights.empty()) {
    counts.missing = 0;
    write_weights_of(job, options, table, targets, counts);
  }
  report(job, options, counts);
  return done;
}

}  // namespace rondel::cli
