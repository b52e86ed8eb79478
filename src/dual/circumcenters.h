// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "dual/split_sites.h"

namespace rondel::dual {

std::vector<Point> circumcenters(const Triangulation& triangulation, const SplitSites& sites);

}  // namespace rondel::dual
