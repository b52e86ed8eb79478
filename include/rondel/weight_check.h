// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Faults of a file of weights (target rondel::remap).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rondel/export.h"
#include "rondel/weight_files.h"

namespace rondel {

/// A kind of fault, how often it occurs, and where first.
struct WeightFault {
  std::string kind;       ///< "repeated", "row sum" ...: one of those of check_weights()
  std::size_t count = 0;  ///< entries, rows, or cells
  std::string what;       ///< one line: the count, the fault, and the first place with its value
};

struct WeightReport {
  std::vector<WeightFault> faults;  ///< one of a kind; empty: nothing is wrong
  std::size_t empty_rows = 0;
  double least = 0;     ///< weight
  double greatest = 0;  ///< weight
  double worst_row =
      0;  ///< the largest difference of a row's (column's) sum from what it should be
  std::optional<double> worst_column;  ///< the largest relative difference of an area given away
  std::optional<double>
      worst_direction;  ///< the largest |u x sum of w x|, u a target, x its sources
  bool sums_are_fractions =
      false;  ///< rows should have the fractions of the targets as sums, not 1
  bool sums_are_of_columns = false;  ///< columns should have 1 as sums, not rows

  /// Returns how often a kind occurs.
  [[nodiscard]] RONDEL_API std::size_t count(const std::string& kind) const;
};

struct WeightCheckOptions {
  /// Negative weights are right, whatever the method is.
  bool allow_negative = false;
};

/// Checks weights, of this library or of another program.
///
/// | kind | what is wrong |
/// | --- | --- |
/// | `not finite` | a weight is infinite or not a number |
/// | `repeated` | a row has two entries of one column |
/// | `row sum` | the entries of a row do not add up to 1 or, normalized by destarea, to the fraction of the target; |
/// |           | of a conservative method whose fractions are not known, to more than 1 |
/// | `column sum` | in place of `row sum`, where the method gives each source to its nearest target (nearest_d2s, nearest |
/// |            | destination to source): the entries of a column do not add up to 1 |
/// | `negative` | a weight is negative, though the method is an average: conservative of first order, |
/// |            | nearest, linear, laplace, sibson, or the largest share |
/// | `target fraction`, `source fraction` | a fraction is negative, above 1 or not a number |
/// | `target area`, `source area` | an area is negative or not finite, or no cell of one side has an area, though a conservative method gives it entries and the other side has areas |
/// | `missing row` | a conservative method gives no entry to a target whose fraction is not 0 |
/// | `conservation` | what a conservative method takes of a source, weights times areas of targets, is |
/// |                | not the area of the source times its fraction |
///
/// The names in the file tell the methods (WeightFile::method). Second order, bilinear, patch, hermite and
/// cubic weights may be negative, and so may those of a method that is not known.
///
/// Tolerance: an area by Girard's theorem, the coarsest formula in use, is a difference of angles of some pi
/// and so off by 8 pi 2^-52 steradians at most. A cell of area A whose row or column has m entries is a sum of
/// m such areas: fractions and sums may be off by 1e-9 + (m + 1) 8 pi 2^-52 / A, and by 1e-9 where no areas
/// are known. 1e-9 is for programs that find weights by iteration.
RONDEL_API WeightReport check_weights(const WeightFile& file,
                                      const WeightCheckOptions& options = {});

}  // namespace rondel
