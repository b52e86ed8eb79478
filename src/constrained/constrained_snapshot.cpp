// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "constrained/constrained_snapshot.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "api/triangulation_impl.h"
#include "constrained/constrained_order.h"
#include "constrained/constrained_result.h"
#include "dynamic/snapshot.h"
#include "order/renamed.h"
#include "order/spatial_order.h"
#include "topology/canonical_order.h"
#include "topology/mesh.h"

namespace rondel::constrained {
namespace {

using topology::next_corner;

// The faces of a mesh without gaps, their corners being ranks, each starting with its owner.
struct RankedFaces {
  RankedFaces(const ConstrainedHull& hull, std::span<const Index> rank_of_place) {
    const topology::Mesh& mesh = hull.mesh();
    std::vector<Index> number(mesh.num_slots());
    Index count = 0;
    mesh.for_each_face([&](Index f) { number[f] = count++; });
    faces.reserve(count);
    neighbors.reserve(count);
    sides.reserve(count);
    states.reserve(count);
    mesh.for_each_face([&](Index f) {
      const Triple& v = mesh[f].vertex;
      const Triple ranks = {rank_of_place[v[0]], rank_of_place[v[1]], rank_of_place[v[2]]};
      unsigned corner = topology::first_corner(ranks);
      Triple face;
      Triple beyond;
      unsigned bits = 0;
      for (unsigned i = 0; i < 3; ++i) {
        face[i] = ranks[corner];
        beyond[i] = number[mesh.neighbor(f, corner)];
        bits |= (static_cast<unsigned>(hull.sides()[f]) >> corner & 1U) << i;
        corner = next_corner[corner];
      }
      if (!hull.is_solid(f)) ghosts.push_back(static_cast<Index>(faces.size()));
      states.push_back(hull.is_solid(f) ? changed_face : changed_face | ghost_face);
      faces.push_back(face);
      neighbors.push_back(beyond);
      sides.push_back(static_cast<std::uint8_t>(bits));
    });
  }

  std::vector<Triple> faces;
  std::vector<Triple> neighbors;
  std::vector<std::uint8_t> sides;
  std::vector<std::uint8_t> states;
  std::vector<Index> ghosts;
};

std::vector<ConstrainedPiece> pieces_of(const ConstrainedHull& hull,
                                        std::span<const Index> name_of_place,
                                        std::span<const Index> constraint_ids) {
  std::vector<ConstrainedPiece> pieces;
  for (const auto& [edge, constraints] : hull.sources()) {
    for (const Index id : constraints) {
      const auto position = std::ranges::lower_bound(constraint_ids, id) - constraint_ids.begin();
      pieces.push_back(piece_between(name_of_place[edge[0]], name_of_place[edge[1]],
                                     static_cast<Index>(position)));
    }
  }
  return pieces;
}

}  // namespace

ConstrainedSnapshot make_snapshot(const dynamic::Places& places, const ConstrainedHull& hull,
                                  const DynamicConstraints& constraints, const Sphere& sphere) {
  ConstrainedSnapshot now;
  now.site_ids = dynamic::live_sites(places);
  now.constraint_ids = constraints.ids();
  std::vector<Point> points;
  points.reserve(now.site_ids.size());
  for (const Index id : now.site_ids) points.push_back(places.point(id));
  auto [names, duplicates, renamed] =
      order::spatial_order(points, Model::projected, sphere.center, 1);
  std::vector<Index> rank_of_place(places.place_limit(), no_index);
  std::vector<Index> name_of_place(places.place_limit(), no_index);
  std::vector<Index> place_of_rank(names.size());
  for (std::size_t rank = 0; rank < names.size(); ++rank) {
    place_of_rank[rank] = places.place_of(now.site_ids[names[rank]]);
    rank_of_place[place_of_rank[rank]] = static_cast<Index>(rank);
  }
  order::rename(names, renamed);
  for (std::size_t rank = 0; rank < names.size(); ++rank) {
    name_of_place[place_of_rank[rank]] = names[rank];
  }
  RankedFaces faces(hull, rank_of_place);
  TriangulationArrays arrays;
  arrays.num_sites = points.size();
  arrays.dimension = 2;
  arrays.duplicates = std::move(duplicates);
  arrays.ghost_faces = std::move(faces.ghosts);
  const std::vector<std::uint8_t> is_touched(names.size(), 1);
  write_in_order({faces.faces, faces.neighbors, faces.sides, faces.states, is_touched, names}, 1,
                 arrays, now.result.sides);
  const std::vector<ConstrainedPiece> pieces = pieces_of(hull, name_of_place, now.constraint_ids);
  const bool has_pieces = !pieces.empty();
  list_edges({{}, {}, pieces}, points.size(), nullptr, now.result);
  Sites sites(std::move(points));
  const Options options = {Model::projected, sphere};
  if (has_pieces) {
    now.result.triangulation = with_faces(sites, std::move(arrays), options, {});
  } else {
    now.result.triangulation =
        api::make_triangulation(std::move(sites), std::move(arrays), options, {});
  }
  return now;
}

std::vector<Index> flat_chain(const ConstrainedSnapshot& now, Index constraint, Index first,
                              Index last) {
  // The edges of a constraint are a path.
  const auto position = static_cast<Index>(
      std::ranges::lower_bound(now.constraint_ids, constraint) - now.constraint_ids.begin());
  std::vector<std::array<Index, 2>> path;
  for (std::size_t e = 0; e < now.result.edges.size(); ++e) {
    if (!std::ranges::binary_search(now.result.sources[e], position)) continue;
    const auto& [a, b] = now.result.edges[e];
    path.push_back({now.site_ids[a], now.site_ids[b]});
  }
  std::vector<Index> chain = {first};
  while (chain.back() != last) {
    const auto next = std::ranges::find_if(path, [&](const std::array<Index, 2>& edge) {
      return edge[0] == chain.back() || edge[1] == chain.back();
    });
    chain.push_back((*next)[0] == chain.back() ? (*next)[1] : (*next)[0]);
    path.erase(next);
  }
  return chain;
}

}  // namespace rondel::constrained
