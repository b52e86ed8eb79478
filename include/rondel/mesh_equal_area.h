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

/// Why the iteration ended.
enum class EqualAreaEnd : std::uint8_t {
  converged,   ///< all areas are within the tolerance
  rounded,     ///< the areas are as near to the targets as coordinates in doubles allow
  iterations,  ///< the largest number of steps was reached
  infeasible,  ///< no weights give these areas, or none were found: EqualArea::reason
  stopped,     ///< Execution::stop was set
};

/// Returns the name of a value: "converged", "rounded" ...
RONDEL_API std::string_view name_of(EqualAreaEnd end) noexcept;

/// The state of the iteration after a step.
struct EqualAreaStep {
  int step = 0;
  double largest_error = 0;  ///< the largest |area - target| / target
  double length = 1;         ///< the length of the step, as a multiple of Newton's step
};

/// A function that is called before each step and at the end.
using EqualAreaCallback = std::function<void(const EqualAreaStep&)>;

struct EqualAreaOptions {
  double tolerance = 1e-12;  ///< the largest relative error of an area
  int max_steps = 100;
  EqualAreaCallback on_step{};
};

/// The result of equal_area(): weights of the sites, with their cells' areas.
struct EqualArea {
  /// The weights, of which the smallest is 1. A weight stands for a circle of radius arccos(1 /
  /// weight).
  std::vector<double> weights;
  /// The weighted sites (Model::weighted) whose power cells have the areas. They have the
  /// directions of the sites, up to 1e-13, and the lengths of the weights, but more exactly than
  /// doubles represent these: rounding alone would change the areas of a million cells by 1e-10.
  /// Within a few spacings of the ends of the three axes, coordinates cannot represent all lengths.
  std::vector<Point> poles;
  std::vector<double> radii_deg;  ///< the radii of the circles, less than 90
  std::vector<double> areas;
  double largest_error = 0;
  Index worst = no_index;  ///< the site with the largest error
  int steps = 0;
  EqualAreaEnd end = EqualAreaEnd::converged;
  std::string reason;  ///< a clause that says why the problem is infeasible; otherwise empty
};

/// Computes weights for which the power cell of site i has the area targets[i], or all cells have
/// equal areas if there are no targets. This is Alexandrov's problem of polyhedra with given
/// curvatures, and optimal transport with the cost -log(x.q); the sides of cells are arcs of great
/// circles. The method is Newton's, damped so that no cell vanishes (Kitagawa, Merigot, Thibert, J.
/// Eur. Math. Soc. 21, 2019), and starts with equal weights.
///
/// 1. The bytes are the same on every machine and for every number of threads.
/// 2. If the sites surround the center of the sphere, such weights are unique up to a common
///    factor.
/// 3. The cells of sites on a great circle are lunes, whose weights follow from the areas without
///    iteration. A single site has the whole sphere, and each of two sites a hemisphere.
/// 4. An infeasible problem ends as such: `reason` says why, and `worst` is a site that shows it.
///    Other sites that do not surround the center are infeasible, since weights are not searched
///    for there.
/// \param targets  steradians, one for each site; they are scaled to a sum of 4 pi
/// \throws InvalidInput (first bad index) if there are no sites, a site is not finite or is the
///         center, or two sites are in one place; if there is not one target for each site, a
///         target is not positive, or they do not add up to 4 pi within 1e-6 of it.
RONDEL_API EqualArea equal_area(std::span<const Point> sites, std::span<const double> targets = {},
                                const EqualAreaOptions& options = {},
                                const Execution& execution = {});

}  // namespace rondel::mesh
