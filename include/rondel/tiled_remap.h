// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Conservative remapping between grids that are larger than memory: weights of one part of the
/// targets after another (target rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/export.h"
#include "rondel/named_grids.h"
#include "rondel/remap.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// One side of a TiledRemap: cells of which only those of a tile are made at a time. Copies share
/// the memory.
class RONDEL_API TiledCells {
 public:
  explicit TiledCells(const NamedGrid& grid);
  /// Takes cells between meridians and parallels.
  /// \throws InvalidInput as CellSet::lonlat_grid() does
  explicit TiledCells(const LonLatGrid& lines);
  /// Takes cells that are in memory; they may be those of a region.
  /// \throws InvalidInput if cells overlap, or one is the whole sphere
  explicit TiledCells(const CellSet& cells);

  [[nodiscard]] std::size_t num_cells() const;
  /// True if the cells are between meridians and parallels: a tile needs consecutive ones.
  [[nodiscard]] bool has_parallels() const;

 private:
  friend class TiledRemap;
  struct CellsOfTiles;
  std::shared_ptr<const CellsOfTiles> content_;
};

struct TiledRemapOptions {
  RemapNorm norm = RemapNorm::destarea;
  /// For each cell 0 if it takes no part; empty: all do.
  std::vector<std::int32_t> source_mask = {};
  std::vector<std::int32_t> target_mask = {};
  /// About how many cells, of both sides together, a tile has. The weights do not depend on it.
  std::size_t cells_per_tile = std::size_t{1} << 18U;
  /// 1, or 2 for sources that are not in memory: named grids, and cells between parallels.
  unsigned order = 1;
};

/// The weights of some targets.
struct RemapTile {
  std::vector<Index> targets;  ///< the target of each row, in ascending order
  /// The columns are sources, beginning with `first_source`: column c is source first_source + c.
  Weights weights;
  Index first_source = 0;
  std::vector<double> areas;      ///< of the targets, in steradians, as those of remap()
  std::vector<double> fractions;  ///< the share of each target that sources cover
  /// With order 2 the remapping of these targets, for weights_with_values(). `sources` has the number
  /// of each of its sources, in ascending order; neighbors, which gradients need, are among them.
  Remap part = {};
  std::vector<Index> sources = {};
};

/// Conservative weights, tile by tile. A tile has the targets whose centers are between two
/// parallels; only the cells of both sides that touch this band are made, and with order 2 those that
/// touch these.
///
/// Each row has the same bytes as the row that remap() computes for the whole sides.
class RONDEL_API TiledRemap {
 public:
  /// Sorts the cells of both sides by latitude; this needs 8 bytes for each cell that is not
  /// between parallels. \throws InvalidInput if a mask has another length than its side, if the
  /// order is not 1 or 2, or 2 and the sources are in memory, or if neither side covers the sphere
  /// (CellSet::covers_sphere()) or is between parallels
  TiledRemap(const TiledCells& source, const TiledCells& target, TiledRemapOptions options = {},
             const Execution& execution = {});
  ~TiledRemap();
  TiledRemap(TiledRemap&&) noexcept;
  TiledRemap& operator=(TiledRemap&&) noexcept;

  [[nodiscard]] std::size_t num_sources() const;
  [[nodiscard]] std::size_t num_targets() const;
  /// Returns the number of tiles; each target is in one of them.
  [[nodiscard]] std::size_t num_tiles() const;
  /// Returns the number of targets of a tile, without computing it.
  [[nodiscard]] std::size_t num_targets(std::size_t number) const;
  /// Computes the weights of a tile. Several threads may do so at once.
  [[nodiscard]] RemapTile tile(std::size_t number, const Execution& execution = {}) const;

 private:
  struct TileMaker;
  std::unique_ptr<TileMaker> maker_;
};

}  // namespace rondel
