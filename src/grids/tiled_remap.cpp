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
using overlay::CellSetData;
using overlay::PieceRows;
using overlay::PreparedGrid;

// The cells of a set, as those of a grid that is computed.
class StoredCells : public grids::GridFormula {
 public:
  explicit StoredCells(CellSet cells) : cells_(std::move(cells)), rings_(cells_.given_rings()) {}

  [[nodiscard]] Index num_cells() const override { return static_cast<Index>(cells_.num_cells()); }
  [[nodiscard]] LonLat center(Index cell) const override {
    Point sum{};
    for (const Index corner : rings_.corners_of(rings_.cells[cell])) {
      sum = sum + rings_.points[corner];
    }
    return lonlats(std::vector<Point>{sum})[0];
  }
  void append_ring(Index cell, std::vector<Point>& ring) const override {
    for (const Index corner : rings_.corners_of(rings_.cells[cell])) {
      ring.push_back(rings_.points[corner]);
    }
  }

 private:
  CellSet cells_;
  CellRings rings_;
};

// The cells of a tile as a set, with their numbers in the grid.
struct TileCells {
  std::vector<Index> names;
  CellSet cells;

  [[nodiscard]] const CellSetData& data() const { return CellSetData::of(cells); }
};

TileCells made(const grids::GridFormula& formula, std::vector<Index> names,
               const Execution& execution) {
  CellSet cells = grids::cells_of(formula, names, execution);
  return {std::move(names), std::move(cells)};
}

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

struct TiledCells::CellsOfTiles {
  std::optional<PreparedGrid> grid;  // cells between parallels
  std::vector<double> latitudes;     // the lines of the grid, as given
  std::shared_ptr<const grids::GridFormula> formula;

  [[nodiscard]] std::size_t num_cells() const {
    return grid ? grid->num_cells() : formula->num_cells();
  }
};

TiledCells::TiledCells(const NamedGrid& grid) {
  if (grid.lines_ && grid.sides_ == GridSides::parallels) {
    *this = TiledCells(*grid.lines_);
  } else if (grid.formula_) {
    content_ = std::make_shared<const CellsOfTiles>(CellsOfTiles{std::nullopt, {}, grid.formula_});
  } else {
    *this = TiledCells(grid.cells());
  }
}

TiledCells::TiledCells(const LonLatGrid& lines)
    : content_(std::make_shared<const CellsOfTiles>(
          CellsOfTiles{PreparedGrid(lines), lines.lat_deg, nullptr})) {}

TiledCells::TiledCells(const CellSet& cells) {
  if (cells.has_parallels()) {
    *this = TiledCells(*cells.lines());
    return;
  }
  const CellSetData& data = CellSetData::of(cells);
  if (!data.covers_sphere() || data.whole() != no_index) {
    throw InvalidInput("the cells do not cover the sphere");
  }
  content_ = std::make_shared<const CellsOfTiles>(
      CellsOfTiles{std::nullopt, {}, std::make_shared<const StoredCells>(cells)});
}

std::size_t TiledCells::num_cells() const { return content_->num_cells(); }
bool TiledCells::has_parallels() const { return content_->grid.has_value(); }

struct TiledRemap::TileMaker {
  TileMaker(TiledCells source_side, TiledCells target_side, TiledRemapOptions given,
            const Execution& execution);

  [[nodiscard]] RemapTile tile(std::size_t number, const Execution& execution) const;

  TiledCells source_cells;
  TiledCells target_cells;
  TiledRemapOptions options;
  // For a side that is not between parallels.
  std::optional<grids::LatitudeIndex> source_index;
  std::optional<grids::LatitudeIndex> target_index;
  // The boxes that two grids between parallels share.
  std::optional<overlay::GridOverlay> boxes;
  // The first band of each tile, or its first row for targets between parallels; and the end.
  std::vector<unsigned> begins = {0};

 private:
  [[nodiscard]] const TiledCells::CellsOfTiles& source() const { return *source_cells.content_; }
  [[nodiscard]] const TiledCells::CellsOfTiles& target() const { return *target_cells.content_; }

  [[nodiscard]] std::vector<double> sources_by_band() const;
  void divide_bands();
  void divide_rows();
  [[nodiscard]] BandRange bands_of_rows(unsigned first, unsigned end) const;

  // The pieces of the targets of a tile; the columns are sources of the whole side.
  struct TilePieces {
    std::vector<Index> targets;
    std::vector<double> areas;    // of the targets
    std::vector<double> lengths;  // of their borders
    PieceRows pieces;
  };
  [[nodiscard]] TilePieces pieces_of_rows(unsigned first, unsigned end,
                                          const Execution& execution) const;
  [[nodiscard]] TilePieces pieces_of_bands(const BandRange& bands,
                                           const Execution& execution) const;
  [[nodiscard]] PieceRows pieces_in_cells(const CellSetData& targets, const BandRange& bands,
                                          const Execution& execution) const;
  [[nodiscard]] PieceRows pieces_by_source(unsigned first, unsigned end,
                                           const Execution& execution) const;
  void drop_masked(TilePieces& tile) const;
};

TiledRemap::TileMaker::TileMaker(TiledCells source_side, TiledCells target_side,
                                 TiledRemapOptions given, const Execution& execution)
    : source_cells(std::move(source_side)),
      target_cells(std::move(target_side)),
      options(std::move(given)) {
  require_mask(options.source_mask, source().num_cells(), "source");
  require_mask(options.target_mask, target().num_cells(), "target");
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

BandRange TiledRemap::TileMaker::bands_of_rows(unsigned first, unsigned end) const {
  const auto band = [&](unsigned line) {
    return grids::band_of(exact::sine_cosine_of_degrees(target().latitudes[line]).sine);
  };
  const auto [low, high] = std::minmax({band(first), band(end)});
  return {low == 0 ? 0 : low - 1, std::min(high + 1, grids::num_bands - 1)};
}

void TiledRemap::TileMaker::divide_rows() {
  std::vector<double> below = sources_by_band();
  system::sum_counts(below);
  const PreparedGrid& grid = *target().grid;
  double count = 0;
  for (unsigned row = 0; row < grid.num_rows_of_grid(); ++row) {
    const BandRange bands = bands_of_rows(row, row + 1);
    const double share = std::abs(exact::sine_cosine_of_degrees(target().latitudes[row + 1]).sine -
                                  exact::sine_cosine_of_degrees(target().latitudes[row]).sine) *
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
  if (source().grid) return pieces(targets, *source().grid, false, execution, false);
  const TileCells sources = made(*source().formula, source_index->cells_touching(bands), execution);
  PieceRows result = pieces(targets.subdivision(), targets.sizes(), sources.data().subdivision(),
                            false, execution);
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
  const auto reach = [&](std::span<const Index> cells) {
    BandRange all{grids::num_bands - 1, 0};
    for (const Index cell : cells) {
      const BandRange own = target_index->bands_of(cell);
      all = {std::min(all.first, own.first), std::max(all.last, own.last)};
    }
    return all;
  };
  const TileCells near =
      made(*target().formula, target_index->cells_touching(reach(result.targets)), execution);
  const PieceRows all = pieces_in_cells(near.data(), reach(near.names), execution);
  std::size_t next = 0;
  for (std::size_t k = 0; k < near.names.size() && next < result.targets.size(); ++k) {
    if (near.names[k] != result.targets[next]) continue;
    ++next;
    const auto begin = static_cast<std::ptrdiff_t>(all.offsets[k]);
    const auto end = static_cast<std::ptrdiff_t>(all.offsets[k + 1]);
    PieceRows& rows = result.pieces;
    rows.columns.insert(rows.columns.end(), all.columns.begin() + begin, all.columns.begin() + end);
    rows.areas.insert(rows.areas.end(), all.areas.begin() + begin, all.areas.begin() + end);
    rows.row_sums.push_back(all.row_sums[k]);
    rows.end_row();
    result.areas.push_back(near.data().areas()[k]);
    result.lengths.push_back(near.data().lengths()[k]);
  }
  return result;
}

// Returns the pieces of targets between parallels, which are found from the sources: those of each
// source are in order. Sums are computed in the spatial order of the sources, as remap() does.
PieceRows TiledRemap::TileMaker::pieces_by_source(unsigned first, unsigned end,
                                                  const Execution& execution) const {
  const PreparedGrid& grid = *target().grid;
  const TileCells sources =
      made(*source().formula, source_index->cells_touching(bands_of_rows(first, end)), execution);
  PieceRows found = pieces(sources.data(), grid, false, execution, false);
  const Index first_target = first * grid.num_columns_of_grid();
  const Index num_targets = (end - first) * grid.num_columns_of_grid();
  // Other targets that the sources touch are dropped.
  PieceRows kept;
  for (std::size_t row = 0; row + 1 < found.offsets.size(); ++row) {
    for (std::uint64_t k = found.offsets[row]; k < found.offsets[row + 1]; ++k) {
      const Index target = found.columns[k] - first_target;
      if (target >= num_targets) continue;
      kept.columns.push_back(target);
      kept.areas.push_back(found.areas[k]);
    }
    kept.end_row();
  }
  std::vector<exact::DoubleDouble> sums(num_targets);
  for (const Index row : sources.data().subdivision().names) {
    for (std::uint64_t k = kept.offsets[row]; k < kept.offsets[row + std::size_t{1}]; ++k) {
      add_term(kept.areas[k], sums[kept.columns[k]]);
    }
  }
  PieceRows result = transposed(kept, num_targets);
  for (Index& column : result.columns) column = sources.names[column];
  for (const exact::DoubleDouble& sum : sums) result.row_sums.push_back(sum.hi + sum.lo);
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
    result.pieces = boxes->pieces(first * row_length, end * row_length, false);
    find_row_sums(result.pieces);
  } else {
    result.pieces = pieces_by_source(first, end, execution);
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
    }
    kept.end_row();
  }
  find_row_sums(kept);
  tile.pieces = std::move(kept);
}

RemapTile TiledRemap::TileMaker::tile(std::size_t number, const Execution& execution) const {
  const unsigned begin = begins[number];
  const unsigned end = begins[number + 1];
  TilePieces found = target_index ? pieces_of_bands({begin, end - 1}, execution)
                                  : pieces_of_rows(begin, end, execution);
  drop_masked(found);
  RemapTile result;
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

RemapTile TiledRemap::tile(std::size_t number, const Execution& execution) const {
  const system::Call call(execution);
  return maker_->tile(number, execution);
}

}  // namespace rondel
