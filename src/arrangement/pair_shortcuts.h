// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Set operations on a small polygon and one of many corners, whose sides may all be far from the
// small one: then that is inside or outside of the large one, and no arrangement of both is needed.
//
// in    pairs of polygons
// out   sides of which the operation makes the same result, bit by bit
// index pairs; polygons of each operand
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "arrangement/set_regions.h"
#include "rondel/cell_rings.h"
#include "rondel/set_operations.h"
#include "rondel/types.h"

namespace rondel::arrangement {

class LonePolygon;

class PairShortcuts {
 public:
  // Prepares the polygons of many corners that are in several pairs. What is given stays valid.
  PairShortcuts(const CellRings& first, const CellRings& second,
                std::span<const std::array<Index, 2>> pairs, SetOperation operation,
                unsigned threads);
  ~PairShortcuts();
  PairShortcuts(const PairShortcuts&) = delete;
  PairShortcuts& operator=(const PairShortcuts&) = delete;

  // Returns the sides of a pair, or fewer sides that have the same result.
  [[nodiscard]] Sides sides(std::size_t pair) const;

 private:
  using LargePolygons = std::vector<std::unique_ptr<LonePolygon>>;  // null for the others

  void prepare(std::size_t operand, unsigned threads);
  // Returns fewer sides if the polygon of an operand is far from all sides of the other one.
  [[nodiscard]] std::optional<Sides> sides_of_small(std::size_t pair, std::size_t operand) const;

  std::array<const CellRings*, 2> operands_;
  std::span<const std::array<Index, 2>> pairs_;
  SetOperation operation_;
  std::array<LargePolygons, 2> large_;
};

}  // namespace rondel::arrangement
