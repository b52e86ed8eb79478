// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What rondel/diagram.h offers, from places computed before: the costliest part is shared.
#pragma once

#include <vector>

#include "dual/face_batch.h"
#include "dual/split_sites.h"
#include "rondel/diagram.h"
#include "system/huge_pages.h"

namespace rondel::dual {

std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites);

// The kites of all faces, in the projected model.
struct FaceKites {
  system::LargeArray<Kites> of;
  bool has_careful = false;
};
// Their circumcenters, too.
std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                 FaceKites& kites);

// `areas`, unless it is null, receives those of all cells.
Cells cells(const Triangulation& triangulation, const SplitSites& sites,
            std::vector<double>* areas);

// The area of the cell of a vertex whose ring is complete.
class RingLocalizer;
double careful_area(RingLocalizer& localize, Index rank);

}  // namespace rondel::dual
