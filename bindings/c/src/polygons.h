// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The content of the handles of polygons.
#pragma once

#include <string>
#include <vector>

#include "rondel.h"
#include "rondel/cell_rings.h"
#include "rondel/polygon_files.h"

// NOLINTBEGIN(readability-identifier-naming): C's names
struct rondel_features {
  rondel::LonLatMultiPolygons features;
};

struct rondel_texts {
  std::vector<std::string> texts;
};

struct rondel_polygons {
  rondel::CellRings rings;
  std::vector<rondel::Point> points;  // one for each corner, as C reads them

  explicit rondel_polygons(rondel::CellRings made);
};
// NOLINTEND(readability-identifier-naming)
