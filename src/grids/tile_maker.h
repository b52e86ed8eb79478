// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes the weights of tiles: what TiledRemap consists of.
//
// in    two sides, of which the cells of a tile are made at a time
// out   rows of weights
// index bands of latitude, or rows of targets between parallels; cells as in their grids
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "grids/grid_formula.h"
#include "grids/latitude_index.h"
#include "overlay/cell_set_data.h"
#include "overlay/grid_pieces.h"
#include "overlay/pieces.h"
#include "overlay/prepared_grid.h"
#include "rondel/tiled_remap.h"
#include "rondel/types.h"

namespace rondel {

namespace grids {

// The cells of a tile as a set, with their numbers in the grid.
struct TileCells {
  std::vector<Index> names;
  CellSet cells;

  [[nodiscard]] const overlay::CellSetData& data() const { return overlay::CellSetData::of(cells); }
};

TileCells made(const GridFormula& formula, std::vector<Index> names, const Execution& execution);

// Returns the bands that some cells are in, together with others.
BandRange reach_of(const LatitudeIndex& index, std::span<const Index> cells,
                   const BandRange& others = {num_bands - 1, 0});

// Returns the bands of the rows of a grid from one line to another one.
BandRange bands_between(const std::vector<double>& latitudes, unsigned first, unsigned end);

}  // namespace grids

struct TiledCells::CellsOfTiles {
  std::optional<overlay::PreparedGrid> grid;  // cells between parallels
  LonLatGrid lines;                           // those of the grid, as given
  std::shared_ptr<const grids::GridFormula> formula;
  bool covers_sphere = true;  // what a walk through the cells needs

  [[nodiscard]] std::size_t num_cells() const {
    return grid ? grid->num_cells() : formula->num_cells();
  }
};

struct TiledRemap::TileMaker {
  TileMaker(TiledCells source_side, TiledCells target_side, TiledRemapOptions given,
            const Execution& execution);

  [[nodiscard]] RemapTile tile(std::size_t number, const Execution& execution) const;
  [[nodiscard]] std::size_t num_targets(std::size_t number) const;

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
  [[nodiscard]] grids::BandRange bands_of_rows(unsigned first, unsigned end) const {
    return grids::bands_between(target().lines.lat_deg, first, end);
  }

  // The pieces of the targets of a tile; the columns are sources of the whole side.
  struct TilePieces {
    std::vector<Index> targets;
    std::vector<double> areas;    // of the targets
    std::vector<double> lengths;  // of their borders
    overlay::PieceRows pieces;
  };
  [[nodiscard]] TilePieces pieces_of_rows(unsigned first, unsigned end,
                                          const Execution& execution) const;
  [[nodiscard]] TilePieces pieces_of_bands(const grids::BandRange& bands,
                                           const Execution& execution) const;
  [[nodiscard]] overlay::PieceRows pieces_in_cells(const overlay::CellSetData& targets,
                                                   const grids::BandRange& bands,
                                                   const Execution& execution) const;
  [[nodiscard]] TilePieces pieces_in_cover(const grids::BandRange& bands,
                                           const Execution& execution) const;
  [[nodiscard]] static overlay::PieceRows by_target(const overlay::PieceRows& found,
                                                    const grids::TileCells& sources,
                                                    std::span<const Index> targets);
  void drop_masked(TilePieces& tile) const;

  [[nodiscard]] bool is_second() const { return options.order == 2; }
  [[nodiscard]] TilePieces pieces_of_tile(unsigned begin, unsigned end,
                                          const Execution& execution) const;

  // Some sources as a set, with neighbors of those that are asked for, and their numbers.
  struct SourcePart {
    std::vector<Index> names;
    CellSet cells;
  };
  [[nodiscard]] SourcePart sources_in(const grids::BandRange& bands,
                                      const Execution& execution) const;
  [[nodiscard]] grids::BandRange reach_of_targets(unsigned begin, unsigned end) const;
  [[nodiscard]] grids::BandRange reach_of_sources(const grids::BandRange& bands) const;
  [[nodiscard]] std::pair<unsigned, unsigned> targets_touching(const grids::BandRange& bands) const;
  std::vector<double> take_own_rows(RemapTile& tile, const TilePieces& all, const Remap& whole,
                                    unsigned begin, unsigned end) const;
  void complete_second(RemapTile& tile, unsigned begin, unsigned end,
                       const Execution& execution) const;
};

}  // namespace rondel
