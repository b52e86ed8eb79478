// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a Triangulation shares with its copies.
#pragma once

#include "rondel/triangulation.h"
#include "topology/triangulation_arrays.h"

namespace rondel {

struct Triangulation::Impl {
  Sites sites;
  TriangulationArrays arrays;
  Options options;
  BuildReport report;
};

namespace api {

// Of arrays that the library made of these sites.
Triangulation make_triangulation(Sites sites, TriangulationArrays arrays, const Options& options,
                                 const BuildReport& report);

}  // namespace api
}  // namespace rondel
