// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// How often closed lines of the plane go around a place; by exact signs.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "map/directed_line.h"

namespace rondel::map {

// Precondition: lines cross and touch in common ends only; as many leave a position as reach it.
class Windings {
 public:
  // Keeps a reference.
  explicit Windings(std::span<const DirectedLine> lines);

  // To the left and to the right of one of the lines.
  [[nodiscard]] std::pair<int, int> beside(const DirectedLine& line) const;

 private:
  [[nodiscard]] std::size_t list_at(double lon_deg) const;

  std::span<const DirectedLine> lines_;
  std::vector<std::vector<std::size_t>> lists_;  // lines by longitude
};

}  // namespace rondel::map
