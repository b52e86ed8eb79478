// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Conservative remapping: the means of a field over the cells of one partition from its means over those of
/// another one (Jones, Mon. Weather Rev. 127, 1999, section 2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/export.h"
#include "rondel/partition.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// What the sums over a target cell are divided by.
enum class RemapNorm : std::uint8_t {
  destarea,  ///< its area: the integral is kept, and where sources are lacking a part of it counts as 0
  fracarea,  ///< the area that sources cover: constants are kept
};

/// The treatment of places that belong to several cells of one partition.
enum class CellOverlap : std::uint8_t {
  error,  ///< it is refused, with two of the cells and the place
  first,  ///< the cell with the lowest index has it, as if the others ended there
  share,  ///< it counts for each of them, divided by their number, on both sides if cells of both overlap
};

struct RemapOptions {
  /// 1: the field is constant in each source cell. 2: it is linear, with a gradient by least squares over
  /// the neighbors (cells that share an edge), 0 across the line of neighbors that are nearly on one, and the cell's
  /// mean kept; the integral is kept by both.
  unsigned order = 1;
  RemapNorm norm = RemapNorm::destarea;
  /// 0 by cell: it takes no part, as if it were no cell of its partition. Empty: all take part.
  std::vector<std::int32_t> source_mask = {};
  std::vector<std::int32_t> target_mask = {};
  /// The rule for cells that take part and overlap by more than rounding of their corners. No rule mends a cell that overlaps
  /// itself. The areas and fractions of the result are what the rule leaves to each cell.
  CellOverlap overlap = CellOverlap::error;
};

struct Remap {
  /// Rows are targets, columns sources. Targets that no source covers have empty rows, so NaN.
  Weights weights;
  /// Steradians: those of the partition, or, where they differ by rounding alone, the sums of the pieces.
  std::vector<double> source_areas;
  std::vector<double> target_areas;      ///< the same
  std::vector<double> source_fractions;  ///< which share of each source the targets cover
  std::vector<double> target_fractions;  ///< which share of each target the sources cover

  /// The pieces: of entry k of `offsets` and `columns` (as those of `weights` of order 1), its area and
  /// the integral of x - m over it, where m is the mean of x over the source.
  std::vector<std::uint64_t> offsets;
  std::vector<Index> columns;
  std::vector<double> areas;
  std::vector<Point> moments;  ///< empty for order 1
};

/// The overlay of both and the weights that follow from it.
///
/// Exact signs of the corners as they are decide which edges cross and where cells are inside of cells, but for corners of
/// cells that overlap, or cross themselves, by rounding alone. Points of intersection are rounded. With a grid of parallels nothing needs
/// to be decided: what is summed is continuous in the corners. Equal cells, shared corners and shared edges are like others: the
/// weights of a partition onto itself are the identity. Pieces not larger than rounding of
/// their corners may make them are left out. The weights depend on nothing but the cells.
///
/// With order 1 and destarea, the sum of areas times weights of a column is that source's area, and
/// the sum of a row 1, to a few ulp, where the other partition covers it.
/// If neither partition is_cover() and none is a grid of parallels, the one with fewer sides, or else the source, is
/// filled up with triangles, whose sides leave no trace in the pieces; if its cells overlap each
/// other, the other one is. That takes longer.
/// \throws InvalidInput if the order is neither 1 nor 2, a mask has another length than its partition, cells of a
///         partition overlap and the options do not say what then (the cells and a place), or a cell crosses or overlaps
///         itself.
RONDEL_API Remap remap(const Partition& source, const Partition& target,
                       const RemapOptions& options = {}, const Execution& execution = {});

/// The target means of order 2 with gradients of your own, by source cell, for which linear
/// fields come back to rounding. `out` has a value for each target; NaN where no source is.
/// \throws InvalidInput if sizes do not fit or `remap` is of order 1.
RONDEL_API void apply_gradients(const Remap& remap, std::span<const double> means,
                                std::span<const Point> gradients, std::span<double> out);

}  // namespace rondel
