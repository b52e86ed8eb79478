// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Refuses tables with rows that have no place, where each row counts.
//
// in    a table of sites
// out   an error that says how many rows lack a place
#pragma once

#include <string>

#include "rondel/error.h"
#include "rondel/io.h"

namespace rondel::formats {

// Throws FileError if rows of the table were left out because they have no place.
inline void require_places_of_rows(const SiteTable& table) {
  if (table.num_unlocated == 0) return;
  throw FileError(table.name + ": " + std::to_string(table.num_unlocated) +
                  (table.num_unlocated > 1 ? " rows have" : " row has") + " no place");
}

}  // namespace rondel::formats
