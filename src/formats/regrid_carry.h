// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Carries the fields of one array of a file to the targets, with weights in tiles.
//
// in    fields at sources, tiles of weights
// out   values at targets, field by field
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "formats/regrid_output.h"
#include "formats/regrid_plan.h"
#include "formats/regrid_processes.h"
#include "formats/regrid_tiles.h"
#include "formats/regrid_vectors.h"
#include "formats/side_areas.h"
#include "rondel/fields.h"

namespace rondel::formats {

// The array, and what is done with it.
struct ArrayToCarry {
  const RegridVectors& file;  // the fields, vectors by their components in space
  std::size_t array;
  std::size_t num_fields;
  std::size_t sources;
  std::size_t targets;
  bool has_windows;  // whether a tile needs consecutive sources
  bool is_largest_share;
  double max_missing;
  bool keeps_sums;  // ApplyOptions::keeps_sums
  // The areas of the sources if the values are sums over cells, or null; and what weights are divided by.
  const SideAreas* areas_of_sources = nullptr;
  RemapNorm norm = RemapNorm::fracarea;
  // What is done with whole fields before they are written, if anything. It gets their values at all
  // sources, so tiles must not have windows.
  using Complete = std::function<void(std::span<const double> values, std::span<double> carried)>;
  Complete complete = {};
  std::span<const Duplicate> coincident = {};  // PlaceTiles::coincident(), without windows
};

// Calls compute(unit) for units of work of this process, and take(unit, message) for all of them in
// turn on rank 0.
void deal_units(const RegridRanks& ranks, std::size_t first, std::size_t end,
                const std::function<RegridRanks::Message(std::size_t)>& compute,
                const std::function<void(std::size_t, std::span<const std::byte>)>& take);

// The weights of each tile are applied to all fields of a group; of a streamed plan a group is one
// field, and tiles are written one by one. The tiles are divided among the processes.
class TileCarrier {
 public:
  TileCarrier(const RegridTiles& tiles, const RegridPlan& plan, const ArrayToCarry& job,
              RegridOutput& out, const RegridRanks& ranks, const Execution& execution);

  void run();

 private:
  class SourceValues;

  void carry_group(std::size_t first, std::size_t count);
  // Returns the values of the fields of a group at the targets of a tile, field by field.
  [[nodiscard]] std::vector<double> values_at(RemapTile& tile, SourceValues& values,
                                              std::size_t count) const;
  // Does the same; of sums over cells these are densities.
  [[nodiscard]] std::vector<double> applied(RemapTile& tile, SourceValues& values,
                                            std::size_t count) const;
  // Does the same with weights of order 2, whose part of a remapping is taken from the tile.
  [[nodiscard]] std::vector<double> applied_second(RemapTile& tile, SourceValues& values,
                                                   std::size_t num_rows,
                                                   const ApplyOptions& rules) const;
  // Computes tiles and calls visit(number, tile) for them in turn.
  void for_tiles(std::size_t begin, std::size_t end,
                 const std::function<void(std::size_t, RemapTile&)>& visit) const;

  const RegridTiles& tiles_;
  RegridPlan plan_;
  const ArrayToCarry& job_;
  RegridOutput& out_;
  const RegridRanks& ranks_;
  const Execution& execution_;
};

}  // namespace rondel::formats
