// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Spherical centroidal Voronoi tessellations (SCVT): sites moved until each is the centroid of its cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/mesh_size.h"
#include "rondel/types.h"

namespace rondel::mesh {

/// After a step, or at the start of a level.
struct ScvtStep {
  std::size_t sites = 0;  ///< of the level
  int iteration = 0;      ///< within the level; 0: its start
  double energy = 0;      ///< the integral of density times squared distance from the nearest site
  /// Distances of sites from the centroids of their cells over the spacing of hexagons with the cell's
  /// area: the mean and the largest.
  double mean_offset = 0;
  double largest_offset = 0;
  /// An estimate of the part of the work of all levels that is done. It never falls, and is 1 when the last level has reached its
  /// tolerances or its number of steps.
  double done = 0;
};

/// Why the work ended.
enum class ScvtEnd : std::uint8_t {
  converged,   ///< within both tolerances, or the change of energy
  iterations,  ///< there were too many
  stopped,     ///< Execution::stop
  stuck,       ///< no step lowers the energy: it is as low as rounding allows
};

/// "converged", "iterations" ...
RONDEL_API std::string_view name_of(ScvtEnd end) noexcept;

enum class ScvtMethod : std::uint8_t {
  lbfgs,  ///< Yang, Gunzburger and Ju, J. Comput. Phys. 367, 2018, begun with springs along the edges
  lloyd,  ///< every site to its centroid, to compare
};

/// Called at the start of a level and after every step.
using ScvtSeen = std::function<void(const ScvtStep&)>;

struct ScvtOptions {
  std::size_t count = 0;               ///< of sites; 0: size->count(), rounded
  std::optional<SizeFunction> size{};  ///< none: the same spacing everywhere
  /// The work ends when the mean and the largest offset are no more than these.
  double mean_tolerance = 1e-4;
  double largest_tolerance = 1e-2;
  /// Or when a step lowers the energy by less than this part of it; 0: never.
  double energy_tolerance = 0;
  int max_iterations = 1000;  ///< in each level
  ScvtMethod method = ScvtMethod::lbfgs;
  bool repair = true;  ///< move sites where ScvtDefects are left
  /// Places that always are sites, unit vectors bit by bit, others as such: each takes the site that is nearest when
  /// the last level begins, and that none has taken before. They never move, and count among the sites; offsets are
  /// those of the others.
  std::span<const Point> fixed{};
  ScvtSeen seen{};
};

/// What a model does not run on, or badly.
struct ScvtDefects {
  std::size_t odd_cells = 0;    ///< with other than 5, 6 or 7 sides
  std::size_t short_edges = 0;  ///< shorter than 0.0505 of the distance of their cells
  std::size_t obtuse_triangles = 0;
  double least_edge_ratio = 0;  ///< the shortest edge over the distance of its cells
};

/// Where rows of cells end, sites are moved off their centroids by as little as mends these defects: hundredths
/// of the spacing, never more than 0.15 of the length of an edge, or, where that leaves something, 0.45. What is left is
/// told.
struct ScvtRepair {
  ScvtDefects before{};
  ScvtDefects after{};
  int rounds = 0;
  std::size_t moved = 0;  ///< sites
};

struct Scvt {
  std::vector<Point> sites;  ///< unit vectors, close ones close together
  std::vector<Index> fixed;  ///< the site of each of the fixed places
  ScvtEnd end = ScvtEnd::converged;
  ScvtStep last{};         ///< before the repair
  ScvtRepair repair{};     ///< of what has converged, or is stuck; else empty
  std::size_t builds = 0;  ///< triangulations of all sites
  std::size_t flips = 0;   ///< edges that were exchanged instead
};

/// A tessellation of `count` sites, by levels: a coarse one is solved, gets a site in the middle of every
/// edge, and is solved again. With 10 * 4^k + 2 sites and no `size` the coarsest is the icosahedron.
///
/// 1. The same bytes on every machine and for every number of threads.
/// 2. The energy never grows from step to step, but by the repair at the end.
/// 3. Where Execution::stop becomes true, the sites of the present level are returned as they are; it throws
///    nothing.
/// \throws InvalidInput if the count is below 12 or above max_sites; if there are more fixed places than sites, or (its
///         index) one is not finite, the center, or where another one is.
RONDEL_API Scvt scvt(const ScvtOptions& options, const Execution& execution = {});

/// The same from sites of one's own, in their order, whose `count` is theirs. A site that is among the fixed places stays.
/// \throws InvalidInput (first bad index) if a site is not finite or the center; if there are
///         duplicates, or the sites do not surround the center.
RONDEL_API Scvt relaxed(std::span<const Point> sites, const ScvtOptions& options = {},
                        const Execution& execution = {});

/// The energy of n sites of constant density over that of as many regular hexagons of the plane, which it
/// never reaches: 5 (4 pi)^2 / (18 sqrt(3) n).
RONDEL_API double energy_over_hexagons(double energy, std::size_t num_sites) noexcept;

}  // namespace rondel::mesh
