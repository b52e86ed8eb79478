// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <atomic>
#include <cstddef>

#include "dual/parts.h"
#include "rondel/diagram.h"
#include "system/arithmetic.h"
#include "system/huge_pages.h"
#include "system/parallel.h"

namespace rondel {
namespace {

// `kites`, unless it is null, has room for all faces. Returns whether one of them is careful.
bool measure_faces(const Triangulation& triangulation, const dual::SplitSites& sites,
                   std::span<Point> points, dual::Kites* kites) {
  std::atomic<bool> result = false;
  system::parallel_for(triangulation.report().threads, points.size(), dual::parallel_grain,
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
  measure_faces(triangulation, sites, result, nullptr);
  return result;
}

std::vector<Point> dual::circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                       FaceKites& kites) {
  auto result = system::large_vector<Point>(triangulation.num_faces());
  kites.of = system::make_large_array<Kites>(result.size());
  kites.has_careful = measure_faces(triangulation, sites, result, kites.of.get());
  return result;
}

std::vector<Point> circumcenters(const Triangulation& triangulation, std::span<const Point> sites) {
  const system::ArithmeticScope arithmetic;
  return dual::circumcenters(triangulation, dual::SplitSites(triangulation, sites));
}

}  // namespace rondel
