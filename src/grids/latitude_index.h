// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds the cells of a grid that touch a band between two parallels.
//
// in    cells
// out   their bands, and cells by band
// index cells, as in the grid; bands from the south pole to the north pole
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grids/grid_formula.h"
#include "rondel/types.h"

namespace rondel::grids {

// The number of bands, which have equal areas.
inline constexpr unsigned num_bands = 1U << 16U;

// Returns the band of a place whose latitude has this sine.
unsigned band_of(double sine);

// A range of bands, with both ends.
struct BandRange {
  unsigned first;
  unsigned last;
};

class LatitudeIndex {
 public:
  LatitudeIndex(const GridFormula& grid, unsigned threads);

  // Returns bands that a cell is in, perhaps with some more.
  [[nodiscard]] BandRange bands_of(Index cell) const { return {lowest_[cell], highest_[cell]}; }
  // Returns how many cells have their middle in a band.
  [[nodiscard]] std::size_t num_middles(unsigned band) const {
    return begins_[band + 1] - begins_[band];
  }
  // Returns the cells whose middles are in the bands, in ascending order.
  [[nodiscard]] std::vector<Index> cells_with_middles(const BandRange& bands) const;
  // Returns the cells that touch the bands, perhaps with some more, in ascending order.
  [[nodiscard]] std::vector<Index> cells_touching(const BandRange& bands) const;

 private:
  [[nodiscard]] unsigned middle_of(Index cell) const {
    return (unsigned{lowest_[cell]} + highest_[cell]) / 2;
  }

  std::vector<std::uint16_t> lowest_;  // of each cell
  std::vector<std::uint16_t> highest_;
  std::vector<Index> sorted_;    // the cells by the band of their middle, ascending within a band
  std::vector<Index> begins_;    // the first one of each band in sorted_, and the end
  std::vector<unsigned> reach_;  // how many bands a cell reaches beyond its middle, by that band
};

}  // namespace rondel::grids
