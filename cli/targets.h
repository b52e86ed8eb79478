// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Where values are wanted: the points of a file, or the centers of a grid of longitudes and latitudes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "command.h"

namespace rondel::cli {

/// The targets that an option names, and the shape of arrays of their values.
struct Targets {
  SiteTable table;
  std::vector<std::uint64_t> shape;  ///< (targets), of a grid (latitudes, longitudes)
};

/// What is wrong with "grid:DEG" or "grid:NLONxNLAT"; other text is the name of a file.
std::string targets_error(const std::string& text);

/// The centers of the grid's cells, from south to north, each row from -180 degrees to the east; or the
/// sites of the file. \pre targets_error(text) is empty. \throws FileError
Targets read_targets(Job& job, const std::string& text, const ReadOptions& read);

}  // namespace rondel::cli
