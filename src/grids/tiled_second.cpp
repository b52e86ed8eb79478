// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights of second order of a tile: TileMaker::complete_second().
//
// A piece has its moment around the mean of its source, which all pieces of the source decide, and the
// gradient of a source depends on its neighbors. So the pieces of all targets that touch sources of the
// tile are computed, and these sources are made with all that touch their bands.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "exact/eft.h"
#include "exact/vector.h"
#include "grids/tile_maker.h"
#include "overlay/linear_weights.h"
#include "overlay/measure.h"

namespace rondel {
namespace {

using grids::BandRange;
using overlay::CellSetData;

// Returns the first row of a grid that touches the bands, and the one after the last; rows ascend or
// descend in latitude.
std::pair<unsigned, unsigned> rows_touching(const std::vector<double>& latitudes,
                                            const BandRange& bands) {
  unsigned first = static_cast<unsigned>(latitudes.size() - 1);
  unsigned end = 0;
  for (unsigned row = 0; row + 1 < latitudes.size(); ++row) {
    const BandRange own = grids::bands_between(latitudes, row, row + 1);
    if (own.first > bands.last || own.last < bands.first) continue;
    first = std::min(first, row);
    end = row + 1;
  }
  return {std::min(first, end), end};
}

}  // namespace

// Returns the bands that the targets of a tile are in.
BandRange TiledRemap::TileMaker::reach_of_targets(unsigned begin, unsigned end) const {
  if (!target_index) return bands_of_rows(begin, end);
  return grids::reach_of(*target_index, target_index->cells_with_middles({begin, end - 1}));
}

// Returns the bands that sources which touch some bands are in, with these.
BandRange TiledRemap::TileMaker::reach_of_sources(const BandRange& bands) const {
  if (source_index)
    return grids::reach_of(*source_index, source_index->cells_touching(bands), bands);
  const std::vector<double>& latitudes = source().lines.lat_deg;
  const auto [first, end] = rows_touching(latitudes, bands);
  if (first == end) return bands;
  const BandRange all = grids::bands_between(latitudes, first, end);
  return {std::min(all.first, bands.first), std::max(all.last, bands.last)};
}

// Returns bands, or rows, whose targets are all that touch some bands, perhaps with others.
std::pair<unsigned, unsigned> TiledRemap::TileMaker::targets_touching(
    const BandRange& bands) const {
  if (!target_index) return rows_touching(target().lines.lat_deg, bands);
  const BandRange all = grids::reach_of(*target_index, target_index->cells_touching(bands), bands);
  return {all.first, all.last + 1};
}

TiledRemap::TileMaker::SourcePart TiledRemap::TileMaker::sources_in(
    const BandRange& bands, const Execution& execution) const {
  SourcePart part;
  if (source_index) {
    grids::TileCells made_cells =
        grids::made(*source().formula, source_index->cells_touching(bands), execution);
    part = {std::move(made_cells.names), std::move(made_cells.cells)};
  } else {
    const auto [first, end] = rows_touching(source().lines.lat_deg, bands);
    if (first == end) return part;
    LonLatGrid lines = source().lines;
    const auto line = lines.lat_deg.begin();
    lines.lat_deg = {line + first, line + end + 1};
    const Index row_length = source().grid->num_columns_of_grid();
    part.names.resize(std::size_t{end - first} * row_length);
    std::iota(part.names.begin(), part.names.end(), first * row_length);
    part.cells = CellSet::lonlat_grid(lines, GridSides::parallels, execution);
  }
  if (options.source_mask.empty()) return part;
  CellFacts facts = part.cells.facts();
  facts.mask.clear();
  for (const Index name : part.names) facts.mask.push_back(options.source_mask[name]);
  part.cells = part.cells.with_facts(std::move(facts));
  return part;
}

// Takes the rows of the targets of a tile; returns the area of each that sources cover.
std::vector<double> TiledRemap::TileMaker::take_own_rows(RemapTile& tile, const TilePieces& all,
                                                         const Remap& whole, unsigned begin,
                                                         unsigned end) const {
  if (target_index) {
    tile.targets = target_index->cells_with_middles({begin, end - 1});
  } else {
    const Index row_length = target().grid->num_columns_of_grid();
    tile.targets.resize(std::size_t{end - begin} * row_length);
    std::iota(tile.targets.begin(), tile.targets.end(), begin * row_length);
  }
  std::vector<double> covered_areas;
  Remap& own = tile.part;
  std::size_t row = 0;
  for (const Index target : tile.targets) {
    while (all.targets[row] != target) ++row;
    for (std::uint64_t k = whole.pieces.offsets[row]; k < whole.pieces.offsets[row + 1]; ++k) {
      own.pieces.values.push_back(whole.pieces.values[k]);
      own.areas.push_back(whole.areas[k]);
      own.moments.push_back(whole.moments[k]);
    }
    own.pieces.end_row();
    const double covered = all.pieces.row_sums[row];
    const double area = overlay::counted_area(covered, all.areas[row], all.lengths[row]);
    covered_areas.push_back(covered);
    tile.areas.push_back(area);
    tile.fractions.push_back(area > 0 ? covered / area : 0);
  }
  own.target_areas = tile.areas;
  own.target_fractions = tile.fractions;
  return covered_areas;
}

// The moments of a piece depend on all pieces of its source, so these are computed with those of all
// targets that touch sources of the tile. Gradients depend on neighbors of the sources.
void TiledRemap::TileMaker::complete_second(RemapTile& tile, unsigned begin, unsigned end,
                                            const Execution& execution) const {
  tile.part.order = 2;
  tile.part.norm = options.norm;
  if (target_index && target_index->cells_with_middles({begin, end - 1}).empty()) return;
  const BandRange reach = reach_of_sources(reach_of_targets(begin, end));
  const auto [first, last] = targets_touching(reach);
  TilePieces all = pieces_of_tile(std::min(first, begin), std::max(last, end), execution);
  SourcePart part = sources_in(reach, execution);
  const CellSetData& data = CellSetData::of(part.cells);
  const std::size_t num_sources = part.names.size();
  const auto number_of = [&](Index name) {
    const auto at = std::ranges::lower_bound(part.names, name);
    return at != part.names.end() && *at == name ? static_cast<Index>(at - part.names.begin())
                                                 : no_index;
  };
  // The pieces of all rows in these sources; others end beyond the tile.
  Remap whole;
  std::vector<Point> moments;
  std::vector<exact::DoubleDouble> sums(num_sources);
  std::vector<Point> means(num_sources);
  for (std::size_t row = 0; row < all.targets.size(); ++row) {
    for (std::uint64_t k = all.pieces.offsets[row]; k < all.pieces.offsets[row + 1]; ++k) {
      const Index source = number_of(all.pieces.columns[k]);
      if (source == no_index) continue;
      whole.pieces.values.push_back(source);
      whole.areas.push_back(all.pieces.areas[k]);
      moments.push_back(all.pieces.moments[k]);
      add_term(all.pieces.areas[k], sums[source]);
      means[source] = means[source] + all.pieces.moments[k];
    }
    whole.pieces.end_row();
  }
  // Nothing but their sums is needed of these any more.
  all.pieces.columns = {};
  all.pieces.areas = {};
  all.pieces.moments = {};
  for (std::size_t i = 0; i < num_sources; ++i) {
    if (const double sum = sums[i].hi + sums[i].lo; sum > 0) means[i] = means[i] / sum;
  }
  std::vector<Point> centers = overlay::means_of(data.areas(), data.moments());
  whole.moments = overlay::moments_around(means, whole, std::move(moments));
  const std::vector<double> covered_areas = take_own_rows(tile, all, whole, begin, end);
  const overlay::CellGradients gradients =
      cell_gradients(data, centers, part.cells.facts().mask, execution.threads);
  Remap& own = tile.part;
  own.source_areas.assign(data.areas().begin(), data.areas().end());
  own.source_centers = std::move(centers);
  own.source = std::move(part.cells);
  const auto& divisors = options.norm == RemapNorm::destarea ? own.target_areas : covered_areas;
  own.weights = linear_weights(own, gradients, divisors, {}, execution.threads);
  own.weights.num_columns = num_sources;
  tile.weights = own.weights;
  if (!part.names.empty()) {
    tile.first_source = part.names.front();
    tile.weights.num_columns = part.names.back() - part.names.front() + std::size_t{1};
  }
  for (Index& column : tile.weights.columns) column = part.names[column] - tile.first_source;
  tile.sources = std::move(part.names);
}

}  // namespace rondel
