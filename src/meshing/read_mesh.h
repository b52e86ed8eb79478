// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string_view>

#include "rondel/mesh.h"

namespace rondel::meshing {

// The arrays that the bytes of an MPAS file hold. Throws BadValue.
mesh::MeshArrays read_mpas(std::string_view bytes, const Execution& execution);

}  // namespace rondel::meshing
