// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Weights of methods beside those of Interpolator: as ESMF and xESMF have them, bilinear on a grid of
/// meridians and parallels, and sources that are given to their nearest targets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/export.h"
#include "rondel/interpolate.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// The methods of regridding of this header, and native_weights() of rondel/native_weights.h.
enum class RegridMethod : std::uint8_t { bilinear, nearest_d2s, native };

/// Returns the name of a method in the tool, in files of weights and in Python, which is that of
/// ESMF and xESMF where they have it: "bilinear", "nearest_d2s", "native"; empty for other numbers.
RONDEL_API std::string_view name_of(RegridMethod method) noexcept;

/// Returns the axes of places that are a grid of this shape, or nothing if the places of a row
/// differ in latitude or those of a column in longitude, or if the shape is not nlat, nlon.
/// \param places  degrees, row by row
RONDEL_API std::optional<LonLatAxes> axes_of_grid(std::span<const LonLat> places,
                                                  std::span<const std::uint64_t> shape);

/// How far coordinates of double precision are from what they mean after shifts by whole turns, in
/// degrees, and how far those of single precision are.
inline constexpr double double_rounding_deg = 1e-9;
inline constexpr double single_rounding_deg = 1e-4;

/// Returns how far the coordinates of axes may be from what they mean: as numbers of single precision
/// if all of them are such, and not all are multiples of 1/1024 degree.
RONDEL_API double rounding_of(const LonLatAxes& axes);

/// Computes bilinear weights: linear in longitude and in latitude in each rectangle between four
/// places of the grid.
///
/// 1. A row has at most four entries, but for rule 4; weights are positive, and their sum is 1 up to
///    2^-52 for each entry. At a place of the grid there is one entry, on a line between two places there are two.
/// 2. Longitudes count modulo 360 degrees. A grid goes around the globe if the gap behind its last
///    column is at most 1.5 of its widest steps; then there are rectangles between the last and the
///    first column. Columns that repeat the first ones a turn later take no part.
/// 3. A target outside of the grid has an empty row.
/// 4. If the grid goes around the globe, a target between its last row and the pole has weights that
///    are linear in latitude between the value in that row and the mean of the row, which is at the
///    pole.
/// 5. Axes that decrease give the weights of the same places in increasing order, and the same order
///    of entries within a row: by latitude, then by longitude, from the axis's least one.
/// 6. A target that is no farther than `rounding_deg` from a row or column is at it, also beyond the
///    last one.
///
/// The hashes of the result are those of the unit vectors of places and targets. The work is
/// proportional to the number of targets and of entries.
///
/// \param targets  degrees
/// \param rounding_deg  how far coordinates may be off by rounding; more than a thousandth of the
///                      shortest step counts as such a thousandth
/// \throws InvalidInput for an axis with less than two numbers, one that is not finite, or one that
///         neither increases nor decreases throughout (longitudes modulo 360 degrees), with the first
///         bad position; for a latitude outside of [-90, 90] or a target that is not finite, as
///         unit_vectors() does; and if there are 2^31 places or more.
RONDEL_API Weights bilinear_weights(const LonLatAxes& grid, std::span<const LonLat> targets,
                                    double rounding_deg = double_rounding_deg);

/// Returns the places of a grid that are also in a column a turn before or behind, with the lowest index
/// in that place, in ascending order: those that take no part by rule 2, or stand for others. Empty
/// for axes that are not finite.
RONDEL_API std::vector<Duplicate> repeated_places(const LonLatAxes& grid);

/// Gives each source to its nearest target, which has the sum of what it receives: ESMF's "nearest
/// destination to source". A row is a target, a column is a source; each source has one entry, of
/// weight 1, in the row of the target that Method::nearest finds for it. Within a row, sources are
/// in the order of their indices. Rows of targets to which no source is given are empty, and so are
/// those of all but one of several targets in one place.
/// \param targets  the Interpolator of the targets' triangulation
/// \throws InvalidInput (first bad index) if a source is not finite or is the center of the sphere
RONDEL_API Weights nearest_d2s_weights(const Interpolator& targets, std::span<const Point> sources,
                                       const Execution& execution = {});

}  // namespace rondel
