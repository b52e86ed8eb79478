// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights of natural neighbors (Sibson 1981; Christ, Friedberg, Lee 1982) on the sphere. The
// natural neighbors of a target are the sites whose Voronoi cells would lose a part to the target's
// cell; Sibson's weight of a neighbor is its share of that cell, Laplace's the ratio of the common
// side to the distance. docs/theory/interpolation.md proves the statements below.
//
// in    targets with their locations
// out   rows of weights
// index spatial ranks of vertices
//
// 1. The weights are not negative and sum up to 1; the sum of weights times sites is on the ray of
//    u (except for planar_sibson).
// 2. They are within 1e-13 of the weights in exact arithmetic, wherever the sites are.
// 3. They are continuous in u: how ties are broken changes them by rounding errors only.
// 4. A row is counterclockwise, begins with the lowest vertex, and has no weight that is exactly
//    zero.
#pragma once

#include <vector>

#include "interpolation/natural_cell.h"
#include "interpolation/natural_exact.h"
#include "interpolation/natural_region.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"

namespace rondel::interpolation {

class NaturalKernel {
 public:
  NaturalKernel(const PreparedTriangulation& prepared, NaturalMethod method)
      : prepared_(prepared), method_(method), region_(prepared) {}

  void operator()(const LocatedTarget& place, Row& row);

 private:
  template <class T>
  [[nodiscard]] double weigh(NaturalCell<T>& cell);
  // Computes the shares in one arithmetic; each returns false if the error may be too large.
  [[nodiscard]] bool weigh_in_doubles(const LocatedTarget& place);
  [[nodiscard]] bool weigh_from_split_points(const LocatedTarget& place);
  [[nodiscard]] bool weigh_exactly(const LocatedTarget& place);
  void add_shares(Row& row) const;

  const PreparedTriangulation& prepared_;
  NaturalMethod method_;
  NaturalRegion region_;
  NaturalCell<double> cell_;
  NaturalCell<exact::DoubleDouble> wide_cell_;
  std::vector<Point> sites_;
  std::vector<double> shares_;
};

class LaplaceKernel : public NaturalKernel {
 public:
  explicit LaplaceKernel(const PreparedTriangulation& prepared)
      : NaturalKernel(prepared, NaturalMethod::laplace) {}
};

class SibsonKernel : public NaturalKernel {
 public:
  explicit SibsonKernel(const PreparedTriangulation& prepared)
      : NaturalKernel(prepared, NaturalMethod::sibson) {}
};

// Sibson's method in the stereographic plane, for interpolation with gradients (hermite.h).
class PlanarSibsonKernel : public NaturalKernel {
 public:
  explicit PlanarSibsonKernel(const PreparedTriangulation& prepared)
      : NaturalKernel(prepared, NaturalMethod::planar_sibson) {}
};

}  // namespace rondel::interpolation
