// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: triangulate, insert the constraints one by one along the spatial order, write the faces in
// canonical order, and list which constraint each edge comes from.

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "api/build.h"
#include "api/triangulation_impl.h"
#include "api/validation.h"
#include "constrained/constrained_faces.h"
#include "constrained/constrained_order.h"
#include "constrained/constrained_result.h"
#include "constrained/constraints.h"
#include "constrained/split_constraints.h"
#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace constrained {
namespace {

using Ends = std::array<Index, 2>;

std::string text_of(const Ends& constraints, const LonLat& place) {
  return "constraints " + std::to_string(constraints[0]) + " and " +
         std::to_string(constraints[1]) + " cross at longitude " +
         system::shortest_text(place.lon_deg) + ", latitude " +
         system::shortest_text(place.lat_deg);
}

// Inserts all constraints, and returns their pieces, sorted by their ends.
std::vector<ConstrainedPiece> insert_all(ConstrainedFaces& faces, const NamedSites& sites,
                                         std::span<const Ends> ends, const system::Job& job) {
  // Neighbors in this order are close to each other; so a long constraint finds few short ones
  // that were inserted far away, and memory that is known.
  std::vector<ConstrainedPiece> order;
  order.reserve(ends.size());
  for (Index i = 0; i < ends.size(); ++i) {
    order.push_back(piece_between(faces.vertex_of(ends[i][0]), faces.vertex_of(ends[i][1]), i));
  }
  sort_by_ends(order, sites.size());
  std::vector<ConstrainedPiece> pieces;
  pieces.reserve(ends.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    constexpr std::size_t pause = 4096;
    if (k % pause == 0) {
      system::obey_stop();
      system::announce(job, "constrain", k, order.size());
    }
    const Index i = order[k].constraint;
    const auto crossed = faces.insert(order[k], pieces);
    if (!crossed) continue;
    const ConstrainedPiece edge = piece_between((*crossed)[0], (*crossed)[1], 0);
    const auto other = std::ranges::find_if(pieces, [&](const ConstrainedPiece& piece) {
      return piece.low == edge.low && piece.high == edge.high;
    });
    const auto [low, high] = std::minmax(i, other->constraint);
    throw CrossingConstraints(
        low, high,
        place_of_crossing({sites.point(ends[low][0]), sites.point(ends[low][1])},
                          {sites.point(ends[high][0]), sites.point(ends[high][1])}, job.sphere));
  }
  sort_by_ends(pieces, sites.size());
  return pieces;
}

ConstrainedTriangulation constrain(const Sites& sites, std::span<const Ends> constraints,
                                   const CompressedRows<Index>* sources, const system::Job& job) {
  api::Parts built = api::build_parts(sites.points(), job);
  // Whoever gives crossings to be split has proved this before.
  if (sources == nullptr) require_arcs(sites.points(), constraints, job.sphere);
  const NamedSites named(sites.points(), built.arrays.duplicates);
  std::vector<Ends> ends;
  ends.reserve(constraints.size());
  for (const auto& [a, b] : constraints) ends.push_back({named.name(a), named.name(b)});
  ConstrainedTriangulation result;
  const bool has_edges = built.arrays.dimension == 2 && !ends.empty();
  if (has_edges) {
    ConstrainedFaces faces(sites.points(), built, job.sphere, job.threads);
    list_edges(insert_all(faces, named, ends, job), sources, result);
    if (faces.has_changes()) {
      write_in_order(faces.to_order(), job.threads, built.arrays, result.sides);
      result.triangulation = with_faces(sites, std::move(built.arrays), job, built.report);
      system::announce(job, "constrain", 1);
      return result;
    }
    result.sides = faces.sides();
    faces.give_back(built.arrays);
  }
  result.triangulation = api::make_triangulation(sites, std::move(built.arrays), job, built.report);
  if (!has_edges) {
    result.sides.resize(result.triangulation.num_faces());
    std::vector<ConstrainedPiece> pieces = pieces_on_ring(result.triangulation, named, ends);
    std::ranges::sort(pieces);
    list_edges(pieces, sources, result);
  }
  system::announce(job, "constrain", 1);
  return result;
}

}  // namespace
}  // namespace constrained

CrossingConstraints::CrossingConstraints(Index first, Index second, const LonLat& place)
    : InvalidInput(constrained::text_of({first, second}, place), second),
      constraints_{first, second},
      place_(place) {}

CrossingConstraints::~CrossingConstraints() = default;

ConstrainedTriangulation constrained_delaunay(const Sites& sites,
                                              std::span<const std::array<Index, 2>> constraints,
                                              const ConstrainedOptions& options,
                                              const Execution& execution) {
  const system::Call call(execution);
  const system::Job job = {{Model::projected, options.sphere}, execution};
  const bool has_split = options.crossings == ConstraintCrossings::split && !constraints.empty();
  if (!has_split) {
    api::validate(job, sites.size());
    return constrained::constrain(sites, constraints, nullptr, job);
  }
  if (!(options.sphere.center == Point{})) {
    throw InvalidInput("crossings of constraints are split around the origin only");
  }
  api::validate_some(sites.points(), job, 0);
  constrained::require_arcs(sites.points(), constraints, options.sphere);
  const auto split = constrained::split_constraints(sites, constraints, execution);
  api::validate(job, split.sites.size());
  return constrained::constrain(split.sites, split.ends, &split.sources, job);
}

}  // namespace rondel
