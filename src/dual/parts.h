// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What rondel/diagram.h offers, from places computed before: the costliest part is shared.
#pragma once

#include <span>
#include <vector>

#include "dual/face_normal.h"
#include "dual/split_sites.h"
#include "rondel/diagram.h"

namespace rondel::dual {

std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites);
// `measures` receives one entry a face.
std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                 std::vector<FaceMeasure>& measures);
Cells cells(const Triangulation& triangulation, const SplitSites& sites,
            std::vector<FaceMeasure>& measures);
// `measures` as cells() gave them, or empty.
std::vector<double> areas(const Triangulation& triangulation, const SplitSites& sites,
                          const Cells& cells, std::span<const FaceMeasure> measures);

}  // namespace rondel::dual
