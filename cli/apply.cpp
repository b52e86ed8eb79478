// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <nlohmann/json.hpp>

#include "process.h"
#include "remap.h"
#include "report.h"

namespace rondel::cli {
namespace {

// A table that has the places of its values must have those of the weights.
void require_places(const ApplyCommandOptions& options, const Weights& weights) {
  if (weights.sites_hash == 0) return;
  SiteTable table;
  try {
    table = read_sites(options.values_file, options.common.read);
  } catch (const FileError&) {
    return;  // it has no places
  }
  if (point_set_hash(table.sites) == weights.sites_hash) return;
  throw FileError(table.name + ": its points are not the sources of " + options.common.input +
                  ", or not in this order");
}

bool is_table(const std::string& name) { return name.ends_with(".csv") || name.ends_with(".tsv"); }

std::size_t count_missing(const FieldSet& fields) {
  std::size_t number = 0;
  for (const FieldArray& array : fields.arrays) {
    number += static_cast<std::size_t>(
        std::ranges::count_if(array.values, [](double value) { return value != value; }));
  }
  return number;
}

}  // namespace

ExitStatus run_apply(const ApplyCommandOptions& options) {
  const CommonOptions& common = options.common;
  require_output(common, can_write_fields(common.target()), ".csv .tsv .npy .nc");
  Job job(common);
  WeightFile file = read_weights(common.source());
  const Weights& weights = file.weights;
  if (is_table(options.values_file)) require_places(options, weights);
  FieldSet in = read_fields(options.values_file, options.columns, weights.num_columns, common.read);
  FieldSet out;
  out.num_points = weights.num_rows();
  out.axes = std::move(in.axes);
  job.time(Stage::query, [&] {
    for (FieldArray& array : in.arrays) {
      const std::size_t count = array.num_fields();
      std::vector<double> values(count * out.num_points);
      apply(weights, array.values, values, count, options.apply, job.execution());
      array.values = std::move(values);
      out.arrays.push_back(std::move(array));
    }
  });
  job.time(Stage::write, [&] { write_fields(common.target(), out, file.target); });
  std::size_t num_fields = 0;
  for (const FieldArray& array : out.arrays) num_fields += array.num_fields();
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {
      {"sources", weights.num_columns},
      {"targets", weights.num_rows()},
      {"entries", weights.values.size()},
      {"fields", num_fields},
      {"missing", count_missing(out)},
      {"seconds", {{"apply", seconds.query}, {"write", seconds.write}, {"total", seconds.total}}},
      {"peak_memory_bytes", peak_memory_bytes()}};
  job.report(json.dump(2) + '\n', count(num_fields, "field", "fields") + " to " +
                                      count(weights.num_rows(), "target", "targets") + ", " +
                                      std::to_string(count_missing(out)) + " values missing\n");
  return done;
}

}  // namespace rondel::cli
