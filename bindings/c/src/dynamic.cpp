// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Insertion, removal and moves of sites.
#include "rondel/dynamic.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "handles.h"
#include "rondel.h"

namespace rc = rondel::c;

extern "C" {

rondel_status rondel_dynamic_create(const double* points, size_t n, const rondel_options* options,
                                    const rondel_execution* execution, rondel_dynamic** dynamic) {
  return rc::make_handle(dynamic, [&] {
    return std::make_unique<rondel_dynamic>(
        rondel_dynamic{std::make_shared<rondel::DynamicTriangulation>(
            rc::copied_points(points, n, "points"), rc::options_of(options),
            rc::execution_of(execution))});
  });
}

void rondel_dynamic_free(rondel_dynamic* dynamic) { delete dynamic; }

rondel_status rondel_insert(rondel_dynamic* dynamic, const double* points, size_t n,
                            const rondel_execution* execution, uint32_t* ids) {
  return rc::guarded([&] {
    rc::require(dynamic, "dynamic");
    if (n > 0) rc::require(ids, "ids");
    std::ranges::copy(dynamic->dynamic->insert(rc::copied_points(points, n, "points"),
                                               rc::execution_of(execution)),
                      ids);
  });
}

rondel_status rondel_remove(rondel_dynamic* dynamic, const uint32_t* ids, size_t n,
                            const rondel_execution* execution) {
  return rc::guarded([&] {
    rc::require(dynamic, "dynamic");
    dynamic->dynamic->remove(rc::indices_at(ids, n, "ids"), rc::execution_of(execution));
  });
}

rondel_status rondel_move(rondel_dynamic* dynamic, const uint32_t* ids, const double* points,
                          size_t n, const rondel_execution* execution) {
  return rc::guarded([&] {
    rc::require(dynamic, "dynamic");
    dynamic->dynamic->move(rc::indices_at(ids, n, "ids"), rc::copied_points(points, n, "points"),
                           rc::execution_of(execution));
  });
}

rondel_status rondel_move_all(rondel_dynamic* dynamic, const double* points, size_t n,
                              const rondel_execution* execution) {
  return rc::guarded([&] {
    rc::require(dynamic, "dynamic");
    dynamic->dynamic->move_all(rc::copied_points(points, n, "points"), rc::execution_of(execution));
  });
}

size_t rondel_dynamic_num_sites(const rondel_dynamic* dynamic) {
  return dynamic->dynamic->num_sites();
}

rondel_status rondel_dynamic_ids(const rondel_dynamic* dynamic, uint32_t* ids) {
  return rc::guarded([&] {
    rc::require(dynamic, "dynamic");
    const std::vector<rondel::Index> found = dynamic->dynamic->ids();
    if (!found.empty()) rc::require(ids, "ids");
    std::ranges::copy(found, ids);
  });
}

rondel_status rondel_dynamic_neighbors(const rondel_dynamic* dynamic, uint32_t id,
                                       rondel_lists** ids) {
  return rc::make_handle(ids, [&] {
    rc::require(dynamic, "dynamic");
    std::vector<rondel::Index> found = dynamic->dynamic->neighbors(id);
    return std::make_unique<rondel_lists>(rondel_lists{{{0, found.size()}, std::move(found)}});
  });
}

rondel_status rondel_dynamic_snapshot(const rondel_dynamic* dynamic,
                                      rondel_triangulation** snapshot) {
  return rc::make_handle(snapshot, [&] {
    rc::require(dynamic, "dynamic");
    return std::make_unique<rondel_triangulation>(dynamic->dynamic->snapshot().triangulation);
  });
}

}  // extern "C"
