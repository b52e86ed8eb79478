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

#include <vector>

#include "dual/face_batch.h"
#include "dual/split_sites.h"
#include "rondel/diagram.h"
#include "rondel/export.h"
#include "system/huge_pages.h"

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

// The area of the cell of a vertex whose ring is complete.
class RingLocalizer;
double careful_area(RingLocalizer& localize, Index rank);

}  // namespace rondel::dual
