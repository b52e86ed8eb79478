// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The inputs of the measurements, the same bits for every program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rondel/types.h"

namespace rondel::bench {

// Kinds: those of inputs/kinds.h, with an angle in degrees as in "circles:0.3". A name that ends
// in .csv or .npy is a file, of which all sites are read.
// Throws std::invalid_argument for others.
std::vector<Point> make_input(const std::string& kind, std::size_t n, std::uint64_t seed = 1);

// The S of "--seed S", which it takes out of the arguments; 1 if there is none.
std::uint64_t take_seed(int& argc, char** argv);

// Inputs of one kind and number of sites, each with a seed of its own.
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
