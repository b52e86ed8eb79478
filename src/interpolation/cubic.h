// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Cubic interpolation: values and gradients at the sites met, the gradient continuous everywhere, order
// 4. In each face a spherical Clough-Tocher element S (Alfeld, Neamtu, Schumaker, J. Comput. Appl. Math.
// 73, 1996), divided by what S makes of the constant one; docs/theory/cubic.md derives it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "interpolation/cubic_faces.h"
#include "interpolation/ground.h"
#include "interpolation/linear.h"
#include "interpolation/row.h"
#include "rondel/interpolate.h"

namespace rondel::interpolation {

// A row has the corners of the face, from the lowest rank, and then the vertices opposite to its edges.
//
// Targets are worked on several at once: begin(), expect() of some lanes, and then their rows.
// Which targets share lanes changes nothing.
//
// In faces with a side above 90 degrees or so, where S of one may vanish, in those smaller than
// 1e-60 and in those with a corner that has no gradient, it is linear.
class CubicKernel {
 public:
  static constexpr std::size_t group = CubicFaces::lanes;

  // `has_gradient` of each vertex; empty if all have one. Normalization::homogeneous: S undivided.
  explicit CubicKernel(const Ground& ground, std::span<const std::uint8_t> has_gradient = {},
                       Normalization normalization = Normalization::unity)
      : ground_(ground),
        linear_(ground),
        has_gradient_(has_gradient),
        normalization_(normalization) {}

  // `place` is on an edge or in a face.
  void expect(std::size_t lane, const TargetPlace& place);
  void operator()(std::size_t lane, const TargetPlace& place, SlopeRow& row);
  void operator()(const TargetPlace& place, SlopeRow& row) {
    begin();
    expect(0, place);
    (*this)(0, place, row);
  }
  // Forgets all lanes.
  void begin() { are_weighed_ = false; }

 private:
  // What is expected of a lane.
  struct Lane {
    Row flat;  // the linear weights
    std::array<Index, 6> vertices{};
    bool has_gradients = false;
  };

  [[nodiscard]] bool has_gradient(Index v) const {
    return has_gradient_.empty() || has_gradient_[v] != 0;
  }
  // False if one of them has no gradient.
  bool find_corners(std::size_t lane, const TargetPlace& place);
  bool weigh(std::size_t lane, SlopeRow& row) const;
  void add_linear(const TargetPlace& place, const Row& flat, SlopeRow& row) const;

  const Ground& ground_;
  LinearKernel linear_;
  std::span<const std::uint8_t> has_gradient_;
  Normalization normalization_;

  std::array<Lane, group> lanes_;
  CubicFaces faces_;
  bool are_weighed_ = false;
};

}  // namespace rondel::interpolation
