// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The two ways in which MPAS has the places of cells, edges and vertices.
#pragma once

#include <string>

#include "io/netcdf_reader.h"
#include "rondel/export.h"

namespace rondel::io {

// Throws BadValue with the first place, if lonCell and latCell are not the directions of xCell,
// yCell and zCell; `kind` is "Cell", "Edge" or "Vertex". Does nothing if the file lacks one of them.
RONDEL_API void require_one_place(const NetcdfReader& file, const std::string& kind);

}  // namespace rondel::io
