// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the cells of a mesh around the places of values: read_native_cells().
//
// in    netCDF with a mesh, the places of values
// out   faces with these places as corners, or the cells of the dual mesh
// index places, nodes and faces as in the file
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "formats/netcdf_cells.h"
#include "io/bad_value.h"
#include "io/file_bytes.h"
#include "io/netcdf_groups.h"
#include "overlay/overlaps.h"
#include "rondel/conventions.h"
#include "rondel/delaunay.h"
#include "rondel/native_weights.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "system/job.h"

namespace rondel {
namespace {

// Places of one file are the same up to rounding of single precision.
constexpr double max_apart_deg = 1e-4;

constexpr const char* needs_common_nodes =
    "the method native needs a mesh whose cells have common nodes, as UGRID, MPAS, ICON, ESMF and "
    "Exodus have them; ";

// Returns the name of the mesh that a name means: the topology of UGRID, or nothing for the only
// mesh of a file of another convention.
std::string mesh_of(const io::NetcdfReader& file, const std::string& name) {
  const io::VariableInFile* const variable = name.empty() ? nullptr : &file.require(name);
  if (variable == nullptr) return {};
  if (io::netcdf_text(variable->attributes, "cf_role") == "mesh_topology") return name;
  return io::netcdf_text(variable->attributes, "mesh");
}

// True if the known ones of `all` are the places, in this order.
bool are_places(const std::vector<LonLat>& all, std::span<const LonLat> places) {
  std::size_t next = 0;
  for (const LonLat& place : all) {
    if (formats::is_missing_place(place)) continue;
    if (next == places.size() || !is_same_place(place, places[next], max_apart_deg)) return false;
    ++next;
  }
  return next == places.size() && next > 0;
}

// True if no corner of a ring is on the right of one of its sides, so that it is convex or flat.
bool is_around_all(std::span<const Point> points, std::span<const Index> ring) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point& from = points[ring[k]];
    const Point& to = points[ring[k + 1 < ring.size() ? k + 1 : 0]];
    const auto is_right = [&](Index i) {
      return orientation(from, to, points[i]) == Sign::negative;
    };
    if (std::ranges::any_of(ring, is_right)) return false;
  }
  return true;
}

// Throws BadValue for the first face that crosses itself, by exact signs.
void require_simple_faces(const CellRings& cells) {
  constexpr std::size_t many = 64;  // corners, of which the other test is the faster one
  CellRings doubtful;               // few: the others are convex
  std::vector<std::size_t> numbers;
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    if (cells.cells[cell] == cells.cells[cell + 1]) continue;
    std::vector<Index> ring(cells.corners_of(cells.cells[cell]).begin(),
                            cells.corners_of(cells.cells[cell]).end());
    if (ring.size() <= 3) continue;
    if (ring.size() <= many) {
      if (is_around_all(cells.points, ring)) continue;
      std::ranges::reverse(ring);
      if (is_around_all(cells.points, ring)) continue;
    }
    doubtful.append_ring(ring);
    doubtful.end_cell();
    numbers.push_back(cell);
  }
  if (numbers.empty()) return;
  doubtful.points = cells.points;
  for (CrossingCells& pair : crossing_cells(doubtful, {.threads = 1})) {
    if (pair.first != pair.second) continue;
    pair.first = pair.second = static_cast<Index>(numbers[pair.first]);
    throw io::BadValue(overlay::message_of(pair) +
                       ": values are interpolated in cells that do not");
  }
}

// Returns the faces of a mesh whose nodes are the places. Each has one ring; others are left out.
NativeCells faces_of(formats::MeshContent mesh, std::span<const LonLat> places) {
  std::vector<Index> numbers;  // of the nodes among the places
  Index next = 0;
  for (const LonLat& node : mesh.nodes) {
    numbers.push_back(formats::is_missing_place(node) ? no_index : next++);
  }
  formats::leave_out_cells_without_corners(mesh);
  NativeCells native;
  native.cells.points = unit_vectors(places);
  std::size_t num_left_out = 0;
  std::vector<Index> ring;
  for (std::size_t cell = 0; cell < mesh.cells.num_cells(); ++cell) {
    const std::uint64_t num_rings = mesh.cells.cells[cell + 1] - mesh.cells.cells[cell];
    const bool is_masked = !mesh.mask.empty() && mesh.mask[cell] == 0;
    if (num_rings > 1) ++num_left_out;
    if (num_rings != 1 || is_masked) {
      native.cells.end_cell();
      continue;
    }
    ring.clear();
    for (const Index node : mesh.cells.corners_of(mesh.cells.cells[cell])) {
      const Index corner = numbers[node];
      if (!ring.empty() && ring.back() == corner) continue;
      ring.push_back(corner);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() >= 3) native.cells.append_ring(ring);
    native.cells.end_cell();
  }
  require_simple_faces(native.cells);
  native.remarks = std::move(mesh.remarks);
  if (num_left_out > 0) {
    native.remarks.push_back(std::to_string(num_left_out) + " of " +
                             std::to_string(native.cells.num_cells()) +
                             " cells have several rings and are left out");
  }
  return native;
}

// Returns the cells of the dual mesh. Nodes in one place, as along an antimeridian, are one here.
NativeCells dual_of(const io::NetcdfReader& file, const std::string& file_name,
                    const std::string& mesh_name, std::span<const LonLat> places) {
  CellTable table = formats::cells_in(file, file_name, mesh_name);
  CellRings& cells = table.cells;
  if (std::ranges::count(table.facts.mask, 0) > 0) {
    CellRings kept;
    kept.points = cells.points;
    for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
      if (table.facts.mask[cell] != 0) kept.append_rings(cells, cell);
      kept.end_cell();
    }
    cells = std::move(kept);
  }
  return {dual_cells(cells, unit_vectors(places)), std::move(table.facts.remarks)};
}

}  // namespace

NativeCells read_native_cells(const FileName& file, std::span<const LonLat> places) {
  const system::ArithmeticScope arithmetic;
  const std::pair<FileName, std::string> part = file_and_variable(file);
  io::FileBytes bytes(part.first, true);
  return io::in_file(bytes.name(), [&] {
    if (!io::is_netcdf(bytes.head())) {
      throw io::BadValue("the method native needs netCDF with a mesh");
    }
    const io::NetcdfReader reader(bytes);
    const std::string mesh_name = mesh_of(reader, io::full_name(reader.variables(), part.second));
    if (!has_mesh(formats::headers_of(reader))) {
      throw io::BadValue(needs_common_nodes +
                         std::string("this file has none, and linear takes any places"));
    }
    formats::MeshContent mesh = formats::read_by_convention(reader, mesh_name);
    for (const std::string_view convention : {"CF", "SCRIP", "OASIS"}) {
      if (mesh.convention == convention) {
        throw io::BadValue(needs_common_nodes + ("this is a grid of " + mesh.convention));
      }
    }
    if (are_places(mesh.nodes, places)) return faces_of(std::move(mesh), places);
    const bool are_centers = mesh.centers.empty() ? places.size() == mesh.cells.num_cells()
                                                  : are_places(mesh.centers, places);
    if (are_centers && places.size() == mesh.cells.num_cells()) {
      return dual_of(reader, bytes.name(), mesh_name, places);
    }
    throw io::BadValue(
        "the method native needs values at the nodes of the mesh or at its cells: the " +
        std::to_string(places.size()) + " places are neither its " +
        std::to_string(mesh.nodes.size()) + " nodes nor the centers of its " +
        std::to_string(mesh.cells.num_cells()) + " cells");
  });
}

}  // namespace rondel
