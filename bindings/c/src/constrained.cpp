// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Triangulations with given edges.
#include "rondel/constrained.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "handles.h"
#include "rondel.h"

namespace rc = rondel::c;

// NOLINTBEGIN(readability-identifier-naming): C's names
struct rondel_constrained {
  rondel::ConstrainedTriangulation result;
};
// NOLINTEND(readability-identifier-naming)

namespace {

using Ends = std::array<rondel::Index, 2>;

std::vector<Ends> copied_constraints(const std::uint32_t* constraints, std::size_t n) {
  if (n > 0) rc::require(constraints, "constraints");
  std::vector<Ends> copied(n);
  for (std::size_t i = 0; i < n; ++i) copied[i] = {constraints[2 * i], constraints[2 * i + 1]};
  return copied;
}

rondel::ConstrainedOptions constrained_options_of(const rondel_options* options,
                                                  std::int32_t crossings) {
  const rondel::Options given = rc::options_of(options);
  if (given.model != rondel::Model::projected) {
    throw rondel::InvalidInput("options: constraints are between projected sites");
  }
  if (crossings != RONDEL_REFUSE_CROSSINGS && crossings != RONDEL_SPLIT_CROSSINGS) {
    throw rondel::InvalidInput("crossings: neither refused nor split");
  }
  return {.sphere = given.sphere,
          .crossings = crossings == RONDEL_SPLIT_CROSSINGS ? rondel::ConstraintCrossings::split
                                                           : rondel::ConstraintCrossings::refuse};
}

}  // namespace

extern "C" {

rondel_status rondel_constrained_delaunay(const double* points, size_t n,
                                          const uint32_t* constraints, size_t num_constraints,
                                          const rondel_options* options, int32_t crossings,
                                          const rondel_execution* execution,
                                          rondel_constrained** constrained) {
  return rc::make_handle(constrained, [&] {
    return std::make_unique<rondel_constrained>(rondel_constrained{rondel::constrained_delaunay(
        rc::copied_points(points, n, "points"), copied_constraints(constraints, num_constraints),
        constrained_options_of(options, crossings), rc::execution_of(execution))});
  });
}

void rondel_constrained_free(rondel_constrained* constrained) { delete constrained; }

rondel_status rondel_constrained_triangulation(const rondel_constrained* constrained,
                                               rondel_triangulation** triangulation) {
  return rc::make_handle(triangulation, [&] {
    rc::require(constrained, "constrained");
    return std::make_unique<rondel_triangulation>(constrained->result.triangulation);
  });
}

size_t rondel_num_constrained_edges(const rondel_constrained* constrained) {
  return constrained->result.edges.size();
}

const uint32_t* rondel_constrained_edges(const rondel_constrained* constrained) {
  const auto& edges = constrained->result.edges;
  return edges.empty() ? nullptr : edges.front().data();
}

const uint64_t* rondel_constrained_source_offsets(const rondel_constrained* constrained) {
  return constrained->result.sources.offsets.data();
}

const uint32_t* rondel_constrained_sources(const rondel_constrained* constrained) {
  return constrained->result.sources.values.data();
}

const uint8_t* rondel_constrained_sides(const rondel_constrained* constrained) {
  return constrained->result.sides.data();
}

}  // extern "C"
