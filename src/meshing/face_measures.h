// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The circumcenter, arcs and kite areas of each face, on the unit sphere. In the notation of
// dual/split_sites.h, for the face (a, b, c) with the circumcenter n and the edge of length |D|
// from b to c, whose midpoint is m:
//
//     cosine  = n.a = n.b = n.c
//     k       = |b + c| / 2 = sqrt(1 - |D|^2 / 4)
//     p       = |D| (B.C) / (2 |N|)        the distance of the edge from the face's center, in its plane
//     tan(arc from m to n)                        = p / cosine
//     tan(half the area of the triangle b, m, n)  = |D|/2 p / ((1 + k) (k + cosine))
//
// p, the arc and the area are negative where n lies beyond the edge.
//
// in    projected sites with their faces
// out   measures of each face; lengths in radians, areas in steradians
// index faces; corner i of a face and the edge opposite to it
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "dual/split_sites.h"

namespace rondel::meshing {

// The measures of one face. Arcs may be negative: the circumcenter may lie beyond an edge.
struct FaceMeasures {
  Point circumcenter;
  std::array<double, 3>
      arcs;  // by corner: from the midpoint of the opposite edge to the circumcenter
  std::array<double, 3> kites;  // by corner: the area of the triangles at its two edges
};

// Sets measures[k] to those of face begin + k. Precondition: projected sites, and no face is a
// ghost.
void measure_faces(const dual::SplitSites& sites, std::size_t begin,
                   std::span<FaceMeasures> measures);

// Returns the angle between two sites, in radians.
double distance_of(const dual::SplitSites& sites, Index a, Index b);
// Returns the angle between unit vectors whose distance is `length`.
double angle_of_chord(double length);

// The midpoint of two sites and the direction of the edge's normal there, which points from the
// first site to the second: the angle from east, counterclockwise, in radians. East and north are
// those of the longitude that a file has for the midpoint, which is 0 at the poles.
struct EdgePlace {
  Point middle;
  double normal_angle;
};
EdgePlace edge_place(const dual::Vec& a, const dual::Vec& b);

}  // namespace rondel::meshing
