// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads meshes of all formats. MPAS has all arrays (mpas_arrays.cpp). The other formats have only
// cells and corners: the mesh is computed from the centers of the cells and compared with the
// cells' corners. If the cells do not cover the sphere, the border of the mesh follows from the
// corners.

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "formats/cf_names.h"
#include "formats/cf_reader.h"
#include "formats/field_choice.h"
#include "formats/grid_of_file.h"
#include "formats/mpas_places.h"
#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "io/netcdf_reader.h"
#include "meshing/bordered_mesh.h"
#include "meshing/ring_surface.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/mesh_formats.h"
#include "rondel/query.h"
#include "rondel/read_cells.h"
#include "system/job.h"

namespace rondel::formats {
namespace {

// Areas, lengths and measures of quality that the writers of meshes compute again.
constexpr std::array<std::string_view, 13> measures = {
    "areaCell",       "meshDensity", "cellQuality",  "gridSpacing",     "dcEdge",
    "dvEdge",         "angleEdge",   "areaTriangle", "triangleQuality", "triangleAngleQuality",
    "obtuseTriangle", "grid_area",   "elementArea"};

}  // namespace

std::string remark_on_fields(const io::NetcdfReader& file, std::span<const std::string> read) {
  const std::vector<VariableHeader> headers = headers_of(file);
  const std::vector<bool> parts = parts_of_grids(headers);
  NameList names;
  for (std::size_t v = 0; v < headers.size(); ++v) {
    const VariableHeader& header = headers[v];
    const bool is_axis = header.dimensions.size() == 1 && header.dimensions[0] == header.name;
    // Coordinates, axes and measures are computed again, so only other numbers are lost.
    if (parts[v] || header.shape.empty() || !header.is_number || is_axis ||
        std::ranges::count(measures, header.name) != 0 ||
        std::ranges::count(read, header.name) != 0 ||
        coordinate_evidence(header, CoordinateKind::lon) > 0 ||
        coordinate_evidence(header, CoordinateKind::lat) > 0) {
      continue;
    }
    names.add(header.name);
  }
  return names.text().empty() ? "" : "left out, as they are no part of the mesh: " + names.text();
}

}  // namespace rondel::formats

namespace rondel::mesh {
namespace {

// True if a cell has a corner within that distance.
bool has_corner(const VoronoiMesh& arrays, std::size_t cell, const Point& corner,
                double square_distance) {
  for (std::uint64_t at = arrays.edges_on_cell.offsets[cell];
       at < arrays.edges_on_cell.offsets[cell + 1]; ++at) {
    // Corners are compared on the unit sphere.
    const Point away =
        (1 / arrays.radius) * arrays.vertex_points[arrays.vertices_on_cell[at]] - corner;
    if (dot(away, away) <= square_distance) return true;
  }
  return false;
}

// Throws BadValue for the first cell that is not a single ring.
void require_rings(const CellTable& table) {
  for (std::size_t i = 0; i < table.cells.num_cells(); ++i) {
    if (table.cells.cells[i + 1] - table.cells.cells[i] == 1) continue;
    throw io::BadValue("cell " + std::to_string(i) +
                       " has several rings or none, where one is needed");
  }
}

// True if the file has a corner of a cell within that distance.
bool has_corner_in_file(const CellRings& cells, std::size_t cell, const Point& corner,
                        double square_distance) {
  for (std::uint64_t k = cells.rings[cell]; k < cells.rings[cell + 1]; ++k) {
    const Point away = cells.points[cells.corners[k]] - corner;
    if (dot(away, away) <= square_distance) return true;
  }
  return false;
}

// Throws BadValue for the first cell of the file whose corners are not those of the mesh, or lack
// one of them.
void require_cells(const VoronoiMesh& arrays, const CellTable& table) {
  const CellRings& cells = table.cells;
  for (std::size_t i = 0; i < cells.num_cells(); ++i) {
    const double distance =
        meshing::corner_tolerance * spacing_of(arrays.cell_areas[i]) / arrays.radius;
    for (std::uint64_t k = cells.rings[i]; k < cells.rings[i + 1]; ++k) {
      if (!has_corner(arrays, i, cells.points[cells.corners[k]], distance * distance)) {
        meshing::refuse_cell(i);
      }
    }
    for (std::uint64_t at = arrays.edges_on_cell.offsets[i];
         at < arrays.edges_on_cell.offsets[i + 1]; ++at) {
      const Point corner = (1 / arrays.radius) * arrays.vertex_points[arrays.vertices_on_cell[at]];
      if (!has_corner_in_file(cells, i, corner, distance * distance)) meshing::refuse_cell(i);
    }
  }
}

// Returns the Voronoi mesh of the centers, without a border. Throws BadValue if its cells are not
// those of the file.
VoronoiMesh whole_mesh(const CellTable& table, const Triangulation& triangulation,
                       const MeshOptions& options, const Execution& execution) {
  VoronoiMesh result = make_mesh(triangulation, options, execution);
  require_cells(result, table);
  return result;
}

// Returns the mesh of cells with a border, or nothing if there is no border. A border may be found
// only because cells state shared corners differently, by more than is taken for equal; then they
// are a whole mesh all the same.
std::optional<VoronoiMesh> part_of_mesh(const CellTable& table, const Triangulation& triangulation,
                                        std::span<const Point> sites, const MeshOptions& options,
                                        const Execution& execution) {
  const meshing::RingSides sides(table.cells);
  if (!sides.has_border()) return std::nullopt;
  if (!triangulation.duplicates().empty()) {
    const auto [cell, other] = triangulation.duplicates().front();
    throw io::BadValue("cells " + std::to_string(other) + " and " + std::to_string(cell) +
                       " have the same center");
  }
  const Locator locator(triangulation);
  const meshing::RingsAndSites from{table.cells, sides, sites, locator};
  meshing::require_rings_around_sites(from);
  const auto differing = meshing::cells_that_differ(from, execution);
  if (!differing) return meshing::bordered_mesh(from, options, execution);
  // If no mesh without a border fits either, the message is the one on the first two cells.
  const io::BadValue refusal("cells " + std::to_string(differing->first) + " and " +
                             std::to_string(differing->second) +
                             " meet, but not in the same corners");
  try {
    return whole_mesh(table, triangulation, options, execution);
  } catch (const io::BadValue&) {
    throw refusal;
  } catch (const InvalidInput&) {
    throw refusal;
  }
}

// Removes the cells that the file masks, and adds a remark with the number of the others.
void leave_out_masked(CellTable& table) {
  CellFacts& facts = table.facts;
  if (facts.mask.empty() || table.grid || facts.centers.size() != table.num_cells()) return;
  CellRings kept;
  kept.points = std::move(table.cells.points);
  std::vector<LonLat> centers;
  for (std::size_t i = 0; i < facts.mask.size(); ++i) {
    if (facts.mask[i] == 0) continue;
    kept.append_cell(table.cells, i);
    centers.push_back(facts.centers[i]);
  }
  table.cells = std::move(kept);
  facts.centers = std::move(centers);
  if (facts.centers.empty()) throw FileError(facts.name + ": all cells are masked");
  facts.remarks.push_back("the mesh has the other " + std::to_string(facts.centers.size()) +
                          " cells, in their order");
}

// Returns the mesh of cells with centers: with a border, or of the whole sphere.
VoronoiMesh mesh_of_centers(const CellTable& table, const MeshOptions& options,
                            const Execution& execution) {
  const CellFacts& facts = table.facts;
  if (table.grid) throw FileError(facts.name + ": a grid of longitudes and latitudes is no mesh");
  if (facts.centers.size() != table.num_cells()) {
    throw FileError(facts.name + ": " + facts.convention +
                    ": the file has no centers of cells, from which the mesh is computed");
  }
  try {
    return io::in_file(facts.name, [&] {
      require_rings(table);
      const std::vector<Point> sites = unit_vectors(facts.centers);
      const Triangulation triangulation = delaunay(sites, {}, execution);
      std::optional<VoronoiMesh> part =
          part_of_mesh(table, triangulation, sites, options, execution);
      return part ? std::move(*part) : whole_mesh(table, triangulation, options, execution);
    });
  } catch (const InvalidInput& error) {
    throw FileError(facts.name + ": cell " + std::to_string(error.index()) + ": " + error.what());
  }
}

}  // namespace

VoronoiMesh read_mesh(const FileName& file, const MeshOptions& options, const Execution& execution,
                      std::vector<std::string>* remarks) {
  const system::Call call(execution);
  if (const std::string grid = formats::grid_of_file(file, false).name; !grid.empty()) {
    throw FileError(file.path + ": its points are those of the grid '" + grid +
                    "', whose cells are no Voronoi cells, as a mesh has them");
  }
  CellTable table;
  std::string remark;
  std::string remark_on_arrays;
  {
    io::FileBytes bytes(file, true);
    if (!io::is_netcdf(bytes.head()) && !io::has_netcdf_ending(file)) {
      io::throw_unknown_ending(file, "meshes are read from netCDF:", io::netcdf_endings);
    }
    std::optional<VoronoiMesh> arrays;
    io::in_file(bytes.name(), [&] {
      const io::NetcdfReader reader(bytes);
      remark = formats::remark_on_fields(reader, {});
      if (formats::has_mpas_arrays(reader)) {
        arrays = formats::read_mpas_arrays(reader, execution);
        if (remarks != nullptr)
          remark_on_arrays = formats::remark_on_lists(reader, *arrays, execution.threads);
      } else {
        table = formats::cells_in(reader, bytes.name(), {});
      }
    });
    leave_out_masked(table);
    for (std::string* const text : {&remark_on_arrays, &remark}) {
      if (!text->empty()) table.facts.remarks.push_back(std::move(*text));
    }
    if (remarks != nullptr) *remarks = table.facts.remarks;
    if (arrays) return std::move(*arrays);
  }
  return mesh_of_centers(table, options, execution);
}

}  // namespace rondel::mesh
