// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <cstddef>

#include "dual/face_normal.h"
#include "dual/parts.h"
#include "rondel/diagram.h"
#include "system/parallel.h"

namespace rondel {

std::vector<Point> dual::circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                       std::vector<FaceMeasure>& measures) {
  std::vector<Point> result(triangulation.num_faces());
  measures.resize(result.size());
  system::parallel_for(triangulation.report().threads, result.size(), parallel_grain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t f = begin; f < end; ++f) {
                           const auto [a, b, c] = sites.corners(static_cast<Index>(f));
                           result[f] = unit_normal(sites, a, b, c, measures[f]);
                         }
                       });
  return result;
}

std::vector<Point> dual::circumcenters(const Triangulation& triangulation,
                                       const SplitSites& sites) {
  std::vector<FaceMeasure> measures;
  return circumcenters(triangulation, sites, measures);
}

std::vector<Point> circumcenters(const Triangulation& triangulation, std::span<const Point> sites) {
  return dual::circumcenters(triangulation, dual::SplitSites(triangulation, sites));
}

}  // namespace rondel
