// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The parts into which polygons that overlap divide each other.
//
// in    polygons as cells
// out   parts that do not overlap, with the polygons that own each
// index polygons
//
// All sides are arranged once. The faces of the arrangement that the same polygons have are a part.
#pragma once

#include <cstdint>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// Who owns a place that several polygons have.
enum class PlaceOwners : std::uint8_t { all, first };

// The parts, and the owners of each in ascending order. Parts are sorted by their owners.
struct OwnedParts {
  CellRings parts;
  CompressedRows<Index> owners;
};

// Returns the parts of all polygons. Corners are those of the polygons, bit by bit, and places where
// sides cross (rondel/arrangement.h). Throws InvalidInput as combine() does.
OwnedParts owned_parts(const CellRings& polygons, PlaceOwners rule, const Execution& execution);

}  // namespace rondel::arrangement
