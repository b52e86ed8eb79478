// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/prepared_triangulation.h"

#include <cstddef>
#include <numeric>

#include "exact/unit_vector.h"
#include "query/built.h"

namespace rondel::interpolation {
namespace {

std::vector<Index> all_ranks(std::size_t size) {
  std::vector<Index> ranks(size);
  std::iota(ranks.begin(), ranks.end(), Index{0});
  return ranks;
}

}  // namespace

PreparedTriangulation::PreparedTriangulation(const Triangulation& triangulation)
    : triangulation_(triangulation),
      center_(triangulation.sphere().center),
      built_(triangulation, {}, &query::order_ties_by_place),
      ranks_(all_ranks(built_.num_vertices())),
      engine_(built_.graph(ranks_)) {
  if (model() != Model::projected) return;
  units_.resize(num_vertices());
  exact::unit_vectors(triangulation.sites().points(), built_.representatives(), center_,
                      units_.data());
  if (triangulation.dimension() == 2) flat_faces_ = FlatFaces(triangulation_, mesh(), units_);
}

}  // namespace rondel::interpolation
