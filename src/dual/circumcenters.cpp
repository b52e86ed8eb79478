// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <atomic>
#include <cstddef>

#include "dual/parts.h"
#include "rondel/diagram.h"
#include "system/huge_pages.h"
#include "system/job.h"
#include "system/parallel.h"

namespace rondel {
namespace {

// `kites`, unless it is null, has room for all faces. Returns whether one of them is careful.
bool measure_faces(const dual::SplitSites& sites, std::span<Point> points, dual::Kites* kites) {
  std::atomic<bool> result = false;
  system::parallel_for(sites.threads(), points.size(), dual::parallel_grain,
                       [&](std::size_t begin, std::size_t end) {
                         if (dual::unit_normals(sites, begin, points.subspan(begin, end - begin),
                                                kites == nullptr ? nullptr : kites + begin)) {
                           result.store(true, std::memory_order_relaxed);
                         }
                       });
  return result;
}

}  // namespace

std::vector<Point> dual::circumcenters(const Triangulation& triangulation,
                                       const SplitSites& sites) {
  auto result = system::large_vector<Point>(triangulation.num_faces());
  measure_faces(sites, result, nullptr);
  return result;
}

std::vector<Point> dual::circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                       FaceKites& kites) {
  auto result = system::large_vector<Point>(triangulation.num_faces());
  kites.of = system::make_large_array<Kites>(result.size());
  kites.has_careful = measure_faces(sites, result, kites.of.get());
  return result;
}

}  // namespace rondel

namespace rondel {

std::vector<Point> circumcenters(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  return dual::circumcenters(triangulation, dual::SplitSites(triangulation, execution.threads));
}

}  // namespace rondel
