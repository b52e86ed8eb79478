// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The weights of a regridding, tile by tile: conservative ones, and those between places.
//
// in    two sides
// out   rows of weights of some targets at a time; each row has the same bytes for any tiles
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/regrid_plan.h"
#include "formats/regrid_side.h"
#include "rondel/delaunay.h"
#include "rondel/interpolate.h"
#include "rondel/native_weights.h"
#include "rondel/regrid_files.h"
#include "rondel/tiled_remap.h"

namespace rondel::formats {

class RegridTiles {
 public:
  RegridTiles() = default;
  RegridTiles(const RegridTiles&) = delete;
  RegridTiles& operator=(const RegridTiles&) = delete;
  virtual ~RegridTiles() = default;

  [[nodiscard]] virtual std::size_t num_tiles() const = 0;
  [[nodiscard]] virtual std::size_t num_targets(std::size_t tile) const = 0;
  // Computes the weights of a tile. Several threads may call it.
  [[nodiscard]] virtual RemapTile tile(std::size_t number, const Execution& execution) const = 0;
};

// Conservative weights of order 1.
class ConservativeTiles : public RegridTiles {
 public:
  ConservativeTiles(const TiledCells& source, const TiledCells& target, TiledRemapOptions options,
                    const Execution& execution)
      : remap_(source, target, std::move(options), execution) {}

  [[nodiscard]] std::size_t num_tiles() const override { return remap_.num_tiles(); }
  [[nodiscard]] std::size_t num_targets(std::size_t tile) const override {
    return remap_.num_targets(tile);
  }
  [[nodiscard]] RemapTile tile(std::size_t number, const Execution& execution) const override {
    return remap_.tile(number, execution);
  }

 private:
  TiledRemap remap_;
};

// Weights of a method between places: those of consecutive targets at a time.
class PlaceTiles : public RegridTiles {
 public:
  // Both sides must outlive this; `mesh` has the cells of the method native. Throws FileError for
  // bilinear without axes, and native without such cells.
  PlaceTiles(const RegridSide& source, const RegridSide& target, FieldMethod method,
             const FileName& mesh, std::size_t targets_per_tile, const Execution& execution);

  // Throws FileError if the source of the method bilinear has no axes.
  static void require_axes(const RegridSide& source);
  // Returns the bytes that the weights of a method take, which were measured and rounded up.
  [[nodiscard]] static RegridCost cost_of(FieldMethod method);

  [[nodiscard]] std::size_t num_tiles() const override;
  [[nodiscard]] std::size_t num_targets(std::size_t tile) const override;
  [[nodiscard]] RemapTile tile(std::size_t number, const Execution& execution) const override;
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
  // Returns the sources that share the place of another one, which counts in their stead, in
  // ascending order.
  [[nodiscard]] const std::vector<Duplicate>& coincident() const { return coincident_; }

 private:
  void triangulate(const Execution& execution);
  // True if nobody wonders that a grid has two points in one place.
  [[nodiscard]] bool is_usual(const LonLat& a, const LonLat& b) const;
  [[nodiscard]] Weights weights_at(std::span<const LonLat> places,
                                   const Execution& execution) const;

  const RegridSide& source_;
  const RegridSide& target_;
  FieldMethod method_;
  std::size_t targets_per_tile_;
  std::vector<LonLat> targets_;
  std::vector<Index> numbers_;  // the source of each site of the triangulation
  std::optional<Interpolator> interpolator_;
  NativeCells native_;
  std::vector<Duplicate> coincident_;
  std::vector<std::string> remarks_;
};

// Gives each source without a value the first value at its place, field by field: a missing value
// never hides one that is there. `values` are those of whole fields at all sources.
void take_values_that_are_there(std::span<const Duplicate> coincident, std::size_t sources,
                                std::span<double> values);

}  // namespace rondel::formats
