// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <atomic>
#include <cstddef>

#include "dual/parts.h"
#include "rondel/diagram.h"
#include "system/job.h"
#include "system/large_arrays.h"
#include "system/parallel.h"

namespace rondel {

std::vector<Point> dual::circumcenters(const Triangulation& triangulation, const SplitSites& sites,
                                       FaceKites* kites) {
  auto result = system::large_vector<Point>(triangulation.num_faces());
  if (kites != nullptr) kites->of = system::make_large_array<Kites>(result.size());
  std::atomic<bool> has_careful = false;
  system::parallel_for(
      sites.threads(), result.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
        Kites* const of = kites == nullptr ? nullptr : kites->of.get() + begin;
        if (unit_normals(sites, begin, std::span(result).subspan(begin, end - begin), of)) {
          has_careful.store(true, std::memory_order_relaxed);
        }
      });
  if (kites != nullptr) kites->has_careful = has_careful;
  return result;
}

std::vector<Point> dual::circumcenters_within(const Triangulation& surface) {
  return circumcenters(surface, SplitSites(surface, 1));
}

std::vector<Point> circumcenters(const Triangulation& triangulation, const Execution& execution) {
  const system::Call call(execution);
  return dual::circumcenters(triangulation, dual::SplitSites(triangulation, execution.threads));
}

}  // namespace rondel
