// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Proves the promises of convex_hull with GMP in linear time, and makes clouds of points for hulls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/triangulation.h"

namespace rondel::test {

// What is wrong first with convex_hull(points), or nothing. Beyond the properties of any
// triangulation (surface_check.h): every vertex is a strict corner of the hull, every hidden site
// has the first face whose cone contains it, the center is inside or the smallest site, a flat hull
// is the strictly convex polygon around all sites.
std::string hull_error(const Triangulation& hull, std::span<const Point> points);

struct Cloud {
  std::string_view name;
  std::vector<Point> (*make)(std::size_t n, std::uint64_t seed);  // about n points
};

// Bodies: ball, cube, gaussian, cube_surface_grid, torus, cone, lattice, half in a ball and half on
// its sphere, a thin plate, far from the origin.
std::span<const Cloud> solid_clouds();
// In one plane or on one line, exactly.
std::span<const Cloud> flat_clouds();

}  // namespace rondel::test
