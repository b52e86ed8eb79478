// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/interpolate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "column_values.h"
#include "netcdf_part.h"
#include "process.h"
#include "remap.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace rondel::cli {
namespace {

// The sites and the fields are read from one file.
constexpr double same_places_deg = 1e-9;

struct InterpolateCounts {
  std::size_t sites = 0;
  std::size_t targets = 0;
  std::size_t duplicates = 0;  // sites in the place of another one
  std::size_t left_out = 0;    // values of sites that are not there
  std::size_t missing = 0;     // values of targets, or rows, that are not there
};

void report(Job& job, const InterpolateOptions& options, const InterpolateCounts& counts) {
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"sites", counts.sites},
                                       {"targets", counts.targets},
                                       {"duplicates", counts.duplicates},
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
  if (counts.duplicates > 0) {
    text += ", " + count(counts.duplicates, "duplicate", "duplicates") +
            (options.interpolation.shared_place == SharedPlace::mean ? " (the mean counts)"
                                                                     : " (the first site counts)");
  }
  if (counts.left_out > 0)
    text += ", left out " + std::to_string(counts.left_out) + " without value";
  text += "; targets without value: " + std::to_string(counts.missing) + '\n';
  if (!options.weights.empty()) text += "wrote the weights to " + options.weights + '\n';
  job.report(json.dump(2) + '\n', text);
}

Triangulation triangulated(Job& job, const InterpolateOptions& options, const SiteTable& table,
                           InterpolateCounts& counts) {
  Triangulation triangulation = job.triangulate(table);
  const auto duplicates = triangulation.duplicates();
  if (options.interpolation.shared_place == SharedPlace::error && !duplicates.empty()) {
    throw FileError(table.where(duplicates.front().site) + ": the place of " +
                    table.where(duplicates.front().representative));
  }
  counts.duplicates = std::max(counts.duplicates, duplicates.size());
  return triangulation;
}

// Interpolates fields at the targets. Methods of regridding have weights. All fields without gaps
// share one triangulation; successive fields with the same gaps share another one.
class FieldCarrier {
 public:
  FieldCarrier(Job& job, const InterpolateOptions& options, const SiteTable& table,
               const Targets& targets, const std::optional<Weights>& weights,
               InterpolateCounts& counts)
      : job_(job),
        options_(options),
        table_(table),
        targets_(targets),
        weights_(weights),
        counts_(counts) {}

  std::vector<double> carry(std::vector<double> values) {
    std::vector<double> carried(targets_.table.sites.size());
    if (weights_) {
      job_.time(Stage::query, [&] { apply(*weights_, values, carried, 1, {}, job_.execution()); });
    } else {
      carried = interpolated(std::move(values));
    }
    counts_.missing += static_cast<std::size_t>(
        std::ranges::count_if(carried, [](double value) { return std::isnan(value); }));
    return carried;
  }

 private:
  std::vector<double> interpolated(std::vector<double> values) {
    std::vector<bool> is_known;
    is_known.reserve(values.size());
    for (const double value : values) is_known.push_back(!std::isnan(value));
    const bool is_whole = std::ranges::find(is_known, false) == is_known.end();
    std::optional<Interpolator>& interpolator = is_whole ? whole_ : partial_;
    if (!is_whole && is_known != is_known_) interpolator.reset();
    if (is_whole && !interpolator)
      interpolator.emplace(triangulated(job_, options_, table_, counts_));
    if (!is_whole) {
      counts_.left_out += std::erase_if(values, [](double value) { return std::isnan(value); });
      if (!interpolator) {
        kept_ = table_.selection(is_known);
        interpolator.emplace(triangulated(job_, options_, kept_, counts_));
        is_known_ = std::move(is_known);
      }
    }
    std::vector<double> carried;
    job_.time(Stage::query, [&] {
      carried = with_places(targets_.table, [&] {
        return interpolator->values(values, targets_.table.sites, options_.interpolation,
                                    job_.execution());
      });
    });
    return carried;
  }

  Job& job_;
  const InterpolateOptions& options_;
  const SiteTable& table_;
  const Targets& targets_;
  const std::optional<Weights>& weights_;  // of a method of regridding
  InterpolateCounts& counts_;
  std::optional<Interpolator> whole_;
  std::optional<Interpolator> partial_;
  SiteTable kept_;  // the sites of `partial_`
  std::vector<bool> is_known_;
};

void interpolate_columns(Job& job, const InterpolateOptions& options, const SiteTable& table,
                         const Targets& targets, const std::optional<Weights>& weights,
                         InterpolateCounts& counts) {
  FieldSet fields;
  fields.num_points = targets.table.sites.size();
  FieldCarrier carrier(job, options, table, targets, weights, counts);
  for (const std::string& name : options.columns) {
    FieldArray array;
    array.name = name;
    array.values = carrier.carry(column_values(table, name, "--value"));
    fields.arrays.push_back(std::move(array));
  }
  job.time(Stage::write,
           [&] { write_fields(options.common.target(), fields, targets.side, options.netcdf); });
}

// Interpolates the fields of a netCDF file, for all indices of their other dimensions; one field at
// a time is in memory.
void interpolate_fields(Job& job, const InterpolateOptions& options, const NetcdfSites& grid,
                        const Targets& targets, const std::optional<Weights>& weights,
                        InterpolateCounts& counts) {
  const SiteTable& table = grid.table;
  const auto [file, variable] = netcdf_part(options.source_file());
  std::vector<std::string> names = options.columns;
  if (names.empty() && !variable.empty()) names.push_back(variable);
  const FieldFile in(file, names, table.sites.size(), {}, {}, {table.positions, same_places_deg});
  FieldSet out;
  out.num_points = targets.table.sites.size();
  out.arrays = in.fields().arrays;
  out.axes = in.fields().axes;
  tell(file.path, in.fields().remarks);
  FieldWriter writer(options.common.target(), out, targets.side, options.netcdf);
  FieldCarrier carrier(job, options, table, targets, weights, counts);
  for (std::size_t a = 0; a < out.arrays.size(); ++a) {
    for (std::size_t f = 0; f < out.arrays[a].num_fields(); ++f) {
      std::vector<double> values(table.sites.size());
      in.read(a, f, values);
      for (std::size_t i = 0; i < grid.mask.size(); ++i) {
        if (grid.mask[i] == 0) values[i] = std::numeric_limits<double>::quiet_NaN();
      }
      const std::vector<double> carried = carrier.carry(std::move(values));
      job.time(Stage::write, [&] { writer.write(carried); });
    }
  }
  job.time(Stage::write, [&] { writer.finish(); });
}

// Returns the numbers of the cells that are not masked.
std::vector<Index> unmasked_sites(const NetcdfSites& grid) {
  const std::vector<bool> is_kept = grid.unmasked();
  std::vector<Index> numbers;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i]) numbers.push_back(static_cast<Index>(i));
  }
  return numbers;
}

// Turns weights of the cells that are not masked into weights of all cells.
void spread(const std::vector<Index>& numbers, const SiteTable& table, WeightFile& file) {
  Weights& weights = file.weights;
  for (Index& column : weights.columns) column = numbers[column];
  weights.num_columns = table.sites.size();
  weights.sites_hash = point_set_hash(table.sites);
  std::vector<double> areas(table.sites.size(), 0);
  for (std::size_t k = 0; k < numbers.size(); ++k) areas[numbers[k]] = file.source.areas[k];
  file.source.areas = std::move(areas);
}

// Adds the weights and the areas of the sites, by a triangulation of the cells that are not masked.
void interpolate_weights(Job& job, const InterpolateOptions& options, const NetcdfSites& grid,
                         const Targets& targets, InterpolateCounts& counts, WeightFile& file) {
  const SiteTable& table = grid.table;
  const std::vector<Index> numbers = unmasked_sites(grid);
  const bool has_masked = numbers.size() < table.sites.size();
  SiteTable kept;  // the triangulation refers to it
  if (has_masked) kept = table.selection(grid.unmasked());
  const Triangulation triangulation = triangulated(job, options, has_masked ? kept : table, counts);
  const Interpolator interpolator(triangulation);
  job.time(Stage::query, [&] {
    file.weights = with_places(targets.table, [&] {
      return interpolator.weights(targets.table.sites, options.interpolation, job.execution());
    });
  });
  job.time(Stage::dual, [&] { file.source.areas = areas(triangulation, job.execution()); });
  if (has_masked) spread(numbers, table, file);
}

void write_weights_of(Job& job, const InterpolateOptions& options, const NetcdfSites& grid,
                      Targets& targets, std::optional<Weights>& weights,
                      InterpolateCounts& counts) {
  WeightFile file;
  if (weights) {
    file.weights = std::move(*weights);
    file.method = name_of(*options.regrid);
  } else {
    interpolate_weights(job, options, grid, targets, counts, file);
    file.method = name_of(options.interpolation.method);
  }
  file.normalization = "none";
  file.source.points = grid.table.is_lonlat() ? grid.table.positions : lonlats(grid.table.sites);
  if (grid.shape.size() > 1) file.source.shape = grid.shape;
  file.source.mask = grid.mask;
  file.target = std::move(targets.side);
  if (options.target.starts_with("grid:")) {
    file.target.corners = CellSet::lonlat_grid(grid_of(options.target)).corners();
    file.target.areas = grid_of(options.target).areas();
  }
  for (std::size_t r = 0; r < file.weights.num_rows(); ++r) {
    if (file.weights.offsets[r] == file.weights.offsets[r + 1]) ++counts.missing;
  }
  job.time(Stage::write, [&] {
    write_weights({options.weights, options.weight_format}, file, options.netcdf);
  });
}

}  // namespace

ExitStatus run_interpolate(const InterpolateOptions& options) {
  const CommonOptions& common = options.common;
  const bool is_netcdf = is_netcdf_file(netcdf_part(options.source_file()).first);
  const bool has_values = !options.columns.empty() || (is_netcdf && !common.output.empty());
  if (has_values != !common.output.empty()) {
    throw UsageError("--value and --output go together: values of a column to a file");
  }
  if (!has_values && options.weights.empty()) {
    throw UsageError("nothing to do: --value COL -o FILE, or --weights FILE");
  }
  require_separate_files({{"INPUT", common.input}, {"--to", options.target}},
                         {{"--output", common.output}, {"--weights", options.weights}});
  if (has_values) {
    require_output(common, can_write_fields(common.target()), ".csv .tsv .npy .nc .nc4");
  }
  const bool is_nearest = !options.regrid && options.interpolation.method == Method::nearest;
  if (common.build.model == Model::weighted && !is_nearest) {
    throw UsageError("--method: weighted sites have no method but nearest");
  }
  Job job(common);
  ReadOptions read = common.read;
  read.keep_columns = has_values && !is_netcdf;
  const NetcdfSites grid = job.read_grid(options.source_file(), read, options.columns);
  const SiteTable& table = grid.table;
  Targets targets = read_targets(options.target_file(), common.read);
  const SiteTable* const tables[] = {&table, &targets.table};
  require_angles(common.read, tables);
  InterpolateCounts counts{table.sites.size(), targets.table.sites.size(), 0, 0, 0};
  std::optional<Weights> weights;
  if (options.regrid) weights = regrid_weights(job, *options.regrid, grid, targets);
  if (has_values && is_netcdf) interpolate_fields(job, options, grid, targets, weights, counts);
  if (has_values && !is_netcdf) interpolate_columns(job, options, table, targets, weights, counts);
  if (!options.weights.empty()) {
    counts.missing = 0;
    write_weights_of(job, options, grid, targets, weights, counts);
  }
  report(job, options, counts);
  return done;
}

}  // namespace rondel::cli
