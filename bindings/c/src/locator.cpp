// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Queries of position and distance.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "handles.h"
#include "rondel.h"
#include "rondel/query.h"

namespace rc = rondel::c;

extern "C" {

rondel_status rondel_locator_create(const rondel_triangulation* triangulation,
                                    rondel_locator** locator) {
  return rc::make_handle(locator, [&] {
    rc::require(triangulation, "triangulation");
    return std::make_unique<rondel_locator>(
        rondel_locator{nullptr, rondel::Locator(triangulation->triangulation)});
  });
}

rondel_status rondel_locator_create_dynamic(const rondel_dynamic* dynamic,
                                            rondel_locator** locator) {
  return rc::make_handle(locator, [&] {
    rc::require(dynamic, "dynamic");
    return std::make_unique<rondel_locator>(
        rondel_locator{dynamic->dynamic, rondel::Locator(*dynamic->dynamic)});
  });
}

void rondel_locator_free(rondel_locator* locator) { delete locator; }

rondel_status rondel_nearest(const rondel_locator* locator, const double* points, size_t n,
                             const rondel_execution* execution, uint32_t* sites) {
  return rc::guarded([&] {
    rc::require(locator, "locator");
    if (n > 0) rc::require(sites, "sites");
    std::ranges::copy(locator->locator.nearest(rc::copied_points(points, n, "points"),
                                               rc::execution_of(execution)),
                      sites);
  });
}

rondel_status rondel_k_nearest(const rondel_locator* locator, const double* points, size_t n,
                               size_t k, const rondel_execution* execution, uint32_t* sites) {
  return rc::guarded([&] {
    rc::require(locator, "locator");
    if (n > 0 && k > 0) rc::require(sites, "sites");
    std::ranges::copy(locator->locator.k_nearest(rc::copied_points(points, n, "points"), k,
                                                 rc::execution_of(execution)),
                      sites);
  });
}

rondel_status rondel_within(const rondel_locator* locator, const double* points, size_t n,
                            double angle, const rondel_execution* execution, rondel_lists** sites) {
  return rc::make_handle(sites, [&] {
    rc::require(locator, "locator");
    return std::make_unique<rondel_lists>(rondel_lists{locator->locator.within(
        rc::copied_points(points, n, "points"), angle, rc::execution_of(execution))});
  });
}

rondel_status rondel_locate(const rondel_locator* locator, const double* points, size_t n,
                            const rondel_execution* execution, int32_t* where, uint32_t* faces,
                            uint32_t* sites) {
  return rc::guarded([&] {
    rc::require(locator, "locator");
    const std::vector<rondel::Location> found = locator->locator.locate(
        rc::copied_points(points, n, "points"), rc::execution_of(execution));
    for (std::size_t i = 0; i < n; ++i) {
      if (where != nullptr) where[i] = static_cast<std::int32_t>(found[i].where);
      if (faces != nullptr) faces[i] = found[i].face;
      if (sites != nullptr) std::ranges::copy(found[i].sites, sites + 3 * i);
    }
  });
}

rondel_status rondel_distance(const rondel_locator* locator, const double point[3], uint32_t site,
                              double* distance) {
  return rc::guarded([&] {
    rc::require(locator, "locator");
    rc::require(distance, "distance");
    *distance = locator->locator.distance(rc::copied_points(point, 1, "point").front(), site);
  });
}

}  // extern "C"
