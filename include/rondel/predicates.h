// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The exact predicates on which the triangulation rests, for single calls.
/// All are exact for every finite input, also from 1e-300 to 1e300.
/// \throws InvalidInput (position of the argument) if a point or the center of the sphere is not
///         finite, or a point of Model::projected is the center.
#pragma once

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// The sign of det(a-o, b-o, c-o), o the center of the sphere: positive when
/// a, b, c are in counterclockwise order seen from outside.
RONDEL_API Sign orientation(const Point& a, const Point& b, const Point& c,
                            const Sphere& sphere = {});

/// Where p lies with respect to the circle through a, b, c, which is oriented
/// by their order (the power test in the weighted model; the paper, section 4).
/// 1. Positive when p is strictly on the outer side of the plane through a, b,
///    c: in conflict with the face (a, b, c). Under Model::projected all four
///    are first projected exactly on the sphere.
/// 2. Zero exactly when the four are coplanar.
/// 3. Odd under exchange of any two arguments.
RONDEL_API Sign side_of_circle(const Point& a, const Point& b, const Point& c, const Point& p,
                               Model model = Model::projected, const Sphere& sphere = {});

/// The same, with ties broken as the triangulation breaks them: never undecided.
/// The four points are distinct sites (distinct rays under Model::projected). When they also lie in
/// one plane with the center, (a, b, c) is taken to be a face of the hull: not in line with the
/// center, counterclockwise seen from outside.
/// \throws InvalidInput also for a tie of points that are not so.
RONDEL_API bool is_in_conflict(const Point& a, const Point& b, const Point& c, const Point& p,
                               Model model = Model::projected, const Sphere& sphere = {});

/// Whether two sites are duplicates: on one ray from the center
/// (Model::projected) or equal (Model::weighted).
RONDEL_API bool is_same_site(const Point& a, const Point& b, Model model = Model::projected,
                             const Sphere& sphere = {});

}  // namespace rondel
