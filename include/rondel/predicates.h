// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// The exact predicates on which the triangulation rests, for single calls.
/// All of them are exact for every finite input, also from 1e-300 to 1e300.
/// \throws InvalidInput (position of the argument) if a point or the center of the sphere is not
///         finite, or a point of Model::projected is the center; if the squared radius is not
///         positive and finite, although no answer depends on it.
#pragma once

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel {

/// Returns the sign of det(a-o, b-o, c-o), where o is the center of the sphere: positive if a, b, c
/// are in counterclockwise order seen from outside.
RONDEL_API Sign orientation(const Point& a, const Point& b, const Point& c,
                            const Sphere& sphere = {});

/// Returns on which side of the circle through a, b, c, oriented by their order, the point p lies
/// (the power test in the weighted model; the paper, section 4).
/// 1. The sign is positive if p is strictly on the outer side of the plane through a, b,
///    c: in conflict with the face (a, b, c). Under Model::projected all four points
///    are first projected exactly on the sphere.
/// 2. It is zero exactly if the four points are coplanar.
/// 3. It is odd under exchange of any two arguments.
RONDEL_API Sign side_of_circle(const Point& a, const Point& b, const Point& c, const Point& p,
                               Model model = Model::projected, const Sphere& sphere = {});

/// True if p is in conflict with the face (a, b, c), with ties broken as the triangulation breaks
/// them. The four points are distinct sites (distinct rays under Model::projected). When they also
/// lie in one plane with the center, (a, b, c) is taken to be a face of the hull: not in line with
/// the center, counterclockwise seen from outside.
/// \throws InvalidInput also for a tie of points that are not as described.
RONDEL_API bool is_in_conflict(const Point& a, const Point& b, const Point& c, const Point& p,
                               Model model = Model::projected, const Sphere& sphere = {});

/// True if two sites are duplicates: on one ray from the center (Model::projected) or equal
/// (Model::weighted).
RONDEL_API bool is_same_site(const Point& a, const Point& b, Model model = Model::projected,
                             const Sphere& sphere = {});

}  // namespace rondel
