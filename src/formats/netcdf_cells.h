// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The functions that the readers of cells share. Each convention has a file of its own (ugrid.cpp
// and others), with its reader beside its writer.
//
// in    an open netCDF file and the name of a variable, or an empty name
// out   MeshContent: nodes, rings and attributes of cells
// index cells, rings and nodes as in the file
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/cf_reader.h"
#include "io/netcdf_reader.h"
#include "rondel/cell_rings.h"
#include "rondel/cell_set.h"
#include "rondel/read_cells.h"
#include "rondel/types.h"

namespace rondel::formats {

// The cells as a file has them: corners may be repeated, and rings may have either direction.
struct MeshContent : CellFacts {
  std::vector<LonLat> nodes;  // as in the file; both numbers of a missing node are NaN
  std::string names;          // the quoted names of the variables of the nodes, for messages
  bool is_single = false;     // true if the nodes have single precision
  CellRings cells;            // its corners are indices of nodes, and it has no points
  // Set if the cells are between meridians and parallels; then there are no nodes.
  std::optional<LonLatGrid> grid;
  std::string center_names;  // the quoted names of the variables of the centers
};

// Returns what read_cells() returns for a file, or for the grid that the variable `part` is on.
// `file_name` is for messages. Throws BadValue.
CellTable cells_in(const io::NetcdfReader& file, const std::string& file_name,
                   const std::string& part, MissingCorners corners = MissingCorners::error);

// Returns the cells of a table, repaired if the options ask for it. Throws FileError.
CellSet cells_by_rules(CellTable table, const CellFileOptions& options, const Execution& execution);

// Returns the mesh of the first convention that the file follows. `name` is a variable that is on
// its cells, or empty. Throws BadValue if there is no variable of this name or no convention fits.
MeshContent read_by_convention(const io::NetcdfReader& file, const std::string& name,
                               MissingCorners corners = MissingCorners::error);

// Each reader returns nothing if the file does not follow its convention, or if `name` is not empty
// and that variable is not on cells of this convention. Throws BadValue for a file that follows the
// convention and is wrong.
std::optional<MeshContent> read_ugrid(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_scrip_grid(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_esmf_mesh(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_mpas_cells(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_icon(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_oasis(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_exodus(const io::NetcdfReader& file, const std::string& name);
std::optional<MeshContent> read_cf_grid(const io::NetcdfReader& file, const std::string& name,
                                        MissingCorners corners);

// Returns the variable that a name means: for "tas[3]" or "tas_2001-07-15" it is tas. Throws
// BadValue if there is none.
std::string variable_of(const io::NetcdfReader& reader, const std::string& name);
// Returns the middles of the edges that a variable of UGRID is on, in degrees; nothing if it is
// elsewhere, or the file has `edge_coordinates`. Throws BadValue for an edge without two nodes.
std::vector<LonLat> middles_of_edges(const io::NetcdfReader& file, const std::string& name);

// True if `name` is empty, or names a variable that shares a dimension with `cells`.
bool is_meant(const io::NetcdfReader& file, const std::string& name,
              const io::VariableInFile& cells);

// The variables of longitudes and latitudes; null if there is no such variable.
struct MeshCoordinates {
  const io::VariableInFile* lon = nullptr;
  const io::VariableInFile* lat = nullptr;
};
// Returns longitudes, then latitudes in degrees. A variable without units gets the units of the
// related one, or of another one of the four, or else the usual ones.
std::array<std::vector<double>, 2> degrees_of_both(const io::NetcdfReader& file,
                                                   const MeshCoordinates& wanted,
                                                   const MeshCoordinates& related,
                                                   UsualUnits usual);
// Returns the coordinates of degrees_of_both() as positions. Throws BadValue if the two variables
// have different numbers of values.
std::vector<LonLat> positions_of(const io::NetcdfReader& file, const MeshCoordinates& wanted,
                                 const MeshCoordinates& related, UsualUnits usual);
// Reads the nodes of a mesh, their precision and the names of their variables. Missing nodes are
// NaN; `centers` give the units if the nodes have none.
void take_nodes(const io::NetcdfReader& file, const MeshCoordinates& nodes,
                const MeshCoordinates& centers, UsualUnits usual, MeshContent& mesh);
// True if a coordinate of a place is NaN.
bool is_missing_place(const LonLat& place);
// True if the numbers are a place, up to rounding of single precision.
bool is_nearly_place(const LonLat& place);
// Returns a place, with a latitude that rounding has put beyond a pole moved to the pole. Throws
// BadValue, with i and the names of the variables, if the numbers are no place.
LonLat require_position(const std::string& names, std::size_t i, const LonLat& place);
// True if more than one of the lengths is above 1: the cells of (1, n) are a list.
bool has_rows(std::span<const std::uint64_t> shape);
// Makes cells that have corners of their own: the nodes, `corners_per_cell` for each cell. If
// `may_be_fewer`, missing nodes at the end of a cell are no corners.
void end_cells_of_nodes(std::size_t corners_per_cell, bool may_be_fewer, MeshContent& mesh);
// The nodes that are corners of cells. A row has `corners_per_cell` entries; if there are counts,
// only the first ones of a row, as many as its count, are in use. If `corners_per_cell` is 0, the
// rows have different lengths, which are the counts.
struct Connectivity {
  const io::VariableInFile& variable;
  std::uint64_t num_cells;
  std::uint64_t corners_per_cell;
  bool is_transposed;  // true if the cells are the last dimension
  double first;        // the number that the file gives to the first node
  // The entry that begins a further ring; not in use if it is `first` or more.
  double break_value = 0;
};
// Reads the corners of all cells. `counts` are the lengths of rows, or empty. Throws BadValue for a
// corner that is no node, unless its cell is masked: the mask has to be read before.
void take_connectivity(const io::NetcdfReader& file, const Connectivity& connectivity,
                       const std::vector<double>& counts, MeshContent& mesh);
// The numbers by which a file masks cells: 0, or all others.
enum class MaskedBy : std::uint8_t { zero, others };
// Reads a mask of cells from a variable; missing values mask as well. Does nothing if there is no
// such variable.
void take_mask(const io::NetcdfReader& file, std::string_view name, std::uint64_t num_cells,
               MaskedBy masked_by, MeshContent& mesh);
// Reads the centers of cells, if the file has them. `nodes` give the units if the centers have
// none. Throws BadValue if there is not one center for each cell.
void take_centers(const io::NetcdfReader& file, const MeshCoordinates& centers,
                  const MeshCoordinates& nodes, UsualUnits usual, MeshContent& mesh);
// Returns a sentence on the variables of a file that are no part of its mesh and whose names are not
// among those that were `read`; empty if there are none.
std::string remark_on_fields(const io::NetcdfReader& file, std::span<const std::string> read);
// Removes the rings of cells with a corner at a missing node, sets their mask to 0, and adds a
// remark with their number. Throws BadValue for other nodes that are no places.
void leave_out_cells_without_corners(MeshContent& mesh);
// Returns the first number of an attribute, or `otherwise` if there is no such attribute.
double number_or(const io::VariableInFile& variable, std::string_view name, double otherwise);
// Returns the file with the variables of its mesh as they are at all times, if some of them have time
// as their first dimension, as files have that were joined. Those that change keep that dimension,
// and the functions below refuse them. Nothing if there are none.
std::optional<io::NetcdfReader> without_times_of_mesh(const io::NetcdfReader& file);
// Throws BadValue unless the variable has this number of values.
void require_values(const io::VariableInFile& variable, std::uint64_t wanted);
// Throws BadValue unless the variable has this number of dimensions; returns the variable.
const io::VariableInFile& require_rank(const io::VariableInFile& variable, std::size_t rank);

}  // namespace rondel::formats
