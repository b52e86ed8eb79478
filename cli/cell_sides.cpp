// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "cell_sides.h"

#include <string>
#include <utility>
#include <vector>

#include "report.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/read_cells.h"
#include "targets.h"

namespace rondel::cli {
namespace {

// Returns the cells of a named grid. Throws UsageError for a grid that is not possible.
CellSet cells_of_grid(const std::string& name, GridSides sides, const Job& job) {
  try {
    return grid_of(name, sides).cells(job.execution());
  } catch (const InvalidInput& error) {
    throw UsageError(name + ": " + error.what());
  }
}

// Returns the cells of netCDF or polygons, in the order of the file, and prints the remarks of the
// reader.
CellSet cells_of_file(const FileName& file, const CellSideOptions& options, const Job& job) {
  CellFileOptions read = options.cells;
  // Polygons that overlap are found when they are read, where the message can name both.
  if (options.overlap == CellOverlap::error) read.overlap = PolygonOverlap::error;
  CellSet cells = CellSet::read(file, read, job.execution());
  if (cells.num_cells() == 0) throw FileError(cells.facts().name + ": there are no cells");
  tell(cells.facts().name, cells.facts().remarks);
  return cells;
}

// The places of the cells are the sites, as given or as they are seen from the center.
CellSet cells_of_sites(const FileName& file, const CellSideOptions& options, Job& job) {
  ReadOptions read = options.read;
  read.keep_columns = false;
  const SiteTable table = job.read(file, read);
  const Triangulation triangulation = job.triangulate(table);
  const CellSet cells = CellSet::voronoi(triangulation, job.execution());
  CellFacts facts = cells.facts();
  facts.name = table.name;
  if (table.sites.empty()) throw FileError(table.name + ": " + no_points);
  // Given longitudes and latitudes are kept to the digit.
  facts.centers = lonlats_of(table, triangulation.sphere().center);
  return cells.with_facts(std::move(facts));
}

}  // namespace

CellForm form_of(const FileName& side) {
  if (NamedGrid::is_name(side.path)) return CellForm::grid;
  require_grid_or_file(side);
  if (can_read_cells(side)) return CellForm::netcdf;
  return can_read_polygons(side) ? CellForm::polygons : CellForm::sites;
}

CellSet cells_of_side(const FileName& side, const CellSideOptions& options, Job& job) {
  const CellForm form = form_of(side);
  if (form == CellForm::grid) return cells_of_grid(side.path, options.cells.sides, job);
  return form == CellForm::sites ? cells_of_sites(side, options, job)
                                 : cells_of_file(side, options, job);
}

}  // namespace rondel::cli
