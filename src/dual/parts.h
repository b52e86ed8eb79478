// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What rondel/diagram.h offers, from places computed before: the costliest part is shared. Each part
// has a fast way and a careful one; which case goes which way:
//
//                | in nearly all cases                    | and otherwise
// ---------------+----------------------------------------+---------------------------------------
//  places        | unit vectors to 2^-100 (projected),    |
//                | coordinates scaled (weighted):         |
//                | split_sites.cpp                        |
//  circumcenters | normals in double-double, 64 faces at  | a normal that is not proved:
//                | a time: face_batch.cpp                 | exact_normal.cpp
//  cells         | a turn through the faces around each   | arcs of 120 degrees and more get points
//                | vertex: cells.cpp                      | in the middle: arc_points.cpp
//  areas         | projected: sums of the kites that      | weighted; a careful kite (NaN); a sum
//                | face_batch.cpp finds beside the        | that is not positive: from the local
//                | circumcenters, in cells.cpp            | ring (local_ring.cpp), in areas.cpp
//  centroids     | from the local ring: centroids.cpp     | thin cells: the middle of their points
//  local rings   | projected: around the site; weighted:  | weighted cells that are large, and
//                | from step to step along small cells    | points that are not proved: from the
//                |                                        | circumcenters as they are
//  dimension < 2 | great_circle_diagrams.cpp, all of it   | edges below 2^-45: exact_normal.cpp
//  facets        | normals that are more than 8u apart    | side_of_circle() decides, in
//                | differ                                 | merge_cocircular.cpp
#pragma once

#include <span>
#include <vector>

#include "dual/face_batch.h"
#include "dual/split_sites.h"
#include "rondel/diagram.h"
#include "rondel/export.h"
#include "system/large_arrays.h"

namespace rondel::dual {

// The kites of all faces, in the projected model.
struct FaceKites {
  system::LargeArray<Kites> of;
  bool has_careful = false;
};
// The circumcenters of all faces; `kites`, unless it is null, receives those of all faces.
std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                 FaceKites* kites = nullptr);

// The areas of the cells of the sites 0 ... num_whole-1 of a surface with a border, across which a face
// is its own neighbor. All faces of these sites are there; without one the area is 0.
RONDEL_API std::vector<double> areas_within(const Triangulation& surface, std::size_t num_whole);

// The circumcenters of some faces: nothing is asked of their neighbors.
RONDEL_API std::vector<Point> circumcenters_within(const Triangulation& surface);

// `areas`, unless it is null, receives those of all cells.
Cells cells(const Triangulation& triangulation, const SplitSites& sites,
            std::vector<double>* areas);

// The directions of the cells' centers of mass.
std::vector<Point> centroids(const Triangulation& triangulation, const SplitSites& sites);

// The area of the cell of a vertex whose ring is complete.
class RingLocalizer;
double careful_area(RingLocalizer& localize, Index rank);

// The point on the arc between the circumcenters of two faces, for both halfedges of
// the edge between them.
struct ArcPoint {
  Index halfedge;
  Index point;  // position in Cells::points
};

// Appends the middle of every arc that is too long to `points`, which hold
// the circumcenters, and returns the list sorted by halfedge. Flat two-sided
// hulls have antipodal circumcenters all along their rim.
std::vector<ArcPoint> add_arc_points(const Triangulation& triangulation, const SplitSites& sites,
                                     std::vector<Point>& points);

// Diagrams of sites on one great circle (dimension 1) and of fewer than two vertices.
//
// The vertices v_0 ... v_{k-1} form a convex polygon, counterclockwise about the axis N of
// the circle's plane. The cell of v is a lune from -N to N, its two sides lie in the planes
// perpendicular to the polygon's edges at v. In the middle of a side is the outward normal e x N of
// the edge e. Two vertices share the sphere in hemispheres. Precondition of all three functions:
// triangulation.dimension() < 2.
Cells great_circle_cells(const Triangulation& triangulation, const SplitSites& sites);
std::vector<double> great_circle_areas(const Triangulation& triangulation, const SplitSites& sites);
std::vector<Point> great_circle_centroids(const Triangulation& triangulation,
                                          const SplitSites& sites);

}  // namespace rondel::dual
