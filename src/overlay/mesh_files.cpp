// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/mesh_files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "io/bad_value.h"
#include "io/ending.h"
#include "io/file_bytes.h"
#include "map/ring_area.h"
#include "overlay/mesh_formats.h"
#include "overlay/same_nodes.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

overlay::MeshContent read_mesh(const io::NetcdfReader& file) {
  for (const auto read : {&overlay::read_ugrid, &overlay::read_scrip_grid, &overlay::read_esmf_mesh,
                          &overlay::read_mpas, &overlay::read_icon, &overlay::read_cf_grid}) {
    if (std::optional<overlay::MeshContent> mesh = read(file)) return std::move(*mesh);
  }
  throw io::BadValue(
      "it has no cells: it follows none of UGRID, SCRIP, ESMF, MPAS, ICON, and no longitudes and "
      "latitudes "
      "of CF");
}

constexpr double same_place = 1e-10;  // radians
constexpr double same_single_place = 1e-6;

// Rings with the inside to the left, without corners that repeat the one before.
class RingsOfNodes {
 public:
  // Precondition: nodes are places.
  RingsOfNodes(std::span<const LonLat> nodes, double distance) {
    overlay::Distinct<LonLat> places = overlay::distinct(nodes);
    made_.points = unit_vectors(places.values);
    const std::vector<Index> same = overlay::same_nodes(made_.points, distance);
    for (Index& number : places.numbers) number = same[number];
    corner_of_ = std::move(places.numbers);
  }

  void reserve(std::size_t num_cells, std::size_t num_rings, std::size_t num_corners) {
    made_.cells.reserve(num_cells + 1);
    made_.rings.reserve(num_rings + 1);
    made_.corners.reserve(num_corners);
  }

  void add_corner(Index node) {
    const Index corner = corner_of_[node];
    if (ring_.empty() || corner != ring_.back()) ring_.push_back(corner);
  }
  void end_ring() {
    while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
    if (ring_.size() >= 3) {
      points_.clear();
      for (const Index corner : ring_) points_.push_back(made_.points[corner]);
      if (map::is_clockwise(points_)) std::ranges::reverse(ring_);
      made_.corners.insert(made_.corners.end(), ring_.begin(), ring_.end());
      made_.rings.push_back(made_.corners.size());
    }
    ring_.clear();
  }
  void end_cell() { made_.cells.push_back(made_.rings.size() - 1); }
  CellRings take() && { return std::move(made_); }

 private:
  CellRings made_;
  std::vector<Index> corner_of_;  // by node
  std::vector<Index> ring_;
  std::vector<Point> points_;
};

CellRings cells_of(const overlay::MeshContent& mesh) {
  RingsOfNodes maker(mesh.nodes, mesh.is_single ? same_single_place : same_place);
  maker.reserve(mesh.cells.size() - 1, mesh.rings.size() - 1, mesh.corners.size());
  for (std::size_t i = 0; i + 1 < mesh.cells.size(); ++i) {
    for (std::uint64_t r = mesh.cells[i]; r < mesh.cells[i + 1]; ++r) {
      for (std::uint64_t k = mesh.rings[r]; k < mesh.rings[r + 1]; ++k) {
        maker.add_corner(mesh.corners[k]);
      }
      maker.end_ring();
    }
    maker.end_cell();
  }
  return std::move(maker).take();
}

}  // namespace

std::size_t CellTable::num_cells() const {
  return grid ? (grid->lon_deg.size() - 1) * (grid->lat_deg.size() - 1) : cells.num_cells();
}

CellRings cells_of_corners(std::span<const LonLat> corners, std::size_t of_each) {
  const system::ArithmeticScope arithmetic;
  if (of_each == 0 || corners.size() % of_each != 0) {
    throw InvalidInput(std::to_string(corners.size()) + " corners are none of cells with " +
                           std::to_string(of_each) + " each",
                       corners.size());
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [lon, lat] = corners[k];
    if (std::isfinite(lon) && std::abs(lat) <= 90) continue;
    throw InvalidInput("cell " + std::to_string(k / of_each) + " has a corner at longitude " +
                           std::to_string(lon) + " and latitude " + std::to_string(lat) +
                           ", which is no place",
                       k / of_each);
  }
  RingsOfNodes maker(corners, same_place);
  maker.reserve(corners.size() / of_each, corners.size() / of_each, corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    maker.add_corner(static_cast<Index>(k));
    if ((k + 1) % of_each == 0) {
      maker.end_ring();
      maker.end_cell();
    }
  }
  return std::move(maker).take();
}

CellTable read_cells(const FileName& file) {
  const system::ArithmeticScope arithmetic;
  constexpr std::string_view netcdf = ".nc";
  if (io::ending(file) != netcdf) {
    io::throw_unknown_ending(file, "cells of models are read from", {&netcdf, 1});
  }
  io::FileBytes bytes(file.path, true);
  return io::in_file(bytes.name(), [&] {
    overlay::MeshContent mesh = read_mesh(io::NetcdfReader(bytes.text()));
    CellTable table;
    table.name = bytes.name();
    if (!mesh.grid) table.cells = cells_of(mesh);
    table.convention = std::move(mesh.convention);
    table.grid = std::move(mesh.grid);
    table.centers = std::move(mesh.centers);
    table.mask = std::move(mesh.mask);
    table.shape = std::move(mesh.shape);
    return table;
  });
}

Partition partition_of(const CellTable& table, GridSides sides, const Execution& execution) {
  try {
    return table.grid ? Partition::lonlat_grid(*table.grid, sides, execution)
                      : Partition(table.cells, execution);
  } catch (const InvalidInput& error) {
    throw FileError(table.name + ": " + error.what());
  }
}

}  // namespace rondel
