// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes an array of Arrow of lists of lists of positions, which owns what is in it.
//
// in    the lists of each level from the outermost on, and positions
// out   a schema and an array of the C data interface, which free themselves when they are released
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondel/arrow.h"
#include "rondel/types.h"

namespace rondel::formats {

// The lists of a level: list i has the elements offsets[i] ... offsets[i+1]-1 of the next level.
struct ArrowLists {
  const char* name;  // of the field; it is never freed
  std::vector<std::int32_t> offsets;
};

// Returns offsets as an array of Arrow has them. Throws InvalidInput if they do not fit to so many
// elements, or if these are too many.
std::vector<std::int32_t> arrow_offsets(std::span<const std::uint64_t> offsets,
                                        std::size_t num_elements);

// Makes an array whose type is named `type`, such as "geoarrow.multipoint". Names of the positions'
// fields are those of GeoArrow.
void export_lists(const std::string& type, PolygonEdges edges, std::vector<ArrowLists> lists,
                  const char* name_of_positions, std::span<const LonLat> positions,
                  ArrowSchema& schema, ArrowArray& array);

}  // namespace rondel::formats
