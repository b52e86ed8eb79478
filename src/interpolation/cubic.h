// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cubic interpolation: reproduces the values and gradients at the sites, has a continuous gradient
// and converges with order 4. Each face has a spherical Clough-Tocher element S (Alfeld, Neamtu,
// Schumaker, J. Comput. Appl. Math. 73, 1996), divided by what S gives for the constant 1;
// docs/theory/cubic.md derives it.
//
// in    targets with their locations, and which vertices have a gradient
// out   rows of weights of values and of gradients
// index spatial ranks of vertices
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "interpolation/cubic_faces.h"
#include "interpolation/linear.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "rondel/interpolate.h"

namespace rondel::interpolation {

// A row has the corners of the face, beginning with the lowest rank, and then the vertices opposite
// to its edges.
//
// Several targets are computed at once: call begin(), then expect() for some lanes, then operator()
// for these lanes. Which targets share lanes changes no result.
//
// Interpolation is linear in faces with a side of more than about 90 degrees, where S of 1 may
// vanish, in faces smaller than 1e-60, and in faces with a corner that has no gradient.
class CubicKernel {
 public:
  static constexpr std::size_t group = CubicFaces::lanes;

  // `has_gradient` says for each vertex whether it has a gradient; it is empty if all have one.
  // With Normalization::homogeneous, S is not divided.
  explicit CubicKernel(const PreparedTriangulation& prepared,
                       std::span<const std::uint8_t> has_gradient = {},
                       Normalization normalization = Normalization::unity)
      : prepared_(prepared),
        linear_(prepared),
        has_gradient_(has_gradient),
        normalization_(normalization) {}

  // Adds a target on an edge or in a face to a lane.
  void expect(std::size_t lane, const LocatedTarget& place);
  void operator()(std::size_t lane, const LocatedTarget& place, GradientRow& row);
  void operator()(const LocatedTarget& place, GradientRow& row) {
    begin();
    expect(0, place);
    (*this)(0, place, row);
  }
  // Forgets all lanes.
  void begin() { are_weighed_ = false; }

 private:
  // The data that expect() has found for a lane.
  struct Lane {
    Row flat;  // the linear weights of the target
    std::array<Index, 6> vertices{};
    bool has_gradients = false;
  };

  [[nodiscard]] bool has_gradient(Index v) const {
    return has_gradient_.empty() || has_gradient_[v] != 0;
  }
  // Sets the vertices of the lane; returns false if one of the corners has no gradient.
  bool find_corners(std::size_t lane, const LocatedTarget& place);
  // Sets the row by the element; returns false if that is not to be used in this face.
  bool weigh(std::size_t lane, GradientRow& row) const;
  // Sets the row to the linear weights `flat`, without gradients.
  void add_linear(const LocatedTarget& place, const Row& flat, GradientRow& row) const;

  const PreparedTriangulation& prepared_;
  LinearKernel linear_;
  std::span<const std::uint8_t> has_gradient_;
  Normalization normalization_;

  std::array<Lane, group> lanes_;
  CubicFaces faces_;
  bool are_weighed_ = false;
};

}  // namespace rondel::interpolation
