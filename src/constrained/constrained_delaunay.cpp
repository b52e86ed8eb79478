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

// True if most of the constraints begin near the one before, as those of a line do, in space and in
// memory.
bool are_near_each_other(const ConstrainedFaces& faces, std::span<const Ends> ends) {
  constexpr std::size_t num_tried = 1024;
  constexpr Index near = 256;
  const auto is_near = [](Index i, Index j) { return std::max(i, j) - std::min(i, j) < near; };
  const std::size_t stride = std::max<std::size_t>(ends.size() / num_tried, 1);
  std::size_t num_near = 0;
  std::size_t num_pairs = 0;
  for (std::size_t i = 1; i < ends.size(); i += stride) {
    const Index before = ends[i - 1][0];
    const Index name = ends[i][0];
    num_near +=
        is_near(before, name) && is_near(faces.rank_of(before), faces.rank_of(name)) ? 1 : 0;
    ++num_pairs;
  }
  return 2 * num_near >= num_pairs;
}

// Inserts constraints between names.
class Insertion {
 public:
  Insertion(ConstrainedFaces& faces, std::span<const Ends> ends, const system::Job& job)
      : faces_(faces), ends_(ends), job_(job) {}

  // Inserts all, or returns two that cross.
  std::optional<Ends> run() {
    std::vector<ConstrainedPiece> others;
    const bool are_near = are_near_each_other(faces_, ends_);
    if (are_near) {
      constrain_edges(others);
    } else {
      list_by_ranks(others);
    }
    divided_.reserve(others.size());
    for (const ConstrainedPiece& other : others) divided_.push_back(other.constraint);
    constexpr std::size_t few = 32;  // sites for each constraint
    if (!are_near || others.size() > faces_.num_sites() / few) {
      faces_.number_by_rank(job_.threads);
    }
    // Neighbors in the order of ranks are close to each other; so a long constraint finds few short
    // ones that were inserted far away, and memory that is known.
    sort_by_ends(others, faces_.num_sites());
    for (std::size_t k = 0; k < others.size(); ++k) {
      pause_at(ends_.size() - others.size() + k);
      if (const auto crossed = faces_.insert(others[k], pieces_)) {
        return Ends{others[k].constraint, constraint_of(*crossed)};
      }
    }
    return {};
  }

  [[nodiscard]] PiecesOfConstraints pieces() const { return {ends_, divided_, pieces_}; }

 private:
  static constexpr std::size_t pause = 4096;  // constraints

  void pause_at(std::size_t inserted) const {
    if (inserted % pause != 0) return;
    system::obey_stop();
    system::announce(job_, "constrain", inserted, ends_.size());
  }

  // Appends the constraints that are not known to be edges, by ranks.
  void constrain_edges(std::vector<ConstrainedPiece>& others) {
    for (std::size_t i = 0; i < ends_.size(); i += pause) {
      pause_at(i);
      const auto some = ends_.subspan(i, std::min(pause, ends_.size() - i));
      faces_.constrain_edges(some, static_cast<Index>(i), others);
    }
  }
  void list_by_ranks(std::vector<ConstrainedPiece>& arcs) const {
    arcs.reserve(ends_.size());
    for (Index i = 0; i < ends_.size(); ++i) {
      arcs.push_back(piece_between(faces_.rank_of(ends_[i][0]), faces_.rank_of(ends_[i][1]), i));
    }
  }

  // Returns a constraint that an edge between two names is a piece of.
  [[nodiscard]] Index constraint_of(const Ends& edge) const {
    const ConstrainedPiece wanted = piece_between(edge[0], edge[1], 0);
    for (const ConstrainedPiece& piece : pieces_) {
      if (piece.low == wanted.low && piece.high == wanted.high) return piece.constraint;
    }
    const auto whole = std::ranges::find_if(ends_, [&](const Ends& ends) {
      return std::minmax(ends[0], ends[1]) == std::minmax(wanted.low, wanted.high);
    });
    return static_cast<Index>(whole - ends_.begin());
  }

  ConstrainedFaces& faces_;
  std::span<const Ends> ends_;
  const system::Job& job_;
  std::vector<Index> divided_;  // all others are edges
  std::vector<ConstrainedPiece> pieces_;
};

// Throws with the place where two constraints cross.
void refuse(const Ends& crossing, std::span<const Ends> ends, const NamedSites& sites,
            const Sphere& sphere) {
  const auto [low, high] = std::minmax(crossing[0], crossing[1]);
  const auto arc = [&](Index i) {
    return std::array{sites.point(ends[i][0]), sites.point(ends[i][1])};
  };
  throw CrossingConstraints(low, high, place_of_crossing(arc(low), arc(high), sphere));
}

ConstrainedTriangulation constrain(const Sites& sites, std::span<const Ends> constraints,
                                   const CompressedRows<Index>* sources, const system::Job& job) {
  api::Parts built = api::build_parts(sites.points(), job);
  // Whoever gives crossings to be split has proved this before.
  if (sources == nullptr) require_arcs(sites.points(), constraints, job.sphere);
  const NamedSites named(sites.points(), built.arrays.duplicates);
  std::vector<Ends> renamed;
  if (!built.arrays.duplicates.empty()) {
    renamed.reserve(constraints.size());
    for (const auto& [a, b] : constraints) renamed.push_back({named.name(a), named.name(b)});
  }
  const std::span<const Ends> ends = renamed.empty() ? constraints : renamed;
  ConstrainedTriangulation result;
  const bool has_edges = built.arrays.dimension == 2 && !ends.empty();
  if (has_edges) {
    ConstrainedFaces faces(sites.points(), built, job.sphere, job.threads);
    Insertion insertion(faces, ends, job);
    if (const auto crossing = insertion.run()) refuse(*crossing, ends, named, job.sphere);
    list_edges(insertion.pieces(), sites.size(), sources, result);
    faces.give_back(job.threads, built.arrays, result.sides);
    if (faces.has_changes()) {
      result.triangulation = with_faces(sites, std::move(built.arrays), job, built.report);
      system::announce(job, "constrain", 1);
      return result;
    }
  }
  result.triangulation = api::make_triangulation(sites, std::move(built.arrays), job, built.report);
  if (!has_edges) {
    result.sides.resize(result.triangulation.num_faces());
    list_edges({{}, {}, pieces_on_ring(result.triangulation, named, ends)}, sites.size(), sources,
               result);
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
