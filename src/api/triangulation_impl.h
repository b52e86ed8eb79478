// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a Triangulation shares with its copies.
#pragma once

#include <atomic>
#include <utility>

#include "rondel/triangulation.h"
#include "topology/triangulation_arrays.h"

namespace rondel {

struct Triangulation::Impl {
  Impl() = default;
  Impl(Sites its_sites, TriangulationArrays its_arrays, const Options& its_options,
       const BuildReport& its_report)
      : sites(std::move(its_sites)),
        arrays(std::move(its_arrays)),
        options(its_options),
        report(its_report) {}

  static const Impl& of(const Triangulation& triangulation) { return triangulation.impl(); }

  Sites sites;
  TriangulationArrays arrays;
  Options options;
  BuildReport report;
  // Throws if these are not the arrays of the triangulation of these sites. None: the library made
  // them, or it was asked. A pointer, so that programs that take no arrays have no proof in them.
  using Proof = void (*)(const Triangulation&, const Execution&);
  mutable std::atomic<Proof> proof = nullptr;
};

namespace api {

// Makes a triangulation of arrays that the library computed for these sites.
RONDEL_API Triangulation make_triangulation(Sites sites, TriangulationArrays arrays,
                                            const Options& options, const BuildReport& report);

// For whoever walks through the faces. Asks for the proof that is missing, once.
RONDEL_API void require_delaunay(const Triangulation& triangulation, const Execution& execution);

// Throws InvalidInput if the arrays are not those of the triangulation of their sites.
void prove_delaunay(const Triangulation& triangulation, const Execution& execution);

}  // namespace api
}  // namespace rondel
