// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel remap: conservative weights from the cells of one file to those of another.
// in    two sides with cells: a grid, a mesh or grid of netCDF, polygons, or sites with Voronoi
//       cells
// out   a file of weights
// index source cells are columns, target cells are rows, in the order of their files
#include "rondel/remap.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "process.h"
#include "remap.h"
#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/mesh_files.h"
#include "rondel/weight_files.h"

namespace rondel::cli {
namespace {

// The cells of one side, and what the file of weights contains of them.
struct CellSide {
  CellSet partition;
  WeightSide side;
};

// The cells of grid:DEG or grid:NLONxNLAT, whose corners and areas are computed here.
CellSide side_of_grid(const std::string& name, const RemapCommandOptions& options, const Job& job) {
  WeightSide side = grid_side(name);
  add_grid_cells(side);
  try {
    return {CellSet::lonlat_grid(lonlat_grid(name), options.sides, job.execution()),
            std::move(side)};
  } catch (const InvalidInput& error) {
    throw UsageError(name + ": " + error.what());
  }
}

// The cells of netCDF in any convention that the library reads.
CellSide side_of_mesh(const FileName& file, const RemapCommandOptions& options, const Job& job) {
  const CellTable table = read_cells(file);
  tell(table.name, table.remarks);
  CellSet partition = partition_of(table, options.sides, job.execution());
  WeightSide side = weight_side(table, partition);
  return {std::move(partition), std::move(side)};
}

CellSide side_of_polygons(const FileName& file, const RemapCommandOptions& options,
                          const Job& job) {
  // Errors name features by their names, and cells by their numbers.
  const bool is_refused = options.remap.overlap == CellOverlap::error;
  PolygonTable table =
      read_polygons(file,
                    {.edges = options.edges,
                     .overlap = is_refused ? PolygonOverlap::error : PolygonOverlap::keep},
                    job.execution());
  tell(table.name, table.remarks);
  try {
    CellSet partition(table.cells, job.execution());
    WeightSide side;
    side.points = lonlats(partition.centers());
    side.columns = std::move(table.columns);
    return {std::move(partition), std::move(side)};
  } catch (const InvalidInput& error) {
    throw FileError(table.name + ": " + error.what());
  }
}

// Sites are read as points and have the cells of their Voronoi diagram, or with weights power
// cells.
CellSide side_of_sites(const FileName& file, const RemapCommandOptions& options, Job& job) {
  ReadOptions read = options.common.read;
  read.keep_columns = false;
  const SiteTable table = job.read(file, read);
  const Triangulation triangulation = job.triangulate(table);
  WeightSide side;
  side.points = table.is_lonlat() ? table.positions : lonlats(table.sites);
  return {CellSet::voronoi(triangulation, job.execution()), std::move(side)};
}

// Reads the cells of a side in the form that its file has.
CellSide side_of(const FileName& file, const RemapCommandOptions& options, Job& job) {
  switch (form_of(file)) {
    case CellForm::grid:
      return side_of_grid(file.path, options, job);
    case CellForm::netcdf:
      return side_of_mesh(file, options, job);
    case CellForm::polygons:
      return side_of_polygons(file, options, job);
    case CellForm::sites:
      break;
  }
  return side_of_sites(file, options, job);
}

// Errors name the file that has the cell.
Remap remapped(const RemapCommandOptions& options, const CellSide& source, const CellSide& target,
               const RemapOptions& remap_options, const Job& job) {
  try {
    return rondel::remap(source.partition, target.partition, remap_options, job.execution());
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    const std::string& input = options.common.input;
    const std::string file = text.starts_with("source")   ? input
                             : text.starts_with("target") ? options.target
                                                          : input + " to " + options.target;
    throw FileError(file + ": " + text);
  }
}

// Prints the numbers of cells and weights; `missing` counts target cells without any source.
void report(Job& job, const WeightFile& file, const std::string& output) {
  std::size_t empty = 0;
  const Weights& weights = file.weights;
  for (std::size_t r = 0; r < weights.num_rows(); ++r) {
    if (weights.offsets[r] == weights.offsets[r + 1]) ++empty;
  }
  const Seconds seconds = job.seconds();
  const nlohmann::ordered_json json = {{"sources", weights.num_columns},
                                       {"targets", weights.num_rows()},
                                       {"weights", weights.values.size()},
                                       {"missing", empty},
                                       {"seconds",
                                        {{"read", seconds.read},
                                         {"cells", seconds.dual},
                                         {"remap", seconds.query},
                                         {"write", seconds.write},
                                         {"total", seconds.total}}},
                                       {"peak_memory_bytes", peak_memory_bytes()}};
  job.report(json.dump(2) + '\n', count(weights.num_columns, "cell", "cells") + " to " +
                                      count(weights.num_rows(), "cell", "cells") + ", " +
                                      count(weights.values.size(), "weight", "weights") +
                                      "; targets without source: " + std::to_string(empty) +
                                      "\nwrote the weights to " + output + '\n');
}

}  // namespace

CellForm form_of(const FileName& file) {
  CommonOptions named;
  named.output = file.path;
  named.output_format = file.format;
  const std::string format = named.format();
  if (file.path.starts_with("grid:")) return CellForm::grid;
  if (can_read_cells(file)) return CellForm::netcdf;
  return format == "geojson" || format == "json" ? CellForm::polygons : CellForm::sites;
}

ExitStatus run_remap(const RemapCommandOptions& options) {
  const CommonOptions& common = options.common;
  const std::string format = common.format();
  constexpr const char* formats[] = {"nc", "nc4", "npz", "esmf", "scrip"};
  require_output(common, std::ranges::find(formats, format) != std::end(formats), ".nc .nc4 .npz",
                 {{"TARGET", options.target}});
  Job job(common);
  std::optional<CellSide> source;
  std::optional<CellSide> target;
  job.time(Stage::dual, [&] {
    source = side_of(options.source_file(), options, job);
    target = side_of(options.target_file(), options, job);
  });
  // Masks come from the files, and cells that they leave out take no part.
  RemapOptions remap_options = options.remap;
  remap_options.source_mask = source->side.mask;
  remap_options.target_mask = target->side.mask;
  WeightFile file;
  job.time(Stage::query, [&] {
    Remap remap = remapped(options, *source, *target, remap_options, job);
    file.weights = std::move(remap.weights);
    file.source = std::move(source->side);
    file.target = std::move(target->side);
    file.source.areas = std::move(remap.source_areas);
    file.target.areas = std::move(remap.target_areas);
    file.source.fractions = std::move(remap.source_fractions);
    file.target.fractions = std::move(remap.target_fractions);
  });
  file.method =
      options.remap.order == 2 ? "Conservative remapping, second order" : "Conservative remapping";
  file.normalization = name_of(options.remap.norm);
  job.time(Stage::write, [&] { write_weights(common.target(), file, options.netcdf); });
  report(job, file, common.output);
  return done;
}

}  // namespace rondel::cli
