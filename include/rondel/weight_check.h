// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Checks of files of weights (target rondel::geo).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/weight_files.h"

namespace rondel {

/// A kind of fault, the number of its occurrences, and the first of them.
struct WeightFault {
  std::string kind;       ///< "repeated", "row sum" ...: one of those of check_weights()
  std::size_t count = 0;  ///< entries, rows, or cells
  std::string what;       ///< one line: the count, the fault, and the first place with its value
};

struct WeightReport {
  /// One for each kind that occurs; empty if the weights are right.
  std::vector<WeightFault> faults;
  std::size_t empty_rows = 0;
  double least = 0;     ///< the least weight
  double greatest = 0;  ///< the greatest weight
  double worst_row =
      0;  ///< the largest difference of the sum of a row (or column) from what it should be
  /// The largest relative difference of the area that a source gives.
  std::optional<double> worst_column;
  /// The largest |u x sum of w x|, for the unit vectors u of a target and x of its sources.
  std::optional<double> worst_direction;
  bool sums_are_fractions =
      false;  ///< true if the rows should add up to the fractions of the targets instead of 1
  /// True if the fractions of the targets are not known, so that a sum may be anything up to 1.
  bool sums_are_at_most_1 = false;
  std::optional<double> min_row;     ///< the least sum of a row with entries
  bool sums_are_of_columns = false;  ///< true if the columns should add up to 1 instead of the rows

  /// Returns how often a kind occurs.
  [[nodiscard]] RONDEL_API std::size_t count(const std::string& kind) const;
};

/// Options of check_weights().
struct WeightCheckOptions {
  /// Whether negative weights are right for any method.
  bool allow_negative = false;
  /// Whether the weights are conservative although the file names no method.
  bool is_conservative = false;
  /// Whether targets that overlap have all of their places (CellOverlap::each), so that a source may
  /// give its area several times.
  bool targets_overlap = false;
};

/// Checks weights of this library or of another program, by what the file says of the cells.
/// compare_weights() (rondel/weight_comparison.h) holds them against the cells themselves.
///
/// | kind | what is wrong |
/// | --- | --- |
/// | `numbering` | the numbers of sources or targets count from 0 in a format that counts from 1 |
/// | `not finite` | a weight is infinite or not a number |
/// | `repeated` | a row has two entries of one column |
/// | `row sum` | the entries of a row do not add up to 1 or, normalized by destarea, to the fraction of the target; |
/// |           | for a conservative method whose fractions are not known, they add up to more than 1 |
/// | `column sum` | instead of `row sum`, for a method that gives each source to its nearest target (nearest_d2s, nearest |
/// |            | destination to source): the entries of a column do not add up to 1 |
/// | `negative` | a weight is negative, though the method is an average: conservative of first order, |
/// |            | nearest, linear, laplace, sibson, or the largest share |
/// | `target fraction`, `source fraction` | a fraction is negative, above 1 or not a number |
/// | `target area`, `source area` | an area is negative or not finite, or no cell of one side has an area, though a conservative method gives it entries and the other side has areas |
/// | `masked target`, `masked source` | a target or source that the mask of the file masks (0) has a weight other than 0 |
/// | `missing row` | a conservative method gives no entry to a target whose fraction is not 0 |
/// | `conservation` | the area that a conservative method takes from a source, weights times areas of targets, is |
/// |                | not the area of the source times its fraction |
///
/// The names in the file tell the methods (WeightFile::method). Second order, bilinear, patch,
/// hermite and cubic weights may be negative, and so may those of an unknown method.
///
/// Tolerance: an area by Girard's theorem, the least accurate formula in use, is a difference of
/// angles of some pi and so off by at most 8 pi 2^-52 steradians. A cell of area A whose row or
/// column has m entries is a sum of m such areas: fractions and sums may be off by 1e-9 + (m + 1) 8
/// pi 2^-52 / A, and by 1e-9 if no areas are known. 1e-9 allows for programs that find weights by
/// iteration.
RONDEL_API WeightReport check_weights(const WeightFile& file,
                                      const WeightCheckOptions& options = {});

}  // namespace rondel
