// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The checks of arguments that all interpolators make.
//
// in    targets, options, sizes
// out   nothing, or InvalidInput
// index targets and sites in the order of the arguments
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "interpolation/prepared_triangulation.h"
#include "rondel/interpolate.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// Throws InvalidInput for targets that are none, for a method that the sites do not have, and for
// sites in one place where that is an error.
void require_targets(const PreparedTriangulation& prepared, std::span<const Point> targets,
                     const InterpolationOptions& options);

// Returns how many fields an array of `size` values has. Throws InvalidInput, which begins with the
// name of the array.
std::size_t num_fields_of(const PreparedTriangulation& prepared, std::string_view name,
                          std::size_t size);

// Throws InvalidInput for a target outside of all faces; no_index: there is none.
void refuse_outside(Index target);

}  // namespace rondel::interpolation
