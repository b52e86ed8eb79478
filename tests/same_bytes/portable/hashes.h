// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Hashes of what the library makes of sets of sites.
#pragma once

#include <string>
#include <vector>

#include "same_bytes/portable/site_sets.h"

namespace rondel::test {

// For each set and each model a line: name, model, hash of the triangulation, hash of its duals; more
// than one if 1, 2 and 5 threads do not make the same triangulation.
std::vector<std::string> hash_lines(const SiteSets& sets);

// Prints what differs from the lines that the file has, in any order; returns how many do.
std::size_t num_different(const std::string& expected_path, const std::vector<std::string>& lines);

}  // namespace rondel::test
