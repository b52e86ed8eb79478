// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a mesh has of each face, on the unit sphere. In the notation of dual/split_sites.h, for the face (a, b, c)
// with the circumcenter n and the edge of length |D| from b to c, whose middle is m:
//
//     cosine  = n.a = n.b = n.c
//     k       = |b + c| / 2 = sqrt(1 - |D|^2 / 4)
//     p       = |D| (B.C) / (2 |N|)        the distance of the edge from the face's center, in its plane
//     tan(arc from m to n)                        = p / cosine
//     tan(half the area of the triangle b, m, n)  = |D|/2 p / ((1 + k) (k + cosine))
//
// Both are negative where n lies beyond the edge.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "dual/split_sites.h"

namespace rondel::meshing {

struct FaceMeasures {
  Point circumcenter;
  std::array<double, 3>
      arcs;  // from the middle of the edge opposite to each corner to the circumcenter
  std::array<double, 3> kites;  // of each corner: the triangles at its two edges
};

// measures[k] = those of the face begin + k. Precondition: projected sites, no face is a ghost.
void measure_faces(const dual::SplitSites& sites, std::size_t begin,
                   std::span<FaceMeasures> measures);

// The angle between two sites.
double distance_of(const dual::SplitSites& sites, Index a, Index b);
// The angle between unit vectors that are this far apart.
double angle_of_chord(double length);

// The middle of two cells' sites, and the angle of the edge's normal there, from the first site to the second: from east
// counterclockwise. East and north are those of the longitude that the middle has as a file says it: 0 at the poles.
struct EdgePlace {
  Point middle;
  double normal_angle;
};
EdgePlace edge_place(const dual::Vec& a, const dual::Vec& b);

}  // namespace rondel::meshing
