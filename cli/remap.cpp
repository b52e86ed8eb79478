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

namespace rondel::cli {
namespace {

// Returns the cells of grid:DEG or grid:NLONxNLAT.
CellSet cells_of_grid(const std::string& name, const RemapCommandOptions& options, const Job& job) {
  try {
    return CellSet::lonlat_grid(grid_of(name), options.cells.sides, job.execution());
  } catch (const InvalidInput& error) {
    throw UsageError(name + ": " + error.what());
  }
}

// Returns the cells of netCDF or polygons. Errors name features by their names, and cells by their
// numbers.
CellSet cells_of_file(const FileName& file, const RemapCommandOptions& options, const Job& job) {
  CellFileOptions read = options.cells;
  if (options.remap.overlap == CellOverlap::error) read.overlap = PolygonOverlap::error;
  CellSet cells = CellSet::read(file, read, job.execution());
  tell(cells.facts().name, cells.facts().remarks);
  return cells;
}

// Sites are read as points and have the cells of their Voronoi diagram, or with weights power
// cells. The places of the cells are the sites, as given or as they are seen from the center.
CellSet cells_of_sites(const FileName& file, const RemapCommandOptions& options, Job& job) {
  ReadOptions read = options.common.read;
  read.keep_columns = false;
  const SiteTable table = job.read(file, read);
  const Triangulation triangulation = job.triangulate(table);
  const CellSet cells = CellSet::voronoi(triangulation, job.execution());
  CellFacts facts = cells.facts();
  facts.name = table.name;
  const Point& center = triangulation.sphere().center;
  if (table.is_lonlat() && center == Point{}) {
    facts.centers = table.positions;
  } else {
    std::vector<Point> seen = table.sites;
    for (Point& site : seen) site = {site.x - center.x, site.y - center.y, site.z - center.z};
    facts.centers = lonlats(seen);
  }
  return cells.with_facts(std::move(facts));
}

// Reads the cells of a side in the form that its file has.
CellSet cells_of(const FileName& file, const RemapCommandOptions& options, Job& job) {
  const CellForm form = form_of(file);
  if (form == CellForm::grid) return cells_of_grid(file.path, options, job);
  return form == CellForm::sites ? cells_of_sites(file, options, job)
                                 : cells_of_file(file, options, job);
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
  CellSet source;
  CellSet target;
  job.time(Stage::dual, [&] {
    source = cells_of(options.source_file(), options, job);
    target = cells_of(options.target_file(), options, job);
  });
  WeightFile file;
  job.time(Stage::query, [&] {
    file = weight_file(rondel::remap(source, target, options.remap, job.execution()));
  });
  job.time(Stage::write, [&] { write_weights(common.target(), file, options.netcdf); });
  report(job, file, common.output);
  return done;
}

}  // namespace rondel::cli
