// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "process.h"
#include "remap.h"
#include "report.h"
#include "rondel/delaunay.h"

namespace rondel::cli {
namespace {

// How far a place in netCDF may be from its source: longitudes of floats are off by up to 8e-6 degrees.
constexpr double most_apart_deg = 1e-4;
constexpr double most_apart = most_apart_deg * std::numbers::pi / 180;

bool is_near(const Point& a, const Point& b) {
  const double x = a.x - b.x;
  const double y = a.y - b.y;
  const double z = a.z - b.z;
  return x * x + y * y + z * z <= most_apart * most_apart;
}

// Values that have places must have those of the weights. Tables must have the very numbers, if the
// hash of the sources is known.
void require_places(const ApplyCommandOptions& options, const WeightFile& file,
                    const std::vector<Point>& places, bool is_exact) {
  const std::uint64_t hash = file.weights.sites_hash;
  if (hash != 0 && point_set_hash(places) == hash) return;
  if (hash == 0 || !is_exact) {
    const std::vector<LonLat>& sources = file.source.points;
    const auto is_place = [](const LonLat& place) { return std::abs(place.lat_deg) <= 90; };
    if (sources.size() != places.size() || !std::ranges::all_of(sources, is_place)) return;
    // Of a table the points may be anywhere on their rays.
    if (std::ranges::equal(unit_vectors(lonlats(places)), unit_vectors(sources), is_near)) return;
  }
  throw FileError(options.values_file + ": its points are not the sources of " +
                  options.common.input + ", or not in this order");
}

void require_places_of_table(const ApplyCommandOptions& options, const WeightFile& file) {
  if (file.weights.sites_hash == 0 && file.source.points.empty()) return;
  SiteTable table;
  try {
    table = read_sites(options.values_file, options.common.read);
  } catch (const FileError&) {
    return;  // it has no places
  }
  require_places(options, file, table.sites, true);
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
  if (is_table(options.values_file)) require_places_of_table(options, file);
  FieldSet in = read_fields(options.values_file, options.columns, weights.num_columns, common.read,
                            file.source.shape);
  tell(options.values_file, in.remarks);
  if (!in.points.empty()) require_places(options, file, in.points, false);
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
