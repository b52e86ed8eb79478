// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dual/circumcenters.h"

#include <cstddef>

#include "blocks/parallel.h"
#include "dual/face_normal.h"
#include "rondel/diagram.h"

namespace rondel {

std::vector<Point> dual::circumcenters(const Triangulation& triangulation,
                                       const SplitSites& sites) {
  const auto faces = triangulation.faces();
  std::vector<Point> result(faces.size());
  blocks::parallel_for(0, faces.size(), triangulation.report().threads,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t f = begin; f < end; ++f) {
                           if (f + prefetch_distance < end) {
                             for (const Index v : faces[f + prefetch_distance]) sites.prefetch(v);
                           }
                           const auto [a, b, c] = faces[f];
                           result[f] = unit_normal(sites, a, b, c);
                         }
                       });
  return result;
}

std::vector<Point> circumcenters(const Triangulation& triangulation, std::span<const Point> sites) {
  return dual::circumcenters(triangulation, dual::SplitSites(triangulation, sites));
}

}  // namespace rondel
