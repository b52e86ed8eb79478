// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the arrays of MPAS's format, which other formats lack (read_mesh.cpp), and compares the two
// ways in which it gives the places of cells, edges and vertices.
//
// in    a file with longitudes and latitudes in radians, and x, y and z in units of length
// out   an exception that names the first place where both differ
// index cells, edges or vertices, from 0
#pragma once

#include <cstdint>
#include <string>

#include "io/netcdf_reader.h"
#include "rondel/mesh.h"

namespace rondel::formats {

// Says whether longitudes and latitudes may be missing (numbers that are no place), as files have
// it for cells that are left out.
enum class PlacesMay : std::uint8_t { be_missing, not_be_missing };

// Throws BadValue with the first element whose longitude and latitude (lonCell, latCell) are not
// the direction of its xCell, yCell, zCell, or are no place although `may` forbids that. `kind` is
// "Cell", "Edge" or "Vertex". Does nothing if the file lacks one of the five variables.
void require_one_place(const io::NetcdfReader& file, const std::string& kind, PlacesMay may);

// True if a file has the lists of edges that a whole mesh of MPAS has.
bool has_mpas_arrays(const io::NetcdfReader& file);

// Returns the arrays that an MPAS file holds, with the orders that VoronoiMesh documents and
// indices from 0, where the file counts from 1. Throws BadValue if they are not those of a mesh.
mesh::VoronoiMesh read_mpas_arrays(const io::NetcdfReader& file, const Execution& execution);

// Returns a sentence on the first list of the file that read_mpas_arrays() does not read and that
// has other cells, edges or vertices than the mesh; empty if there is none. Throws BadValue if a
// list cannot be read.
std::string remark_on_lists(const io::NetcdfReader& file, const mesh::VoronoiMesh& mesh,
                            unsigned threads);

}  // namespace rondel::formats
