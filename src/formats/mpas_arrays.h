// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Reads the arrays of MPAS's format; other formats have cells and corners only (read_mesh.cpp).
// in    a netCDF file
// out   the arrays of a mesh, with the orders that MeshArrays documents
// index from 0, where the file counts from 1
#pragma once

#include "io/netcdf_reader.h"
#include "rondel/mesh.h"

namespace rondel::formats {

// True if a file has the lists of edges that a whole mesh of MPAS has.
bool has_mpas_arrays(const io::NetcdfReader& file);

// Returns the arrays that an MPAS file holds. Throws BadValue if they are not those of a mesh.
mesh::MeshArrays read_mpas_arrays(const io::NetcdfReader& file, const Execution& execution);

}  // namespace rondel::formats
