// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/tiled_remap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/eft.h"
#include "grids/formula_cells.h"
#include "grids/grid_formula.h"
#include "grids/latitude_index.h"
#include "grids/tile_maker.h"
#include "overlay/cell_set_data.h"
#include "overlay/grid_pieces.h"
#include "overlay/measure.h"
#include "overlay/pieces.h"
#include "overlay/prepared_grid.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/row_assembly.h"

namespace rondel {
namespace {

using grids::BandRange;
using grids::TileCells;
using overlay::CellSetData;
using overlay::PieceRows;
using overlay::PreparedGrid;

// The cells of a set, as those of a grid that is computed.
class StoredCells : public grids::GridFormula {
 public:
  explicit StoredCells(CellSet cells)
      : cells_(std::move(cells)), rings_(cells_.given_rings()), sides_(cells_.sides()) {}

  [[nodiscard]] Index num_cells() const override { return static_cast<Index>(cells_.num_cells()); }
  [[nodiscard]] LonLat center(Index cell) const override { return cells_.places()[cell]; }
  void append_ring(Index cell, std::vector<Point>& ring) const override {
    const std::uint64_t begin = rings_.rings[rings_.cells[cell]];
    const std::uint64_t end = rings_.rings[rings_.cells[cell + std::size_t{1}]];
    for (std::uint64_t k = begin; k < end; ++k) ring.push_back(rings_.points[rings_.corners[k]]);
  }
  [[nodiscard]] const CellRings* stored() const override { return &rings_; }
  [[nodiscard]] const CompressedRows<LonLatSide>* stored_sides() const override { return &sides_; }
  [[nodiscard]] double area(Index cell) const override {
    return CellSetData::of(cells_).areas()[cell];
  }

 private:
  CellSet cells_;
  CellRings rings_;
  CompressedRows<LonLatSide> sides_;
};

// Throws InvalidInput if there is a mask of another length.
void require_mask(const std::vector<std::int32_t>& mask, std::size_t num_cells, const char* name) {
  if (mask.empty() || mask.size() == num_cells) return;
  throw InvalidInput(std::string("the mask of the ") + name + " has " +
                     std::to_string(mask.size()) + " values for " + std::to_string(num_cells) +
                     " cells");
}

bool is_out(const std::vector<std::int32_t>& mask, Index cell) {
  return !mask.empty() && mask[cell] == 0;
}

}  // namespace

namespace grids {

TileCells made(const GridFormula& formula, std::vector<Index> names, const Execution& execution) {
  CellSet cells = cells_of(formula, names, execution);
  return {std::move(names), std::move(cells)};
}

BandRange reach_of(const LatitudeIndex& index, std::span<const Index> cells,
                   const BandRange& others) {
  BandRange all = others;
  for (const Index cell : cells) {
    const BandRange own = index.bands_of(cell);
    all = {std::min(all.first, own.first), std::max(all.last, own.last)};
  }
  return all;
}

BandRange bands_between(const std::vector<double>& latitudes, unsigned first, unsigned end) {
  const auto band = [&](unsigned line) {
    return band_of(exact::sine_cosine_of_degrees(latitudes[line]).sine);
  };
  const auto [low, high] = std::minmax({band(first), band(end)});
  return {low == 0 ? 0 : low - 1, std::min(high + 1, num_bands - 1)};
}

}  // namespace grids

TiledCells::TiledCells(const NamedGrid& grid) {
  if (grid.lines_ && grid.sides_ == GridSides::parallels) {
    *this = TiledCells(*grid.lines_);
  } else if (grid.formula_) {
    content_ = std::make_shared<const CellsOfTiles>(
        CellsOfTiles{std::nullopt, {}, grid.formula_, grid.formula_->covers_sphere()});
  } else {
    *this = TiledCells(grid.cells());
  }
}

TiledCells::TiledCells(const LonLatGrid& lines)
    : content_(
          std::make_shared<const CellsOfTiles>(CellsOfTiles{PreparedGrid(lines), lines, nullptr})) {
}

TiledCells::TiledCells(const CellSet& cells) {
  if (cells.has_parallels()) {
    *this = TiledCells(*cells.lines());
    return;
  }
  const CellSetData& data = CellSetData::of(cells);
  if (data.whole() != no_index) {
    throw InvalidInput("a cell that is the whole sphere has no tiles", data.whole());
  }
  if (data.has_overlaps({})) {
    const auto first = data.some_overlaps(overlay::OverlapsWanted::first, {}, {}).front();
    throw InvalidInput("cells that overlap have no tiles", first.second);
  }
  content_ = std::make_shared<const CellsOfTiles>(CellsOfTiles{
      std::nullopt, {}, std::make_shared<const StoredCells>(cells), data.covers_sphere()});
}

std::size_t TiledCells::num_cells() const { return content_->num_cells(); }
bool TiledCells::has_parallels() const { return content_->grid.has_value(); }

TiledRemap::TileMaker::TileMaker(TiledCells source_side, TiledCells target_side,
                                 TiledRemapOptions given, const Execution& execution)
    : source_cells(std::move(source_side)),
      target_cells(std::move(target_side)),
      options(std::move(given)) {
  require_mask(options.source_mask, source().num_cells(), "source");
  require_mask(options.target_mask, target().num_cells(), "target");
  if (options.order != 1 && options.order != 2) {
    throw InvalidInput("the order is " + std::to_string(options.order) + ", not 1 or 2");
  }
  if (is_second() && source().formula && source().formula->stored() != nullptr) {
    throw InvalidInput("weights of order 2 have no tiles where the sources are in memory");
  }
  const auto is_walked = [](const TiledCells::CellsOfTiles& side) {
    return side.grid || side.covers_sphere;
  };
  if (!is_walked(source()) && !is_walked(target())) {
    throw InvalidInput("neither side covers the sphere or is between parallels");
  }
  if (source().formula) source_index.emplace(*source().formula, execution.threads);
  if (target().formula) target_index.emplace(*target().formula, execution.threads);
  if (source().grid && target().grid) boxes.emplace(*target().grid, *source().grid);
  if (target_index) {
    divide_bands();
  } else {
    divide_rows();
  }
}

// Returns how many cells of the source are in each band, about.
std::vector<double> TiledRemap::TileMaker::sources_by_band() const {
  std::vector<double> counts(grids::num_bands, 0);
  if (source_index) {
    for (unsigned band = 0; band < grids::num_bands; ++band) {
      counts[band] = static_cast<double>(source_index->num_middles(band));
    }
    return counts;
  }
  const PreparedGrid& grid = *source().grid;
  for (Index row = 0; row < grid.num_rows_of_grid(); ++row) {
    const Index at = grid.first_row() + row;
    const unsigned first = grids::band_of(grid.parallel(at).sine);
    const unsigned last = grids::band_of(grid.parallel(at + 1).sine);
    for (unsigned band = first; band <= last; ++band) {
      counts[band] += static_cast<double>(grid.num_columns_of_grid()) / (last - first + 1);
    }
  }
  return counts;
}

void TiledRemap::TileMaker::divide_bands() {
  const std::vector<double> sources = sources_by_band();
  double count = 0;
  for (unsigned band = 0; band < grids::num_bands; ++band) {
    count += sources[band] + static_cast<double>(target_index->num_middles(band));
    if (count < static_cast<double>(options.cells_per_tile)) continue;
    begins.push_back(band + 1);
    count = 0;
  }
  if (begins.back() != grids::num_bands) begins.push_back(grids::num_bands);
}

void TiledRemap::TileMaker::divide_rows() {
  std::vector<double> below = sources_by_band();
  system::sum_counts(below);
  const PreparedGrid& grid = *target().grid;
  double count = 0;
  for (unsigned row = 0; row < grid.num_rows_of_grid(); ++row) {
    const BandRange bands = bands_of_rows(row, row + 1);
    const double share =
        std::abs(exact::sine_cosine_of_degrees(target().lines.lat_deg[row + 1]).sine -
                 exact::sine_cosine_of_degrees(target().lines.lat_deg[row]).sine) *
        (grids::num_bands / 2.0) / (bands.last - bands.first + 1);
    count += grid.num_columns_of_grid() + share * (below[bands.last] - below[bands.first]);
    if (count < static_cast<double>(options.cells_per_tile)) continue;
    begins.push_back(row + 1);
    count = 0;
  }
  if (begins.back() != grid.num_rows_of_grid()) begins.push_back(grid.num_rows_of_grid());
}

// Returns the pieces of targets in the sources. No target reaches beyond the bands.
PieceRows TiledRemap::TileMaker::pieces_in_cells(const CellSetData& targets, const BandRange& bands,
                                                 const Execution& execution) const {
  if (source().grid) return pieces(targets, *source().grid, is_second(), execution, false);
  const TileCells sources = made(*source().formula, source_index->cells_touching(bands), execution);
  PieceRows result = pieces(targets.subdivision(), targets.sizes(), sources.data().subdivision(),
                            is_second(), execution);
  for (Index& column : result.columns) column = sources.names[column];
  return result;
}

// The targets are made together with all that may share a side with them, since the points in which
// a side crosses others are computed once for the cells on both sides of it.
TiledRemap::TileMaker::TilePieces TiledRemap::TileMaker::pieces_of_bands(
    const BandRange& bands, const Execution& execution) const {
  TilePieces result;
  result.targets = target_index->cells_with_middles(bands);
  if (result.targets.empty()) return result;
  // In a grid between parallels each target has its pieces alone.
  const TileCells near =
      made(*target().formula,
           source().grid ? result.targets
                         : target_index->cells_touching(reach_of(*target_index, result.targets)),
           execution);
  const PieceRows all =
      pieces_in_cells(near.data(), reach_of(*target_index, near.names), execution);
  const auto borders = source().grid ? overlay::Borders::straight : overlay::Borders::arcs;
  std::size_t next = 0;
  for (std::size_t k = 0; k < near.names.size() && next < result.targets.size(); ++k) {
    if (near.names[k] != result.targets[next]) continue;
    ++next;
    const auto begin = static_cast<std::ptrdiff_t>(all.offsets[k]);
    const auto end = static_cast<std::ptrdiff_t>(all.offsets[k + 1]);
    PieceRows& rows = result.pieces;
    rows.columns.insert(rows.columns.end(), all.columns.begin() + begin, all.columns.begin() + end);
    rows.areas.insert(rows.areas.end(), all.areas.begin() + begin, all.areas.begin() + end);
    if (is_second()) {
      rows.moments.insert(rows.moments.end(), all.moments.begin() + begin,
                          all.moments.begin() + end);
    }
    rows.row_sums.push_back(all.row_sums[k]);
    rows.end_row();
    result.areas.push_back(near.data().areas(borders)[k]);
    result.lengths.push_back(near.data().lengths(borders)[k]);
  }
  return result;
}

// Returns the pieces of targets, in ascending order, from those of sources, whose rows `found` has.
// Other targets are dropped. Sums are computed in the spatial order of the sources, as remap() does.
PieceRows TiledRemap::TileMaker::by_target(const PieceRows& found, const TileCells& sources,
                                           std::span<const Index> targets) {
  const bool is_range = targets.back() - targets.front() + std::size_t{1} == targets.size();
  const auto row_of = [&](Index target) {
    if (target < targets.front() || target > targets.back()) return no_index;
    if (is_range) return target - targets.front();
    const auto at = std::ranges::lower_bound(targets, target);
    return *at == target ? static_cast<Index>(at - targets.begin()) : no_index;
  };
  PieceRows kept;
  for (std::size_t row = 0; row + 1 < found.offsets.size(); ++row) {
    for (std::uint64_t k = found.offsets[row]; k < found.offsets[row + 1]; ++k) {
      const Index target = row_of(found.columns[k]);
      if (target == no_index) continue;
      kept.columns.push_back(target);
      kept.areas.push_back(found.areas[k]);
      if (!found.moments.empty()) kept.moments.push_back(found.moments[k]);
    }
    kept.end_row();
  }
  std::vector<exact::DoubleDouble> sums(targets.size());
  for (const Index row : sources.data().subdivision().names) {
    for (std::uint64_t k = kept.offsets[row]; k < kept.offsets[row + std::size_t{1}]; ++k) {
      add_term(kept.areas[k], sums[kept.columns[k]]);
    }
  }
  PieceRows result = transposed(kept, targets.size());
  for (Index& column : result.columns) column = sources.names[column];
  for (const exact::DoubleDouble& sum : sums) result.row_sums.push_back(sum.hi + sum.lo);
  return result;
}

// Sources of a region are cut by targets that cover the sphere. As above, they are made together
// with all that may share a side with them, and the targets with all that these touch.
TiledRemap::TileMaker::TilePieces TiledRemap::TileMaker::pieces_in_cover(
    const BandRange& bands, const Execution& execution) const {
  TilePieces result;
  result.targets = target_index->cells_with_middles(bands);
  if (result.targets.empty()) return result;
  const BandRange own = reach_of(*target_index, result.targets);
  const BandRange touched = reach_of(*source_index, source_index->cells_touching(own), own);
  const TileCells sources =
      made(*source().formula, source_index->cells_touching(touched), execution);
  const BandRange all = reach_of(*source_index, sources.names, own);
  const TileCells cover = made(*target().formula, target_index->cells_touching(all), execution);
  PieceRows found = pieces(sources.data().subdivision(), sources.data().sizes(),
                           cover.data().subdivision(), is_second(), execution);
  for (Index& column : found.columns) column = cover.names[column];
  result.pieces = by_target(found, sources, result.targets);
  for (const Index target : result.targets) {
    const auto at = std::ranges::lower_bound(cover.names, target) - cover.names.begin();
    result.areas.push_back(cover.data().areas()[static_cast<std::size_t>(at)]);
    result.lengths.push_back(cover.data().lengths()[static_cast<std::size_t>(at)]);
  }
  return result;
}

TiledRemap::TileMaker::TilePieces TiledRemap::TileMaker::pieces_of_rows(
    unsigned first, unsigned end, const Execution& execution) const {
  const PreparedGrid& grid = *target().grid;
  const Index row_length = grid.num_columns_of_grid();
  TilePieces result;
  result.targets.resize(std::size_t{end - first} * row_length);
  std::iota(result.targets.begin(), result.targets.end(), first * row_length);
  if (boxes) {
    result.pieces = boxes->pieces(first * row_length, end * row_length, is_second());
    find_row_sums(result.pieces);
  } else {
    // The pieces of each source in the grid are in order.
    const TileCells sources =
        made(*source().formula, source_index->cells_touching(bands_of_rows(first, end)), execution);
    result.pieces = by_target(pieces(sources.data(), grid, is_second(), execution, false), sources,
                              result.targets);
  }
  for (const Index target : result.targets) {
    const PreparedGrid::CellSize size = grid.size_of(target);
    result.areas.push_back(size.area);
    result.lengths.push_back(size.length);
  }
  return result;
}

// Removes the pieces of cells that take no part, and computes the sums of what is left.
void TiledRemap::TileMaker::drop_masked(TilePieces& tile) const {
  if (options.source_mask.empty() && options.target_mask.empty()) return;
  PieceRows kept;
  for (std::size_t row = 0; row < tile.targets.size(); ++row) {
    const bool is_target_out = is_out(options.target_mask, tile.targets[row]);
    for (std::uint64_t k = tile.pieces.offsets[row]; k < tile.pieces.offsets[row + 1]; ++k) {
      if (is_target_out || is_out(options.source_mask, tile.pieces.columns[k])) continue;
      kept.columns.push_back(tile.pieces.columns[k]);
      kept.areas.push_back(tile.pieces.areas[k]);
      if (is_second()) kept.moments.push_back(tile.pieces.moments[k]);
    }
    kept.end_row();
  }
  find_row_sums(kept);
  tile.pieces = std::move(kept);
}

std::size_t TiledRemap::TileMaker::num_targets(std::size_t number) const {
  std::size_t count = 0;
  for (unsigned k = begins[number]; k < begins[number + 1]; ++k) {
    count += target_index ? target_index->num_middles(k) : target().grid->num_columns_of_grid();
  }
  return count;
}

// Returns the pieces of the targets from one band, or row, to before another one.
TiledRemap::TileMaker::TilePieces TiledRemap::TileMaker::pieces_of_tile(
    unsigned begin, unsigned end, const Execution& execution) const {
  const bool is_source_walked = source().grid || source().covers_sphere;
  TilePieces found = !target_index      ? pieces_of_rows(begin, end, execution)
                     : is_source_walked ? pieces_of_bands({begin, end - 1}, execution)
                                        : pieces_in_cover({begin, end - 1}, execution);
  drop_masked(found);
  // With order 2 sums are those of the rows as they are, as in remap().
  if (is_second()) find_row_sums(found.pieces);
  return found;
}

RemapTile TiledRemap::TileMaker::tile(std::size_t number, const Execution& execution) const {
  const unsigned begin = begins[number];
  const unsigned end = begins[number + 1];
  RemapTile result;
  if (is_second()) {
    complete_second(result, begin, end, execution);
    return result;
  }
  TilePieces found = pieces_of_tile(begin, end, execution);
  const PieceRows& pieces = found.pieces;
  Index least = no_index;
  Index most = 0;
  for (const Index column : pieces.columns) {
    least = std::min(least, column);
    most = std::max(most, column);
  }
  result.first_source = pieces.columns.empty() ? 0 : least;
  result.weights.num_columns = pieces.columns.empty() ? 0 : most - least + std::size_t{1};
  result.weights.columns.reserve(pieces.columns.size());
  result.weights.values.reserve(pieces.columns.size());
  for (std::size_t row = 0; row < found.targets.size(); ++row) {
    const double covered = pieces.row_sums[row];
    const double area = overlay::counted_area(covered, found.areas[row], found.lengths[row]);
    const double divisor = options.norm == RemapNorm::fracarea ? covered : area;
    for (std::uint64_t k = pieces.offsets[row]; k < pieces.offsets[row + 1]; ++k) {
      result.weights.columns.push_back(pieces.columns[k] - result.first_source);
      result.weights.values.push_back(pieces.areas[k] / divisor);
    }
    result.weights.end_row();
    result.areas.push_back(area);
    result.fractions.push_back(area > 0 ? covered / area : 0);
  }
  result.targets = std::move(found.targets);
  return result;
}

TiledRemap::TiledRemap(const TiledCells& source, const TiledCells& target,
                       TiledRemapOptions options, const Execution& execution) {
  const system::Call call(execution);
  maker_ = std::make_unique<TileMaker>(source, target, std::move(options), execution);
}
TiledRemap::~TiledRemap() = default;
TiledRemap::TiledRemap(TiledRemap&&) noexcept = default;
TiledRemap& TiledRemap::operator=(TiledRemap&&) noexcept = default;

std::size_t TiledRemap::num_sources() const { return maker_->source_cells.num_cells(); }
std::size_t TiledRemap::num_targets() const { return maker_->target_cells.num_cells(); }
std::size_t TiledRemap::num_tiles() const { return maker_->begins.size() - 1; }

std::size_t TiledRemap::num_targets(std::size_t number) const {
  return maker_->num_targets(number);
}

RemapTile TiledRemap::tile(std::size_t number, const Execution& execution) const {
  const system::Call call(execution);
  return maker_->tile(number, execution);
}

}  // namespace rondel
