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

namespace {

bool is_worth_counting(std::size_t num_pieces, std::size_t bound) {
  constexpr std::size_t few = 8;  // ends for each piece
  return num_pieces >= bound / few && num_pieces < no_index;
}

}  // namespace

// Sorts by counting the pieces of each lower end, or as usual if there are few.
void sort_by_ends(std::vector<ConstrainedPiece>& pieces, std::size_t bound) {
  if (!is_worth_counting(pieces.size(), bound)) {
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

namespace {

template <class Visit>
void visit_pieces(const PiecesOfConstraints& all, const Visit& visit) {
  auto divided = all.divided.begin();
  for (Index i = 0; i < all.ends.size(); ++i) {
    if (divided != all.divided.end() && *divided == i) {
      ++divided;
    } else {
      visit(piece_between(all.ends[i][0], all.ends[i][1], i));
    }
  }
  for (const ConstrainedPiece& piece : all.pieces) visit(piece);
}

// Writes the edges of pieces, sorted, and the constraint of each.
void write_sorted(const PiecesOfConstraints& all, std::size_t bound,
                  std::vector<std::array<Index, 2>>& edges, std::vector<Index>& constraints) {
  edges.resize(all.size());
  constraints.resize(all.size());
  const auto write = [&](std::size_t place, const ConstrainedPiece& piece) {
    edges[place] = {piece.low, piece.high};
    constraints[place] = piece.constraint;
  };
  std::vector<ConstrainedPiece> sorted;
  const auto write_all = [&](std::size_t begin) {
    std::ranges::sort(sorted);
    for (const ConstrainedPiece& piece : sorted) write(begin++, piece);
    sorted.clear();
  };
  if (!is_worth_counting(all.size(), bound)) {
    visit_pieces(all, [&](const ConstrainedPiece& piece) { sorted.push_back(piece); });
    write_all(0);
    return;
  }
  system::RowPlaces<Index> places(bound);
  visit_pieces(all, [&](const ConstrainedPiece& piece) { places.count(piece.low); });
  places.sum();
  visit_pieces(all, [&](const ConstrainedPiece& piece) { write(places.place(piece.low), piece); });
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end][0] == edges[begin][0]) ++end;
    if (end - begin > 1) {
      for (std::size_t i = begin; i < end; ++i) {
        sorted.push_back({edges[i][0], edges[i][1], constraints[i]});
      }
      write_all(begin);
    }
    begin = end;
  }
}

// Lists each edge once: its constraints follow each other.
void unite_edges(std::vector<std::array<Index, 2>>& edges, std::vector<std::uint64_t>& offsets) {
  offsets.resize(edges.size() + 1);
  std::size_t num_edges = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [low, high] = edges[i];
    if (num_edges > 0 && edges[num_edges - 1][0] == low && edges[num_edges - 1][1] == high)
      continue;
    edges[num_edges] = {low, high};
    offsets[num_edges++] = i;
  }
  offsets[num_edges] = edges.size();
  offsets.resize(num_edges + 1);
  edges.resize(num_edges);
}

// Returns, for each row of constraints, the sources of these.
CompressedRows<Index> sources_of(const CompressedRows<Index>& constraints,
                                 const CompressedRows<Index>& sources) {
  CompressedRows<Index> result;
  std::vector<Index> row;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    row.clear();
    for (const Index constraint : constraints[i]) {
      row.insert(row.end(), sources[constraint].begin(), sources[constraint].end());
    }
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    result.append(row);
  }
  return result;
}

}  // namespace

void list_edges(const PiecesOfConstraints& all, std::size_t bound,
                const CompressedRows<Index>* sources, ConstrainedTriangulation& result) {
  write_sorted(all, bound, result.edges, result.sources.values);
  unite_edges(result.edges, result.sources.offsets);
  if (sources != nullptr) result.sources = sources_of(result.sources, *sources);
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
