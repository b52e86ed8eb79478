// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The conventions by which netCDF holds cells, one function each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/cf_reader.h"
#include "io/netcdf_reader.h"
#include "rondel/export.h"
#include "rondel/mesh_files.h"
#include "rondel/partition.h"
#include "rondel/types.h"

namespace rondel::overlay {

// Cells as files have them: corners may be repeated, and rings go either way around.
struct MeshContent {
  std::string convention;
  std::vector<LonLat> nodes;  // as they are in the file; of missing ones both numbers are NaN
  std::string names;          // of the variables of the nodes
  bool is_single = false;     // the nodes have single precision
  std::vector<std::uint64_t> cells = {0};
  std::vector<std::uint64_t> rings = {0};
  std::vector<Index> corners;  // nodes
  std::optional<LonLatGrid> grid;
  std::vector<LonLat> centers;
  std::vector<std::int32_t> mask;
  std::vector<std::uint64_t> shape;
  std::vector<std::string> remarks;  // what the file has and the cells have not

  void end_ring() { rings.push_back(corners.size()); }
  void end_cell() { cells.push_back(rings.size() - 1); }
};

// What read_cells() gives of the file, or of the grid that the variable `part` is on. Throws BadValue.
RONDEL_API CellTable cells_in(const io::NetcdfReader& file, const std::string& file_name,
                              const std::string& part);

// Each is nothing if the file does not follow the convention, or, where a variable is named, if that is not of this convention.
// Throws BadValue.
std::optional<MeshContent> read_ugrid(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_scrip_grid(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_esmf_mesh(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_mpas(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_icon(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_oasis(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_exodus(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_cf_grid(const io::NetcdfReader& file, const std::string& name);

using MeshVariable = io::NetcdfReader::Variable;
using io::UsualUnits;

// Whether no variable is named, or one that has a dimension of `cells`.
bool is_meant(const io::NetcdfReader& file, const std::string& name, const MeshVariable& cells);

// Variables of longitudes and latitudes; null: none.
struct MeshCoordinates {
  const MeshVariable* lon = nullptr;
  const MeshVariable* lat = nullptr;
};
// Longitudes, then latitudes in degrees. A variable without units has those of the related one, or else of another one of the four.
std::array<std::vector<double>, 2> degrees_of_both(const io::NetcdfReader& file,
                                                   const MeshCoordinates& wanted,
                                                   const MeshCoordinates& related,
                                                   UsualUnits usual);
// The same as positions. Throws BadValue if the variables are not of one length.
std::vector<LonLat> positions_of(const io::NetcdfReader& file, const MeshCoordinates& wanted,
                                 const MeshCoordinates& related, UsualUnits usual);
void take_nodes(const io::NetcdfReader& file, const MeshCoordinates& nodes,
                const MeshCoordinates& centers, UsualUnits usual, MeshContent& mesh);
bool is_missing_place(const LonLat& place);
// The place, its latitude not beyond a pole by rounding. Throws BadValue with i and the names of the variables if there is no such
// place.
LonLat require_position(const std::string& names, std::size_t i, const LonLat& place);
// Cells that have corners of their own, which are the nodes, `of_each` a cell. Where `may_be_fewer`, those missing at the end are none.
void end_cells_of_nodes(std::size_t of_each, bool may_be_fewer, MeshContent& mesh);
// Which nodes are corners: `of_each` entries a cell, `counts` of which are in use, if there are counts; where `of_each` is 0, as many
// as the counts say.
struct Connectivity {
  const MeshVariable& variable;
  std::uint64_t num_cells;
  std::uint64_t of_each;
  bool is_transposed;      // the cells change fastest
  double first;            // the number of the first node
  double break_value = 0;  // begins a ring; `first` or more: none does
};
void take_connectivity(const io::NetcdfReader& file, const Connectivity& connectivity,
                       const std::vector<double>& counts, MeshContent& mesh);
// 0 and not 0, of the number of cells.
void take_mask(const io::NetcdfReader& file, std::string_view name, MeshContent& mesh);
void take_centers(const io::NetcdfReader& file, const MeshCoordinates& centers,
                  const MeshCoordinates& nodes, UsualUnits usual, MeshContent& mesh);
// Leaves out the cells that have a corner at no place: their rings go, their mask becomes 0, and how many they are becomes a remark.
// Throws BadValue for other nodes that are no places.
void leave_out_cells_without_corners(MeshContent& mesh);
// The first number of an attribute, or `otherwise`.
double number_or(const MeshVariable& variable, std::string_view name, double otherwise);
void require_values(const MeshVariable& variable, std::uint64_t wanted);
const MeshVariable& require_rank(const MeshVariable& variable, std::size_t rank);

}  // namespace rondel::overlay
