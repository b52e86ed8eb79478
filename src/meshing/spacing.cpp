// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <cmath>
#include <numbers>

#include "rondel/mesh.h"

namespace rondel::mesh {

double spacing_of(double area) { return std::sqrt(area * (2 * std::numbers::inv_sqrt3)); }

}  // namespace rondel::mesh
