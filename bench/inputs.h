// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The inputs of the measurements, with the same bits for every program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::bench {

// Returns the sites of a kind of inputs/kinds.h, which may have an angle in degrees as in
// "circles:0.3". A name that ends in .csv or .npy is a file, of which all sites are read. Throws
// std::invalid_argument for other names.
std::vector<Point> make_input(const std::string& kind, std::size_t n, std::uint64_t seed = 1);

// Removes "--seed S" from the arguments and returns S; returns 1 if it is not given.
std::uint64_t take_seed(int& argc, char** argv);

// Inputs of one kind and number of sites, each with its own seed.
class Source {
 public:
  Source(std::string kind, const char* n, std::uint64_t first_seed);
  std::vector<Point> next() { return make_input(kind_, n_, seed_++); }

 private:
  std::string kind_;
  std::size_t n_;
  std::uint64_t seed_;
};

}  // namespace rondel::bench
