// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The content of the handles of polygons, and arguments of functions on polygons.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel.h"
#include "rondel/cell_rings.h"
#include "rondel/polygon_files.h"
#include "rondel/set_operations.h"

// NOLINTBEGIN(readability-identifier-naming): C's names
struct rondel_features {
  rondel::LonLatMultiPolygons features;
};

struct rondel_texts {
  std::vector<std::string> texts;
};

struct rondel_polygons {
  rondel::CellRings rings;
  std::vector<rondel::Point> points;  // one for each corner, as C reads them

  explicit rondel_polygons(rondel::CellRings made);
};
// NOLINTEND(readability-identifier-naming)

namespace rondel::c {

// Returns offsets of n rows. Throws InvalidInput unless they begin with 0 and never decrease.
std::vector<std::uint64_t> copied_offsets(const std::uint64_t* offsets, std::size_t n,
                                          const char* name);
// Returns n positions.
std::vector<LonLat> copied_positions(const double* lonlat_deg, std::size_t n);
// Throws InvalidInput if a point is no unit vector; `what` says what it is.
void require_unit_vectors(std::span<const Point> points, const std::string& what);

// Return what the numbers of C stand for.
PolygonEdges edges_of(std::int32_t edges);
PolygonOptions reading_of(const rondel_reading* reading);
SetOperation operation_of(std::int32_t operation);

// Returns n pairs.
std::vector<std::array<Index, 2>> copied_pairs(const std::uint32_t* pairs, std::size_t n);

}  // namespace rondel::c
