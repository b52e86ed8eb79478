// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights by natural neighbors (Sibson 1981; Christ, Friedberg, Lee 1982), on the sphere: those sites
// whose cells a target would take a part of, weighed by what its cell has in common with theirs.
// docs/theory/interpolation.md proves what is said here.
//
// 1. The weights are not negative and sum up to 1; the sum of weights times sites is on the ray of u
//    (not of the planar ones).
// 2. They are within 1e-13 of those of exact arithmetic, wherever the sites are.
// 3. They are continuous in u: how ties are broken has no effect but rounding errors.
// 4. A row is counterclockwise from the lowest vertex, without weights that are exactly zero.
#pragma once

#include <vector>

#include "interpolation/ground.h"
#include "interpolation/natural_cell.h"
#include "interpolation/natural_exact.h"
#include "interpolation/natural_region.h"
#include "interpolation/row.h"

namespace rondel::interpolation {

class NaturalKernel {
 public:
  NaturalKernel(const Ground& ground, NaturalMethod method)
      : ground_(ground), method_(method), region_(ground) {}

  void operator()(const TargetPlace& place, Row& row);

 private:
  template <class T>
  [[nodiscard]] double weigh(NaturalCell<T>& cell);
  // Whether the error is small enough.
  [[nodiscard]] bool weigh_in_doubles(const TargetPlace& place);
  [[nodiscard]] bool weigh_from_split_points(const TargetPlace& place);
  [[nodiscard]] bool weigh_exactly(const TargetPlace& place);
  void add_shares(Row& row) const;

  const Ground& ground_;
  NaturalMethod method_;
  NaturalRegion region_;
  NaturalCell<double> cell_;
  NaturalCell<exact::DoubleDouble> wide_cell_;
  std::vector<Point> sites_;
  std::vector<double> shares_;
};

class LaplaceKernel : public NaturalKernel {
 public:
  explicit LaplaceKernel(const Ground& ground) : NaturalKernel(ground, NaturalMethod::laplace) {}
};

class SibsonKernel : public NaturalKernel {
 public:
  explicit SibsonKernel(const Ground& ground) : NaturalKernel(ground, NaturalMethod::sibson) {}
};

// For interpolation with gradients.
class PlanarSibsonKernel : public NaturalKernel {
 public:
  explicit PlanarSibsonKernel(const Ground& ground)
      : NaturalKernel(ground, NaturalMethod::planar_sibson) {}
};

}  // namespace rondel::interpolation
