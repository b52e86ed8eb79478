// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Rings and lines as one network of nodes: which of them may be removed, and between which others
// these are.
//
// in    rings of cells, lines of features
// out   the nodes of each ring and line, and the neighbors of each node
// index nodes: along the spatial order, one for all points on a ray; rings and lines: as given
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"

namespace rondel::arrangement {

struct LineNetwork {
  std::vector<Point> points;    // of nodes
  CompressedRows<Index> rings;  // without repeated nodes
  CompressedRows<Index> lines;
  // For a node that may be removed its two neighbors: all rings and lines pass it between these.
  // For others no_index.
  std::vector<std::array<Index, 2>> neighbors;

  [[nodiscard]] bool is_fixed(Index node) const { return neighbors[node][0] == no_index; }
};

// Throws InvalidInput as simplified() does. `keeps_boundary`: nodes that one ring alone passes,
// once, may not be removed.
LineNetwork line_network(const FeatureLines& lines, const CellRings& polygons, bool keeps_boundary,
                         unsigned threads);

}  // namespace rondel::arrangement
