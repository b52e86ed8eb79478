// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Regrids a field that is larger than one would keep, tile by tile: the means of a field on a grid of
// a quarter of a degree over the pixels of HEALPix, and what they add up to.

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "rondel/named_grids.h"
#include "rondel/tiled_remap.h"

namespace {

// A field that is computed where it is needed: the square of the sine of latitude, whose mean over
// the sphere is 1/3.
double value_at(std::size_t source) {
  constexpr double pi = 3.14159265358979323846;
  constexpr std::size_t row_length = 1440;
  const double latitude = (static_cast<double>(source / row_length) + 0.5) / 4 - 90;
  const double sine = std::sin(latitude * pi / 180);
  return sine * sine;
}

}  // namespace

int main() {
  const rondel::TiledRemap tiled(rondel::TiledCells(rondel::NamedGrid("grid:0.25")),
                                 rondel::TiledCells(rondel::NamedGrid("healpix:6")));
  double sum = 0;
  double area = 0;
  for (std::size_t t = 0; t < tiled.num_tiles(); ++t) {
    const rondel::RemapTile tile = tiled.tile(t);
    // Column c of the tile's weights is source tile.first_source + c.
    std::vector<double> values(tile.weights.num_columns);
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = value_at(tile.first_source + c);
    std::vector<double> means(tile.targets.size());
    rondel::apply(tile.weights, values, means);
    // Row r is target tile.targets[r].
    for (std::size_t r = 0; r < means.size(); ++r) sum += tile.areas[r] * means[r];
    for (const double of_target : tile.areas) area += of_target;
  }
  std::printf("%zu targets in %zu tiles, mean %.6f\n", tiled.num_targets(), tiled.num_tiles(),
              sum / area);
}
