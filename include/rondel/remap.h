// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Conservative remapping: computes the means of a field over one set of cells from its
/// means over those of another one (Jones, Mon. Weather Rev. 127, 1999, section 2).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/compressed_rows.h"
#include "rondel/export.h"
#include "rondel/io.h"
#include "rondel/types.h"
#include "rondel/weight_files.h"
#include "rondel/weights.h"

namespace rondel {

/// The area that the sum over a target cell is divided by.
enum class RemapNorm : std::uint8_t {
  /// The area of the target: the integral is conserved, and the part that no source covers counts
  /// as 0.
  destarea,
  fracarea,  ///< the area that sources cover: constants are conserved
};

/// Returns the name of a value: "destarea", "fracarea"; empty for other numbers.
RONDEL_API std::string_view name_of(RemapNorm norm) noexcept;

/// The treatment of places that belong to several cells of one side.
enum class CellOverlap : std::uint8_t {
  error,  ///< the cells are refused; the message has two of them and a place
  first,  ///< the cell with the lowest index has it, as if the others ended there
  /// It counts for each of the cells, divided by their number; on both sides if cells of both
  /// overlap.
  share,
  /// Each target has all of its places, as if it were alone: for means over nested regions. Sources
  /// that overlap are refused.
  each,
};

/// Returns the name of a value: "error", "first", "share", "each"; empty for other
/// numbers.
RONDEL_API std::string_view name_of(CellOverlap overlap) noexcept;

struct RemapOptions {
  /// The order of the method. 1: the field is constant in each source cell. 2: it is linear, with a
  /// gradient by least squares over the neighbors (cells that share an edge) that is 0 across the
  /// line of neighbors that are nearly on one. Both conserve the integral; order 2 keeps the cell's
  /// mean.
  unsigned order = 1;
  RemapNorm norm = RemapNorm::destarea;
  /// For each cell 0 if it takes no part, as if it were no cell of its side. If a mask is empty,
  /// that of the cells' facts() counts.
  std::vector<std::int32_t> source_mask = {};
  std::vector<std::int32_t> target_mask = {};
  /// The rule for cells that take part and overlap by more than rounding of their corners. A cell
  /// that overlaps itself is refused in any case. The areas and fractions of the result are those
  /// that the rule leaves to each cell.
  CellOverlap overlap = CellOverlap::error;
};

struct Remap {
  CellSet source;  ///< the cells, whose facts() have the mask that counts
  CellSet target;
  unsigned order = 1;  ///< as in the options
  RemapNorm norm = RemapNorm::destarea;
  /// Rows are targets, columns sources. A target that no source covers has an empty row, and gets
  /// NaN.
  Weights weights;
  /// The areas in steradians: those of the cells, or, where they differ by rounding alone, the
  /// sums of the pieces.
  std::vector<double> source_areas;
  std::vector<double> target_areas;      ///< the same for targets
  std::vector<double> source_fractions;  ///< the share of each source that targets cover
  std::vector<double> target_fractions;  ///< the share of each target that sources cover

  /// The source of each piece, a row for each target: the offsets and columns of `weights` of order
  /// 1. Piece k has its area in steradians, and in `moments` the integral of x - m over it, where m
  /// is the mean of x over the source.
  CompressedRows<Index> pieces;
  std::vector<double> areas;
  std::vector<Point> moments;  ///< empty for order 1
  /// The mean of x over each source, between which gradients are fitted; empty for order 1.
  std::vector<Point> source_centers = {};
};

/// Computes the overlay of two sets of cells and the weights that follow from it.
///
/// Exact signs of the corners as they are given decide which edges cross and which cells are inside
/// of others; only corners of cells that overlap, or cross themselves, by rounding alone are moved.
/// Points of intersection are rounded. With a grid of parallels nothing needs to be decided: the
/// sums are continuous functions of the corners. Equal cells, shared corners and shared edges are
/// no special cases: the weights of cells onto themselves are the identity. Pieces not larger
/// than what rounding of their corners can make are dropped. The weights depend on nothing but the
/// cells.
///
/// With order 1 and destarea, the sum of areas times weights of a column is that source's area, and
/// the sum of a row is 1, up to a few ulp, where the other side covers it. If neither
/// side covers_sphere() and neither is a grid of parallels, the one with fewer sides (the source if
/// both have as many) is completed by triangles, whose sides leave no trace in the pieces; if its
/// cells overlap each other, the other one is. That takes longer.
/// \throws InvalidInput if the order is neither 1 nor 2, a mask has another length than its side,
///         cells of a side overlap and the options have no rule for it (with the cells and a
///         place), or a cell crosses or overlaps itself. The message begins with the name that the
///         facts() of that side have, if any.
RONDEL_API Remap remap(const CellSet& source, const CellSet& target,
                       const RemapOptions& options = {}, const Execution& execution = {});

/// Returns the description of cells for a file of weights: the places, the mask, the shape of a
/// grid, the corners and the columns.
RONDEL_API WeightSide weight_side(const CellSet& cells);

/// Returns the areas of a side of a remapping as files of weights have them: that by definition, as the
/// pixels of HEALPix have one, where it differs from the given area by rounding alone.
/// \param areas  steradians, one for each cell
RONDEL_API std::vector<double> told_areas(const CellSet& cells, std::vector<double> areas);

/// Returns the content of the file that write_weights() writes. The pieces are dropped.
RONDEL_API WeightFile weight_file(Remap remap);

/// Writes the weights, and what is known of the cells of both sides, as write_weights() of
/// rondel/weight_files.h does. \throws what that function throws
RONDEL_API void write_weights(const FileName& file, const Remap& remap,
                              const NetcdfOptions& netcdf = {});

/// Returns the weights of order 2 for fields that lack values in some sources, as beyond coasts. A
/// source without a value is no neighbor in the gradients of others, as one that is masked, and has no
/// gradient itself: what apply() leaves out of a row is then its area alone, and no difference to it.
/// Where all sources have values, these are the weights of remap().
/// \param has_value  0 for each source without a value
/// \throws InvalidInput if `remap` is of order 1, or there are not as many numbers as sources
RONDEL_API Weights weights_with_values(const Remap& remap, std::span<const std::int32_t> has_value,
                                       const Execution& execution = {});

/// Multiplies fields by the weights, as apply() does, and limits the result of order 2: no value is
/// outside of the bounds of the sources that its target touches, and the integral stays that of the
/// weights (clip and assured sum: Bradley et al., SIAM J. Sci. Comput. 41, 2019). What clipping takes
/// away is given to all targets, in proportion to the room that their bounds leave. Where sources have no
/// value the integral is that over the others, for which remap.weights should be those of
/// weights_with_values().
/// \param in  shape (num_fields, sources); NaN is missing
/// \param out  shape (num_fields, targets)
/// \throws InvalidInput as apply() does
RONDEL_API void apply_limited(const Remap& remap, std::span<const double> in, std::span<double> out,
                              std::size_t num_fields = 1, const ApplyOptions& options = {},
                              const Execution& execution = {});

/// A limiter keeps values of order 2 within bounds.
enum class RemapLimiter : std::uint8_t {
  none,
  bounds,  ///< apply_limited(): the bounds of the sources of a target, by the values of all targets
  /// Monotone slopes (Barth and Jespersen, AIAA paper 89-0366, 1989): the gradient of each source is
  /// multiplied by the largest number in [0, 1] for which the field in the source is within the smallest
  /// and the largest value of this source and of those that share a corner with it. A value is then within
  /// those of the sources of its target and the sources around them. The mean of each source is kept, and
  /// so are integrals, of each source by itself; a linear field is not changed where the corners of cells
  /// are nearer than the centers around them. Sources without a value do not count.
  slopes,
};

/// Returns the name of a value: "none", "bounds", "slopes"; empty for other numbers.
RONDEL_API std::string_view name_of(RemapLimiter limiter) noexcept;

namespace overlay {
class SlopeLimiter;
}

/// Applies a remapping of order 2 to fields that may lack values in some sources: as apply() does where all
/// are there, and otherwise with the weights of weights_with_values(). A target has no value if more than
/// `max_missing` of what covers it lacks values, by area: weights of order 2 are no shares.
class SecondOrderRemap {
 public:
  /// \param covered  0 for each target that gets no value; empty: none of them
  /// \param limiter  with RemapLimiter::slopes the weights of `remap` are not needed: they are no weights
  ///                 of values, as slopes depend on the field
  /// \throws InvalidInput if `remap` is of order 1, or `covered` has another length
  RONDEL_API explicit SecondOrderRemap(Remap remap, std::vector<std::int32_t> covered = {},
                                       RemapLimiter limiter = RemapLimiter::none);

  /// Fields follow each other in both arrays. Weights are computed again where a field lacks values in
  /// other sources than the one before it, also that of the call before.
  /// \throws InvalidInput as rondel::apply() does
  RONDEL_API void apply(std::span<const double> in, std::span<double> out,
                        const ApplyOptions& rules = {}, const Execution& execution = {});

 private:
  [[nodiscard]] std::vector<std::int32_t> with_enough(std::span<const std::int32_t> has_value,
                                                      double max_missing) const;
  void use_weights(std::vector<std::int32_t> has_value, double max_missing,
                   const Execution& execution);
  void apply_fields(std::span<const double> in, std::span<double> out, const ApplyOptions& rules,
                    const Execution& execution) const;
  void apply_slopes(std::span<const double> field, std::span<double> out, const ApplyOptions& rules,
                    const Execution& execution) const;

  Remap remap_;    // its weights are those for has_value_
  Weights whole_;  // those for fields without gaps, while others are in use
  std::vector<std::int32_t> covered_;
  std::vector<std::int32_t> has_value_;
  double max_missing_ = 0;  // of those weights
  bool is_whole_ = true;    // whether all sources have values, instead
  RemapLimiter limiter_;
  std::shared_ptr<const overlay::SlopeLimiter> slopes_;  // that for has_value_
};

/// Computes the target means of order 2 with given gradients, for which linear fields are
/// reproduced up to rounding.
/// \param means  one for each source cell
/// \param gradients  one for each source cell: tangent vectors, in the field's unit per radian
/// \param out  gets one value for each target; NaN where no source is
/// \throws InvalidInput if sizes do not fit or `remap` is of order 1.
RONDEL_API void apply_gradients(const Remap& remap, std::span<const double> means,
                                std::span<const Point> gradients, std::span<double> out);

}  // namespace rondel
