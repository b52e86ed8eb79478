// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Spherical centroidal Voronoi tessellations (SCVT), in which each site is the centroid of its
/// cell.
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

/// The state of the iteration after a step, or at the start of a level.
struct ScvtStep {
  std::size_t sites = 0;  ///< the number of sites of the level
  int iteration = 0;      ///< counts within the level; 0 at its start
  double energy = 0;      ///< the integral of density times squared distance from the nearest site
  /// The mean and the largest distance of a site from the centroid of its cell, divided by the
  /// spacing of hexagons with the cell's area.
  double mean_offset = 0;
  double largest_offset = 0;
  /// An estimate of the share of the work of all levels that is done. It never decreases, and is 1
  /// when the last level has reached its tolerances or its number of steps.
  double done = 0;
};

/// The reasons why the iteration ended.
enum class ScvtEnd : std::uint8_t {
  converged,   ///< both offsets, or the change of energy, are within their tolerances
  iterations,  ///< the largest number of iterations was reached
  stopped,     ///< Execution::stop was set
  stuck,       ///< no step lowers the energy: it is as low as rounding allows
};

/// Returns the name of a value: "converged", "iterations" ...
RONDEL_API std::string_view name_of(ScvtEnd end) noexcept;

enum class ScvtMethod : std::uint8_t {
  /// Yang, Gunzburger and Ju, J. Comput. Phys. 367, 2018, started with springs along the edges
  lbfgs,
  lloyd,  ///< moves every site to its centroid; for comparison
};

/// Returns the name of a value: "lbfgs", "lloyd"; empty for other numbers.
RONDEL_API std::string_view name_of(ScvtMethod method) noexcept;

/// A function that is called at the start of a level and after every step.
using ScvtCallback = std::function<void(const ScvtStep&)>;

struct ScvtOptions {
  std::size_t count = 0;               ///< the number of sites; 0: size->count(), rounded
  std::optional<SizeFunction> size{};  ///< the wanted spacing; empty: the same everywhere
  /// The iteration ends when the mean and the largest offset are at most these.
  double mean_tolerance = 1e-4;
  double largest_tolerance = 1e-2;
  /// The iteration also ends when a step lowers the energy by less than this share of it; 0
  /// disables that.
  double energy_tolerance = 0;
  int max_iterations = 1000;  ///< in each level
  ScvtMethod method = ScvtMethod::lbfgs;
  bool repair = true;  ///< whether to move sites to remove ScvtDefects
  /// Places that are sites in any case: unit vectors bit by bit, other vectors in their direction.
  /// Each takes the nearest site that no place before has taken when the last level begins. They
  /// never move, and count among the sites; offsets are those of the other sites.
  std::span<const Point> fixed{};
  ScvtCallback on_step{};
};

/// Defects that stop a model, or make it inaccurate.
struct ScvtDefects {
  std::size_t odd_cells = 0;    ///< cells that do not have 5, 6 or 7 sides
  std::size_t short_edges = 0;  ///< edges shorter than 0.0505 times the distance of their cells
  std::size_t obtuse_triangles = 0;
  double min_edge_ratio = 0;  ///< the smallest length of an edge over the distance of its cells
};

/// The repair of defects where rows of cells end: sites are moved off their centroids by as little
/// as removes the defects. That is hundredths of the spacing, and at most 0.15 of the length of an
/// edge, or 0.45 if defects are left. `after` has the defects that are left.
struct ScvtRepair {
  ScvtDefects before{};
  ScvtDefects after{};
  int rounds = 0;
  std::size_t moved = 0;  ///< the number of sites that were moved
};

struct Scvt {
  std::vector<Point> sites;  ///< unit vectors; neighbors are close together in the list
  std::vector<Index> fixed;  ///< the site of each fixed place
  ScvtEnd end = ScvtEnd::converged;
  ScvtStep last{};         ///< the last step before the repair
  ScvtRepair repair{};     ///< empty unless the iteration converged or is stuck
  std::size_t builds = 0;  ///< the number of triangulations of all sites
  std::size_t flips = 0;   ///< the number of edges that were flipped instead
};

/// Computes a tessellation of `count` sites, by levels: a coarse one is solved, gets a site in the
/// middle of every edge, and is solved again. With 10 * 4^k + 2 sites and no `size` the coarsest is
/// the icosahedron.
///
/// 1. The bytes are the same on every machine and for every number of threads.
/// 2. The energy never increases from step to step, except by the repair at the end.
/// 3. If Execution::stop becomes true, the sites of the present level are returned as they are;
///    nothing is thrown.
/// \throws InvalidInput if the count is below 12 or above max_sites; if there are more fixed places
///         than sites, or (its index) a place is not finite, is the center, or is where another one
///         is.
RONDEL_API Scvt scvt(const ScvtOptions& options, const Execution& execution = {});

/// Relaxes given sites, in their order; `count` is ignored. A site that is among the fixed places
/// stays.
/// \throws InvalidInput (first bad index) if a site is not finite or is the center; if there are
///         duplicates, or the sites do not surround the center.
RONDEL_API Scvt relax(std::span<const Point> sites, const ScvtOptions& options = {},
                      const Execution& execution = {});

/// Returns the energy of n sites of constant density divided by that of as many regular hexagons of
/// the plane, 5 (4 pi)^2 / (18 sqrt(3) n), which it never reaches.
RONDEL_API double energy_over_hexagons(double energy, std::size_t num_sites) noexcept;

}  // namespace rondel::mesh
