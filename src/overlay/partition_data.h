// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "overlay/graticule.h"
#include "overlay/pieces.h"
#include "overlay/subdivision.h"
#include "rondel/partition.h"
#include "rondel/regions.h"
#include "rondel/types.h"

namespace rondel::overlay {

class PartitionData {
 public:
  // `whole` are the cells that are the whole sphere, increasing.
  // Whoever made the cells may know that they are apart.
  PartitionData(Subdivision subdivision, std::vector<Index> whole, unsigned threads,
                bool are_apart = false);
  explicit PartitionData(Graticule grid);

  [[nodiscard]] static const PartitionData& of(const Partition& partition) {
    return *partition.data_;
  }

  // Null unless the cells are between meridians and parallels.
  [[nodiscard]] const Graticule* grid() const { return grid_ ? &*grid_ : nullptr; }
  // Without a cell if there is a grid.
  [[nodiscard]] const Subdivision& subdivision() const { return subdivision_; }
  // The first cell that is the whole sphere; no_index: none is.
  [[nodiscard]] Index whole() const { return all_whole_.empty() ? no_index : all_whole_.front(); }
  [[nodiscard]] const std::vector<Index>& all_whole() const { return all_whole_; }
  [[nodiscard]] bool is_cover() const { return is_cover_; }
  // The pairs of cells that overlap, by name. The first call looks for them, but not in diagrams, grids and covers.
  [[nodiscard]] const std::vector<CrossingCells>& overlaps(const Execution& execution) const;
  // By name.
  [[nodiscard]] const std::vector<double>& areas() const { return areas_; }
  [[nodiscard]] const std::vector<Point>& moments() const { return moments_; }
  // Roughly, of their borders; no less than they are.
  [[nodiscard]] const std::vector<double>& lengths() const { return lengths_; }
  [[nodiscard]] CellSizes sizes() const { return {areas_, lengths_}; }

 private:
  Subdivision subdivision_;
  std::optional<Graticule> grid_;
  std::vector<Index> all_whole_;
  bool is_cover_ = false;
  bool are_apart_ = false;
  mutable std::once_flag are_overlaps_known_;
  mutable std::vector<CrossingCells> overlaps_;
  std::vector<double> areas_;
  std::vector<Point> moments_;
  std::vector<double> lengths_;
};

// The cells, by index.
CellRings rings_of(const PartitionData& data);
CellRings rings_of(const Subdivision& cells);

// Throws InvalidInput if the cells are those of a grid.
void require_arcs(const PartitionData& cells);

}  // namespace rondel::overlay
