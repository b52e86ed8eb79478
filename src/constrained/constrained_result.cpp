// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/constrained_result.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "api/triangulation_impl.h"
#include "exact/vector.h"
#include "order/sorts.h"
#include "rondel/delaunay.h"

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

void sort_by_ends(std::vector<ConstrainedPiece>& pieces, std::size_t bound) {
  const auto width = static_cast<int>(std::bit_width(bound));
  order::KeyedIndices keyed;
  keyed.keys.reserve(pieces.size());
  keyed.indices.reserve(pieces.size());
  for (const ConstrainedPiece& piece : pieces) {
    keyed.keys.push_back(std::uint64_t{piece.low} << width | piece.high);
    keyed.indices.push_back(piece.constraint);
  }
  order::radix_sort(keyed, 2 * width);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto low = static_cast<Index>(keyed.keys[i] >> width);
    const auto high = static_cast<Index>(keyed.keys[i] ^ std::uint64_t{low} << width);
    pieces[i] = {low, high, keyed.indices[i]};
  }
}

void list_edges(std::span<const ConstrainedPiece> pieces, const CompressedRows<Index>* sources,
                ConstrainedTriangulation& result) {
  std::vector<Index>& values = result.sources.values;
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
    std::sort(values.begin() + first, values.end());
    values.erase(std::unique(values.begin() + first, values.end()), values.end());
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
  return Triangulation(impl);
}

}  // namespace rondel::constrained
