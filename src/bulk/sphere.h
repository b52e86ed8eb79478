// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A triangulation of the whole sphere by divide and conquer, of sites that surround the center.
//
// in    the sites in spatial order
// out   the arrays of the result
// index ranks; inside, local sites by parts of the sphere
//
// Great circles divide the sphere into halves, lunes and the faces of the cube or parts of them:
//
//      +---------+         The planes x = y and x = -y make four lunes. Each consists of one of the
//      | \     / |         four faces around the cube and of triangles of its top and its bottom,
//      |   \ /   |         beyond the planes z = x and z = -x (for the lune of x > |y|).
//      |   / \   |         Two neighboring lunes are a half. A ray on a plane belongs to one side,
//      | /     \ |         so that no two rays of a half are opposite: the hulls of disjoint parts
//      +---------+         of a half are disjoint, as in the plane. The halves are then closed
//        x > |y|           (closing.h).
#pragma once

#include <optional>

#include "bulk/input.h"
#include "kernel/triangulate.h"

namespace rondel::bulk {

// The octants around the center, one bit each, in which there are sites.
inline constexpr unsigned all_octants = 255;
unsigned octants_of(std::span<const Point> sites, const Point& center);

// Whether the center is inside the hull of the sites, told by the octants in which they are: all.
bool surround_center(std::span<const Point> sites, const Point& center);

// Computes what kernel::triangulate does, or returns nothing if it cannot: it can for sites in
// general, but not if weighted sites are hidden in such a way that only exact numbers tell.
// Precondition: the sites surround the center.
std::optional<kernel::Triangulated> triangulate_sphere(const Input& input,
                                                       std::span<const order::Renamed> renamed);

}  // namespace rondel::bulk
