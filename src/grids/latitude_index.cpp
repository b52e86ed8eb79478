// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/latitude_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "exact/vector.h"
#include "overlay/subdivision.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::grids {
namespace {

// Returns the bands of a ring of arcs. An arc of chord c is at most c^2 / 8 beyond the coordinates
// of its ends, and somewhat more where it is long. A ring that is nearer to a pole than to its own
// corners may go around it. A cell with a larger area than the cap around its corners reaches beyond
// that cap; a cell without corners is empty.
BandRange bands_of_ring(std::span<const Point> ring, double area) {
  if (ring.empty()) return {num_bands / 2, num_bands / 2};
  double least = 1;
  double most = -1;
  double longest = 0;  // squared chord
  Point sum{};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point step = ring[k + 1 < ring.size() ? k + 1 : 0] - ring[k];
    longest = std::max(longest, dot(step, step));
    least = std::min(least, ring[k].z);
    most = std::max(most, ring[k].z);
    sum = sum + ring[k];
  }
  constexpr double long_arc = 1;
  if (longest > long_arc) return {0, num_bands - 1};
  const double bulge = longest / 6 + 1e-12;
  const Point center = normalized(sum);
  double cosine = 1;  // of the angle to the farthest corner
  for (const Point& corner : ring) cosine = std::min(cosine, dot(center, corner));
  const double nearly = cosine - bulge;
  if (area > 2 * std::numbers::pi * (1 - nearly)) return {0, num_bands - 1};
  return {center.z < -nearly ? 0 : band_of(least - bulge),
          center.z > nearly ? num_bands - 1 : band_of(most + bulge)};
}

}  // namespace

unsigned band_of(double sine) {
  const double band = std::floor((sine + 1) * (num_bands / 2.0));
  return static_cast<unsigned>(std::clamp(band, 0.0, num_bands - 1.0));
}

LatitudeIndex::LatitudeIndex(const GridFormula& grid, unsigned threads)
    : lowest_(grid.num_cells()),
      highest_(grid.num_cells()),
      sorted_(grid.num_cells()),
      begins_(num_bands + 1, 0),
      reach_(num_bands, 0) {
  system::parallel_for(
      threads, lowest_.size(), overlay::cells_per_task, [&](std::size_t begin, std::size_t end) {
        std::vector<Point> ring;
        for (std::size_t i = begin; i < end; ++i) {
          ring.clear();
          grid.append_ring(static_cast<Index>(i), ring);
          const BandRange bands = bands_of_ring(ring, grid.area(static_cast<Index>(i)));
          lowest_[i] = static_cast<std::uint16_t>(bands.first);
          highest_[i] = static_cast<std::uint16_t>(bands.last);
        }
      });
  std::vector<Index> next(num_bands + 1, 0);
  for (Index i = 0; i < lowest_.size(); ++i) ++next[middle_of(i) + 1];
  system::sum_counts(next);
  begins_ = next;
  for (Index i = 0; i < lowest_.size(); ++i) {
    const unsigned middle = middle_of(i);
    sorted_[next[middle]++] = i;
    reach_[middle] = std::max({reach_[middle], middle - lowest_[i], highest_[i] - middle});
  }
}

std::vector<Index> LatitudeIndex::cells_with_middles(const BandRange& bands) const {
  std::vector<Index> cells(sorted_.begin() + begins_[bands.first],
                           sorted_.begin() + begins_[bands.last + 1]);
  std::ranges::sort(cells);
  return cells;
}

std::vector<Index> LatitudeIndex::cells_touching(const BandRange& bands) const {
  std::vector<Index> cells;
  for (unsigned band = 0; band < num_bands; ++band) {
    if (band + reach_[band] < bands.first || band > bands.last + reach_[band]) continue;
    for (Index k = begins_[band]; k < begins_[band + 1]; ++k) {
      const Index cell = sorted_[k];
      if (highest_[cell] >= bands.first && lowest_[cell] <= bands.last) cells.push_back(cell);
    }
  }
  std::ranges::sort(cells);
  return cells;
}

}  // namespace rondel::grids
