// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Comparison of conservative weights, of any program, with the areas that cells of both sides have
/// in common (target rondel::geo).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/cell_set.h"
#include "rondel/export.h"
#include "rondel/remap.h"
#include "rondel/types.h"
#include "rondel/weight_check.h"
#include "rondel/weight_files.h"

namespace rondel {

/// What the areas of pieces are divided by in weights.
enum class WeightNorm : std::uint8_t {
  unknown,   ///< no row tells it
  either,    ///< destarea and fracarea are the same: sources cover each target that has weights
  destarea,  ///< the area of the target
  fracarea,  ///< the area of the target that sources cover
  area,      ///< nothing: weights are areas in steradians
};

/// Returns the name of a value: "unknown", "either", "destarea" ...; empty for other numbers.
RONDEL_API std::string_view name_of(WeightNorm norm) noexcept;

/// A weight beside the right one.
struct ComparedWeight {
  Index target = no_index;
  Index source = no_index;
  double given = 0;  ///< what the file has; 0 if it has no such weight
  double exact = 0;  ///< what it should be; 0 if the cells have no area in common
};

/// A target whose weights are wrong.
struct ComparedRow {
  Index target = no_index;
  LonLat place = {};      ///< of the target's cell, in degrees
  double error = 0;       ///< the sum of the differences' absolute values
  std::size_t wrong = 0;  ///< how many weights of the row are wrong
  double sum = 0;         ///< of the weights in the file
  double exact_sum = 0;   ///< what they should add up to
  ComparedWeight worst;   ///< the weight that is off most
};

/// How many differences there are in each decade.
struct ErrorDistribution {
  static constexpr std::size_t num_bins = 18;
  /// Bin 0 has differences below 1e-16, bin k those in [1e-16 * 10^(k-1), 1e-16 * 10^k), the last
  /// one all from 1 on.
  std::array<std::size_t, num_bins> counts = {};
  /// Returns the number below which the differences of a bin are; infinity for the last one.
  [[nodiscard]] RONDEL_API static double end_of(std::size_t bin);
};

struct WeightComparisonOptions {
  /// How far a weight may be from the right one, beside the rounding of areas.
  double tolerance = 1e-9;
  /// The treatment of cells of one side that overlap.
  CellOverlap overlap = CellOverlap::error;
  std::size_t max_rows = 10;  ///< how many of the worst rows are listed
};

struct WeightComparison {
  /// One for each kind that occurs; empty if the weights are right.
  std::vector<WeightFault> faults;
  WeightNorm norm = WeightNorm::unknown;  ///< that of most rows
  /// True for weights of second order, which depend on gradients: their sums are compared, and
  /// whether cells with a common area have one.
  bool are_sums = false;
  std::size_t pieces = 0;  ///< pairs of cells that have an area in common
  double max_error = 0;    ///< of the differences of all weights and pieces: the largest
  double mean_error = 0;   ///< the mean of their absolute values
  double rms_error = 0;    ///< the root of their mean square
  ErrorDistribution errors;
  double row_sums = 0;  ///< the largest difference of the sum of a row from the right one
  /// The largest difference of the area that a source gives away from that which the targets cover,
  /// relative to the source's area.
  double local_conservation = 0;
  /// The difference for all sources together, relative to the area that both sides have in common.
  double global_conservation = 0;
  /// The largest relative difference of areas in the file from those of the cells, if it has some.
  std::optional<double> source_areas;
  std::optional<double> target_areas;
  std::vector<ComparedRow> worst_rows;  ///< those with the largest errors first

  /// Returns how often a kind occurs.
  [[nodiscard]] RONDEL_API std::size_t count(std::string_view kind) const;
};

/// Compares weights with the exact areas of intersection, those of remap(). Both sides are the
/// cells for which the weights were made, in the same order.
///
/// | kind | what is wrong |
/// | --- | --- |
/// | `missing piece` | cells have an area in common, but no weight |
/// | `needless weight` | a weight is of cells that have no area in common, or do not take part |
/// | `wrong weight` | a weight is another number than the area says |
/// | `row sum`, `conservation` | of second order: the sum of a row, or the area that a source gives away, is another one |
/// | `normalization` | the file says another one than the weights have |
/// | `numbering` | weights are those of the targets or sources whose numbers differ by one |
/// | `target place`, `source place` | most places in the file are outside of the cells: their order is another one |
///
/// 1. The normalization is that of most rows whose targets are covered in part; where they are all
///    covered, sums tell areas from shares. Rows that have another one are wrong.
/// 2. A weight of a target of area A with m entries or pieces is wrong if it is off by more than the
///    tolerance + (m + 1) 8 pi 2^-52 / A, as in check_weights(). Repeated entries are added up.
/// 3. A cell takes part unless the mask of the file, or that of its facts(), is 0.
/// 4. Weights of second order, by the name of the method, are sums with gradients that are not
///    known; their sums are those of first order, and so are the cells that need a weight. Others
///    may have one.
///
/// \throws InvalidInput if the numbers of cells are not those of the weights; if the method of the
///         file is one between places (bilinear, nearest ...) or the largest share; if the tolerance
///         is negative or not a number; or as remap() does
RONDEL_API WeightComparison compare_weights(const WeightFile& file, const CellSet& source,
                                            const CellSet& target,
                                            const WeightComparisonOptions& options = {},
                                            const Execution& execution = {});

}  // namespace rondel
