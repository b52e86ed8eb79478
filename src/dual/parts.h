// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What rondel/diagram.h offers, from places computed before: the costliest part is shared.
#pragma once

#include <vector>

#include "dual/split_sites.h"
#include "rondel/diagram.h"

namespace rondel::dual {

std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites);
Cells cells(const Triangulation& triangulation, const SplitSites& sites);
std::vector<double> areas(const Triangulation& triangulation, const SplitSites& sites,
                          const Cells& cells);

}  // namespace rondel::dual
