// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a caller brings may be any arrays; a page of those that do not fit together would be read beyond their ends.
#pragma once

#include "rondel/globe.h"

namespace rondel::page {

// Throws InvalidInput unless the table has the sites of the triangulation and a cell for each of them in every
// column, the diagram has the shape of the triangulation's, values are none or one of each site, and the numbers
// among the options are finite.
void require_input(const SiteTable& table, const Triangulation& triangulation,
                   const Diagram& diagram, const GlobeOptions& options);

}  // namespace rondel::page
