// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The values of fields at vertices, whatever the order of the sites is and however many sites share
// a place.
//
// in    fields by site, and what counts where several sites share a place
// out   the value of field f at a vertex
// index fields; vertices by spatial rank; sites
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "interpolation/prepared_triangulation.h"
#include "interpolation/settled_mean.h"
#include "rondel/interpolate.h"
#include "system/large_arrays.h"

namespace rondel::interpolation {

// The sites of a vertex that has several sites, in increasing order.
struct SharedSites {
  Index vertex;
  std::vector<Index> sites;
};
// Returns all vertices with several sites, in increasing order.
std::vector<SharedSites> shared_places(const PreparedTriangulation& prepared);

// Returns the mean of the numbers value(i) of some sites, which is never beyond the smallest or the largest of them.
template <class Value>
double mean_of(std::span<const Index> sites, const Value& value) {
  return mean_of([&](const auto& visit) {
    for (const Index i : sites) visit(value(i));
  });
}

// Says where values are stored: that of field f at site i is data[starts[f] + i * step].
struct FieldLayout {
  const double* data;
  std::vector<std::size_t> starts;
  std::size_t step;
};
// Returns the layout of fields of doubles, one after the other.
FieldLayout scalar_fields(std::span<const double> field, std::size_t num_sites);
// Returns the layout of fields of vectors: each gives three fields, one for each coordinate.
FieldLayout vector_fields(std::span<const Point> field, std::size_t num_sites);

class VertexFields {
 public:
  // Refers to the fields. They are copied into the order of the vertices if that saves time for
  // `num_targets` targets, or if values of a place are averaged (SharedPlace::mean).
  VertexFields(const PreparedTriangulation& prepared, FieldLayout fields, SharedPlace shared,
               std::size_t num_targets, unsigned threads);

  [[nodiscard]] std::size_t num_fields() const { return layout_.starts.size(); }
  [[nodiscard]] double operator()(std::size_t f, Index vertex) const {
    const std::size_t i = names_ == nullptr ? vertex : names_[vertex];
    return layout_.data[layout_.starts[f] + i * layout_.step];
  }

 private:
  void gather(const PreparedTriangulation& prepared, unsigned threads);
  void take_means(const PreparedTriangulation& prepared);

  FieldLayout layout_;
  const Index* names_;             // the site of each vertex; null if the values are stored by
                                   // vertex
  LargeVector<double> by_vertex_;  // the fields of a vertex are adjacent
};

// How sums of products with large weights are protected from overflow.
// Weights may be larger than 1, so that a partial sum may overflow although the sum does not. The
// sum is then taken again with all values multiplied by this number, and divided by it.
inline constexpr double scale_of_large = 0x1p-8;

}  // namespace rondel::interpolation
