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
  // Whether these are the arrays of the triangulation of these sites: the library made them, or
  // require_delaunay() has proved it.
  mutable std::atomic<bool> is_delaunay = true;
};

namespace api {

// Of arrays that the library made of these sites.
Triangulation make_triangulation(Sites sites, TriangulationArrays arrays, const Options& options,
                                 const BuildReport& report);

// For whoever walks through the faces. Arrays that come from outside are proved to be those of the
// triangulation of their sites when this is first asked of them; throws InvalidInput if they are not.
void require_delaunay(const Triangulation& triangulation, const Execution& execution);

}  // namespace api
}  // namespace rondel
