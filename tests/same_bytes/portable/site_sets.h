// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Named sets of sites, and a file of them that every machine reads as it was written: numbers are
// hexadecimal text. Sites are computed with sines and cosines, which differ from one C library to the
// next; what is compared must be made of the same sites.
#pragma once

#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::test {

struct SiteSets {
  struct Set {
    std::string name;  // without spaces
    std::vector<Point> sites;
    Sphere sphere{};
    bool is_weighted_only = false;
  };
  std::vector<Set> sets;
};

// Both throw std::runtime_error.
void write_site_sets(const std::string& path, const SiteSets& sets);
SiteSets read_site_sets(const std::string& path);

}  // namespace rondel::test
