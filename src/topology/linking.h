// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// From the flat arrays of a result back to the data structure.
#pragma once

#include <span>

#include "rondel/triangulation.h"
#include "topology/mesh.h"

namespace rondel::topology {

// The faces under the same numbers, their vertices renamed: names[v] for v.
Mesh link_faces(std::span<const Triple> faces, std::span<const Triple> neighbors,
                std::span<const Index> names);

}  // namespace rondel::topology
