// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

/// \file
/// Linear interpolation in the faces of a constrained triangulation (target rondel::geo).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/export.h"
#include "rondel/interpolate.h"
#include "rondel/types.h"
#include "rondel/weights.h"

namespace rondel {

/// The options of InterpolationOptions that linear interpolation has.
struct LinearOptions {
  Outside outside = Outside::missing;
  SharedPlace shared_place = SharedPlace::first;
  Normalization normalization = Normalization::unity;
  bool hashes = true;  ///< whether weights() computes the hashes of sites and targets
};

/// Interpolates values at the sites of a constrained triangulation linearly in its own faces: the
/// value at a target comes from the corners of the face that has it, none of which is beyond a
/// constraint. So no value is mixed across a coast, a ridge or a fault, and along a constraint the
/// values are those between its sites alone.
///
/// 1. Weights are those of Method::linear (Interpolator, rules 1 to 5), of constrained faces. Where
///    all faces are Delaunay, the bytes are those of an Interpolator.
/// 2. The values are continuous, across constraints too, where they have a crease at most.
/// 3. The bytes are the same on every machine, for any number of threads, and for every order of
///    the constraints, and of the sites that keeps the order of sites in one place.
/// 4. Sites that ConstraintCrossings::split has added are sites as all others, and need values.
/// 5. Any number of threads may use one object at once. An object that was moved from can only be
///    assigned to or destroyed.
///
/// The expected time for each target of a large range is that of a ConstrainedLocator. The memory
/// is 150 bytes for each vertex; Outside::nearest computes delaunay() of the sites, once, which
/// takes as much again.
class RONDEL_API ConstrainedInterpolator {
 public:
  /// Prepares a triangulation, whose sites are kept, in O(n).
  /// \param result  what constrained_delaunay() returned, or a snapshot has; no face is proved
  /// \throws InvalidInput if `sides` does not have an entry for each face
  explicit ConstrainedInterpolator(const ConstrainedTriangulation& result);
  ~ConstrainedInterpolator();
  ConstrainedInterpolator(ConstrainedInterpolator&& other) noexcept;
  ConstrainedInterpolator& operator=(ConstrainedInterpolator&& other) noexcept;

  /// Returns the weights: one row for each target, one column for each site.
  /// \throws InvalidInput as Interpolator::weights() does
  [[nodiscard]] Weights weights(std::span<const Point> targets, const LinearOptions& options = {},
                                const Execution& execution = {}) const;

  /// Returns the values of fields at the targets, shape (num_fields, targets), as
  /// Interpolator::values() does.
  /// \param field  values at the sites, shape (num_fields, n)
  /// \throws InvalidInput also if the length of `field` is not a positive multiple of n
  [[nodiscard]] std::vector<double> values(std::span<const double> field,
                                           std::span<const Point> targets,
                                           const LinearOptions& options = {},
                                           const Execution& execution = {}) const;

  class Impl;

 private:
  std::unique_ptr<const Impl> impl_;
};

}  // namespace rondel
