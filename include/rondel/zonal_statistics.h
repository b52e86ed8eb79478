// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Statistics of the values in zones: the cells that each polygon, or any other target, has in part
/// or as a whole (target rondel::geo).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/remap.h"
#include "rondel/types.h"

namespace rondel {

/// A number that says something of the values in a zone. v are the values of the cells that have
/// one, w their weights (ZonalWeights), f the share of each cell that is in the zone. The names are
/// those of exactextract.
///
/// Cells that have less than a thousandth in common with a zone, both of the cell and of the zone, do
/// not count in min, max, median, quantile, majority, minority and variety, unless there are no
/// others: so no side that runs along a row of cells adds the next row.
enum class ZonalOperation : std::uint8_t {
  mean,      ///< sum of w v / sum of w
  sum,       ///< sum of f v
  count,     ///< sum of f: how many cells, parts of cells being parts
  min,       ///< the least v, whatever its weight
  max,       ///< the greatest v, whatever its weight
  fraction,  ///< the share of the zone's area in which cells have a value
  variance,  ///< sum of w (v - mean)^2 / sum of w
  stdev,     ///< the square root of the variance
  median,    ///< the quantile of 0.5
  /// The weighted quantile: with v ascending, n of them, and s_k = k w_k + (n - 1) (w_0 + ... +
  /// w_(k-1)), the place of q s_(n-1) among the s_k, linear between two of them. With equal weights
  /// it is the quantile of NumPy, SciPy and R (type 7). (exactextract has the same formula, but joins
  /// cells of equal values before.)
  quantile,
  majority,  ///< the value of the greatest weight; of several the least
  minority,  ///< the value of the least weight; of several the least
  variety,   ///< how many different values there are
};

/// Returns the name of a value: "mean", "stdev" ...; empty for other numbers.
RONDEL_API std::string_view name_of(ZonalOperation operation) noexcept;

/// The weight of a cell in a zone.
enum class ZonalWeights : std::uint8_t {
  area,      ///< the area that the cell and the zone have in common
  fraction,  ///< the share of the cell that is in the zone, whatever its area: that of exactextract
};

/// Returns the name of a value: "area", "fraction"; empty for other numbers.
RONDEL_API std::string_view name_of(ZonalWeights weights) noexcept;

struct ZonalStatistic {
  ZonalOperation operation = ZonalOperation::mean;
  double quantile = 0.5;  ///< from 0 to 1, of ZonalOperation::quantile

  /// Returns the name for a column: "mean", "quantile_0.1".
  [[nodiscard]] RONDEL_API std::string name() const;
};

/// Returns the statistics of a list such as "mean,max,quantile:0.1"; "std" and "mode" are other
/// words for stdev and majority.
/// \throws InvalidInput for a word that is no statistic, or stands twice
RONDEL_API std::vector<ZonalStatistic> zonal_statistics_of(std::string_view list);

struct ZonalOptions {
  ZonalWeights weights = ZonalWeights::area;
  /// The share of a zone that no cell may cover, and the share of what cells cover in which values
  /// may be missing (may_be_missing()). With 0 any lack is too much, with 1 any value is enough.
  double max_missing = 1;
};

/// Computes statistics of the values in each target of a remapping, whose pieces say how much of
/// which source it has. A target that lacks too much, or has no value at all, gets NaN; but for
/// count, fraction and variety, which always are the numbers of what is there. The bytes are the
/// same for any number of threads.
/// \param remap  the pieces, with areas; weights are not needed
/// \param in  shape (num_fields, sources); NaN is missing
/// \param out  shape (statistics, num_fields, targets)
/// \throws InvalidInput if a length is not as described, a quantile or `max_missing` is not in
///         [0, 1], or the remapping has no pieces (weight_file() has dropped them)
RONDEL_API void zonal_statistics(const Remap& remap, std::span<const ZonalStatistic> statistics,
                                 std::span<const double> in, std::span<double> out,
                                 std::size_t num_fields = 1, const ZonalOptions& options = {},
                                 const Execution& execution = {});

}  // namespace rondel
