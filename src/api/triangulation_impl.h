// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The immutable state that copies of a Triangulation share, and the ways to make one.
//
// in    sites and arrays, computed by the library or given by its user
// out   a Triangulation; a proof that given arrays are Delaunay, when it is first needed
// index sites in the order of the input; faces in the order of the arrays
#pragma once

#include <atomic>
#include <utility>

#include "rondel/triangulation.h"
#include "topology/triangulation_arrays.h"

namespace rondel {

// A default-constructed object is the triangulation of no sites.
struct Triangulation::Impl {
  Impl() = default;
  Impl(Sites its_sites, TriangulationArrays its_arrays, const Options& its_options,
       const BuildReport& its_report)
      : sites(std::move(its_sites)),
        arrays(std::move(its_arrays)),
        options(its_options),
        report(its_report) {}

  // Returns the state of a triangulation, for functions of the library that are no members.
  static const Impl& of(const Triangulation& triangulation) { return triangulation.impl(); }

  Sites sites;
  TriangulationArrays arrays;
  Options options;
  BuildReport report;
  // Throws if these are not the arrays of the triangulation of these sites. Null if the library
  // made them, or the proof has succeeded. A pointer, so that programs that take no arrays have no
  // proof in them.
  using Proof = void (*)(const Triangulation&, const Execution&);
  mutable std::atomic<Proof> proof = nullptr;
  // Whether edges were asked for, so that faces need not be Delaunay.
  bool has_constraints = false;
};

namespace api {

// Returns a triangulation of arrays that the library computed for these sites. Nothing is checked.
RONDEL_API Triangulation make_triangulation(Sites sites, TriangulationArrays arrays,
                                            const Options& options, const BuildReport& report);

// Runs the proof that is missing, once; functions that walk through the faces call it before they
// do. Throws InvalidInput if the proof fails, and again at the next call.
RONDEL_API void require_delaunay(const Triangulation& triangulation, const Execution& execution);

// Does the same for a triangulation with constraints. Arrays that were given are taken as Delaunay:
// the proof takes several times as long as a diagram, or as delaunay() itself.
RONDEL_API void require_unchanged_faces(const Triangulation& triangulation,
                                        const Execution& execution);

// Throws InvalidInput if the arrays are not those of the triangulation of their sites.
RONDEL_API void prove_delaunay(const Triangulation& triangulation, const Execution& execution);

}  // namespace api
}  // namespace rondel
