// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The triangles on which contours are drawn: those of a triangulation, or others that share sides.
//
// in    triangles, counterclockwise
// out   isolines and bands
// index triangles and sites as given
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "rondel/contours.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::interpolation {

struct ContourSurface {
  std::span<const Triple> faces;
  // The triangle across the side opposite to each corner, or no_index at a border.
  std::span<const Triple> neighbors;
  std::vector<Index> left_out = {};  // faces that do not count, ascending
  std::span<const Point> sites;
  Point center{};
  // The site of a vertex -> the site that represents all sites of its place.
  std::unordered_map<Index, Index> representatives = {};
};

// Returns the solid faces of a triangulation, which must outlive the result, but for those that are flat
// by rounding (flat_faces.h): isolines would run along the border in them, to sites far away. Throws
// InvalidInput for weighted sites.
ContourSurface surface_of(const Triangulation& triangulation);

// Each throws InvalidInput for values and levels as isolines() of rondel/contours.h does. `values` are
// those that count, one for each site.
Isolines isolines_on(const ContourSurface& surface, std::span<const double> values,
                     std::span<const double> levels, const Execution& execution);
Bands bands_on(const ContourSurface& surface, std::span<const double> values,
               std::span<const double> levels, const Execution& execution);

}  // namespace rondel::interpolation
