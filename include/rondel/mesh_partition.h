// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Cells of prescribed areas around sites that stay where they are.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/export.h"
#include "rondel/types.h"

namespace rondel::mesh {

enum class PartitionEnd : std::uint8_t {
  converged,   ///< all areas are as wanted
  rounded,     ///< as near as coordinates that are doubles bring them
  iterations,  ///< there were too many steps
  infeasible,  ///< no weights give these areas, or none are found: AreaPartition::reason
  stopped,     ///< Execution::stop
};

/// "converged", "rounded" ...
RONDEL_API std::string_view name_of(PartitionEnd end) noexcept;

struct PartitionStep {
  int step = 0;
  double largest_error = 0;  ///< of |area - wanted| / wanted
  double length = 1;         ///< of the step over that of Newton's
};

/// Called before each step and at the end.
using PartitionSeen = std::function<void(const PartitionStep&)>;

struct AreaPartitionOptions {
  double tolerance = 1e-12;  ///< the largest error
  int max_steps = 100;
  PartitionSeen seen{};
};

struct AreaPartition {
  /// The smallest is 1: each stands for a circle, of radius arccos(1 / weight).
  std::vector<double> weights;
  /// Weighted sites (Model::weighted) whose power cells have the areas. They have the directions of the sites, to 1e-13, and
  /// the lengths of the weights, but nearer than doubles have those: rounding alone would move areas of a million
  /// cells by 1e-10. A few spacings from the ends of the three axes coordinates cannot have all lengths.
  std::vector<Point> poles;
  std::vector<double> radii_deg;  ///< of the circles
  std::vector<double> areas;
  double largest_error = 0;
  Index worst = no_index;  ///< the site that has it
  int steps = 0;
  PartitionEnd end = PartitionEnd::converged;
  std::string reason;  ///< why what is infeasible is so, in a clause; otherwise empty
};

/// Weights for which the power cell of site i has the area targets[i]; without targets all are equal. This is
/// Alexandrov's problem of polyhedra with given curvatures, and that of optimal transport for the cost
/// -log(x.q); the walls are arcs of great circles. Newton's method, damped so that no cell vanishes (Kitagawa,
/// Merigot, Thibert, J. Eur. Math. Soc. 21, 2019), from equal weights.
///
/// 1. The same bytes on every machine and for every number of threads.
/// 2. Where the sites surround the center of the sphere, such weights are unique but for a common factor.
/// 3. The cells of sites on a great circle are lunes; their weights follow from the areas directly, without steps. One site has the
///    whole sphere, and each of two sites a hemisphere.
/// 4. What is infeasible ends as such: `reason` says why, and `worst` where it shows. Other sites that do not surround the
///    center are, since weights are not looked for there.
/// \throws InvalidInput (first bad index) if there are no sites, one is not finite or the center, or two
///         are in one place; if targets are not one for each site, not positive, or do not add up to 4 pi within 1e-6
///         of it (they are scaled to that).
RONDEL_API AreaPartition area_partition(std::span<const Point> sites,
                                        std::span<const double> targets = {},
                                        const AreaPartitionOptions& options = {},
                                        const Execution& execution = {});

}  // namespace rondel::mesh
