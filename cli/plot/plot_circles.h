// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The circles that weighted sites represent.
///
/// in    sites with radii in degrees, or points outside of the sphere, which stand for circles
/// out   circles
#pragma once

#include <span>
#include <vector>

#include "rondel/io.h"
#include "rondel/triangulation.h"

namespace rondel::cli {

/// A circle on the globe.
struct Circle {
  Point axis;  ///< the unit vector of its center
  double radius_deg = 0;
  bool is_hidden = false;  ///< it has no cell
};

/// Returns the circles of all sites except duplicates, sites with radius 0 and sites with an
/// imaginary radius. `directions` are the sites' unit vectors, zero for a site at the center. The
/// radii are those of the table if it has some; otherwise cos r = R / |p|, where |p| is the
/// distance of the site from the center.
std::vector<Circle> real_circles(const SiteTable& table, const Triangulation& triangulation,
                                 std::span<const Point> directions);

}  // namespace rondel::cli
