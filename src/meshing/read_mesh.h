// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "io/netcdf_reader.h"
#include "rondel/mesh.h"

namespace rondel::meshing {

// The arrays that an MPAS file holds. Throws BadValue and FileError.
mesh::MeshArrays read_mpas(const io::NetcdfReader& file, const Execution& execution);

}  // namespace rondel::meshing
