// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lines that are asked many times where they meet others.
//
// in    the lines of a feature, between numbered nodes
// out   their arcs, each once, divided at their nodes; their boundary
// index nodes, sides and components of PreparedSides
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "arrangement/prepared_sides.h"
#include "rondel/feature_cells.h"
#include "rondel/types.h"

namespace rondel::arrangement {

class PreparedLines : public PreparedSides {
 public:
  // Makes no lines.
  PreparedLines() = default;
  // `points` has the places of the nodes, and stays valid; `numbers` has the node of each point of
  // the lines.
  PreparedLines(const FeatureLines& lines, std::size_t feature, std::span<const Point> points,
                std::span<const Index> numbers);

  // Returns the nodes in which an odd number of lines begins or ends, sorted.
  [[nodiscard]] std::span<const Index> boundary() const { return boundary_; }
  [[nodiscard]] bool has_boundary(Index node) const;

 private:
  std::vector<Index> boundary_;
};

}  // namespace rondel::arrangement
