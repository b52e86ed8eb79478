// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A region laid over sets of cells of every kind, judged by the oracle of oracle.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/types.h"
#include "unit/overlay/oracle.h"
#include "unit/overlay/shapes.h"

namespace rondel::test {

// A set of cells, and convex cells or boxes of which its cells are made.
struct Cover {
  std::string name;
  CellSet cells;
  std::vector<OracleCell> convex;
  std::vector<OracleBox> boxes;
  std::vector<Index> owners;  // of the convex cells or boxes; no_index: none
};

inline constexpr std::uint64_t num_cover_sets = 5;

// Voronoi cells, triangles, grids of both kinds of sides and regions that do not cover the sphere.
const std::vector<Cover>& known_covers(std::uint64_t set);

// Of the convex cells.
std::vector<Point> corners_of(const Cover& cover);

// Expectations on one cell of these rings.
class Trial {
 public:
  // Everything is asked in both precisions if it is audited.
  Trial(std::vector<RingOfPoints> rings, bool is_audited);

  void expect_areas() const;
  // The pieces in the cells of a cover, by one of the ways to them, or an error that the oracle shares.
  void expect_pieces(const Cover& cover, std::uint64_t way) const;
  [[nodiscard]] const RegionOracle& oracle() const { return oracle_; }
  // Whether the rings go around something twice, or around less than nothing, by more than rounding.
  [[nodiscard]] bool is_wrong() const;

 private:
  struct Laid {
    std::vector<double> pieces;
    double clipped = -1;  // the area that is left of all cells; negative if it was not asked for
  };
  struct Expected {
    std::vector<OracleAnswer> pieces;
    double total = 0;
    double error = 0;
  };
  [[nodiscard]] Laid laid_over(const Cover& cover, std::uint64_t way) const;
  [[nodiscard]] Expected expected_in(const Cover& cover, bool in_full) const;
  [[nodiscard]] bool is_sure(const Laid& laid, const Expected& expected, double least) const;
  [[nodiscard]] bool is_questionable() const;
  [[nodiscard]] bool is_taken_for_nothing(double found) const;

  std::vector<RingOfPoints> rings_;
  CellRings cells_;
  RegionOracle oracle_;
  bool is_audited_;
};

}  // namespace rondel::test
