// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Checks the input of a page, which may be any arrays: arrays of sizes that do not fit together
// would be read beyond their ends.
#pragma once

#include "rondel/globe.h"

namespace rondel::page {

// Throws InvalidInput unless the table has the sites of the triangulation and one cell for each
// site in every column, the diagram has the shape of the triangulation's diagram, the values are
// empty or one for each site, and the numbers among the options are finite.
void require_input(const SiteTable& table, const Triangulation& triangulation,
                   const Diagram& diagram, const GlobeOptions& options);

}  // namespace rondel::page
