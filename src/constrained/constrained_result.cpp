// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/constrained_result.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "api/triangulation_impl.h"
#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "system/row_assembly.h"

namespace rondel::constrained {

LonLat place_of_crossing(const std::array<Point, 2>& e, const std::array<Point, 2>& f,
                         const Sphere& sphere) {
  const auto direction = [&](const Point& p) {
    const exact::Vector3<double> point = exact::to_vector(p);
    const exact::Vector3<double> center = exact::to_vector(sphere.center);
    const exact::Vector3<double> ray = point - center;
    const bool is_finite = std::isfinite(largest_coordinate(ray));
    return normalized(scaled(is_finite ? ray : 0.5 * point - 0.5 * center));
  };
  const auto a = direction(e[0]);
  const auto b = direction(e[1]);
  const auto c = direction(f[0]);
  const auto d = direction(f[1]);
  auto place = cross(cross(a, b - a), cross(c, d - c));
  if (dot(place, a + b) < 0) place = -1.0 * place;
  // What rounding leaves nothing of has another place of the arcs.
  for (const auto& other : {a + b, c + d, a}) {
    if (!(dot(place, place) > 0)) place = other;
  }
  const Point point = exact::to_point(place);
  return lonlats(std::span(&point, 1))[0];
}

// Sorts by counting the pieces of each lower end, or as usual if there are few.
void sort_by_ends(std::vector<ConstrainedPiece>& pieces, std::size_t bound) {
  constexpr std::size_t few = 8;  // ends for each piece
  if (pieces.size() < bound / few || pieces.size() >= no_index) {
    std::ranges::sort(pieces);
    return;
  }
  system::RowPlaces<Index> places(bound);
  for (const ConstrainedPiece& piece : pieces) places.count(piece.low);
  std::vector<ConstrainedPiece> sorted(places.sum());
  for (const ConstrainedPiece& piece : pieces) sorted[places.place(piece.low)] = piece;
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    const auto end = std::find_if(begin, sorted.end(), [&](const ConstrainedPiece& piece) {
      return piece.low != begin->low;
    });
    if (end - begin > 1) std::sort(begin, end);
    begin = end;
  }
  pieces = std::move(sorted);
}

void list_edges(std::span<const ConstrainedPiece> pieces, const CompressedRows<Index>* sources,
                ConstrainedTriangulation& result) {
  std::vector<Index>& values = result.sources.values;
  values.reserve(pieces.size());
  result.edges.reserve(pieces.size());
  result.sources.offsets.reserve(pieces.size() + 1);
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::array<Index, 2> edge = {pieces[begin].low, pieces[begin].high};
    const auto first = static_cast<std::ptrdiff_t>(values.size());
    std::size_t end = begin;
    for (; end < pieces.size() && std::array{pieces[end].low, pieces[end].high} == edge; ++end) {
      const Index constraint = pieces[end].constraint;
      if (sources == nullptr) {
        values.push_back(constraint);
      } else {
        values.insert(values.end(), (*sources)[constraint].begin(), (*sources)[constraint].end());
      }
    }
    if (end - begin > 1 || sources != nullptr) {
      std::sort(values.begin() + first, values.end());
      values.erase(std::unique(values.begin() + first, values.end()), values.end());
    }
    result.edges.push_back(edge);
    result.sources.end_row();
    begin = end;
  }
}

Triangulation with_faces(const Sites& sites, TriangulationArrays arrays, const Options& options,
                         const BuildReport& report) {
  const auto impl =
      std::make_shared<Triangulation::Impl>(sites, std::move(arrays), options, report);
  impl->proof = &api::prove_delaunay;
  impl->has_constraints = true;
  return Triangulation(impl);
}

}  // namespace rondel::constrained
