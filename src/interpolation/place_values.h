// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Values of fields at vertices, whatever their order outside and however many sites share a place.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "interpolation/ground.h"
#include "rondel/interpolate.h"
#include "system/large_vector.h"

namespace rondel::interpolation {

// The sites of a vertex that has several, in increasing order.
struct SharedSites {
  Index vertex;
  std::vector<Index> sites;
};
// In the order of the vertices.
std::vector<SharedSites> shared_places(const Ground& ground);

// Where the numbers of fields are: that of field f and site i at data[starts[f] + i * step].
struct FieldLayout {
  const double* data;
  std::vector<std::size_t> starts;
  std::size_t step;
};
FieldLayout scalar_fields(std::span<const double> field, std::size_t num_sites);
// Three fields for each.
FieldLayout vector_fields(std::span<const Point> field, std::size_t num_sites);

class PlaceValues {
 public:
  // Refers to the fields. They are brought into the order of the vertices if that pays for so many
  // targets.
  PlaceValues(const Ground& ground, FieldLayout fields, SharedPlace shared, std::size_t num_targets,
              unsigned threads);

  [[nodiscard]] std::size_t num_fields() const { return layout_.starts.size(); }
  [[nodiscard]] double operator()(std::size_t f, Index vertex) const {
    const std::size_t i = names_ == nullptr ? vertex : names_[vertex];
    return layout_.data[layout_.starts[f] + i * layout_.step];
  }

 private:
  void gather(const Ground& ground, unsigned threads);
  void take_means(const Ground& ground);

  FieldLayout layout_;
  const Index* names_;             // none: the values lie as the vertices do
  LargeVector<double> by_vertex_;  // all fields of a vertex together
};

}  // namespace rondel::interpolation
