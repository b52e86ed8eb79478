// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Natural neighbor interpolation with gradients. With Sibson's weights m_i in the stereographic
// plane of the target u, and c_i = x_i.u,
//
//     f(u) = sum of m_i (f_i + g_i.u / (1 + c_i)).
//
// It reproduces 1, x, y and z if the gradients are exact. In the plane, x_i lies at p_i = 2 (x_i -
// c_i u) / (1 + c_i), and the sum of m_i p_i is 0. For f = h.x, g_i = h - (h.x_i) x_i, so the term
// in parentheses is h.x_i + (h.u - c_i h.x_i) / (1 + c_i) = h.(x_i + u) / (1 + c_i) = h.p_i / 2 +
// h.u.
//
// in    targets with their locations, and which vertices have a gradient
// out   rows of weights of values and of gradients
// index spatial ranks of vertices
#pragma once

#include <cstdint>
#include <span>

#include "interpolation/natural.h"
#include "interpolation/prepared_triangulation.h"
#include "interpolation/row.h"
#include "rondel/interpolate.h"

namespace rondel::interpolation {

// Where a neighbor has no gradient, the row is that of Sibson's method without gradients.
class HermiteKernel {
 public:
  // `has_gradient` says for each vertex whether it has a gradient; it is empty if all have one. The
  // normalization matters only where the row has no gradients, as the formula above reproduces 1,
  // x, y and z.
  explicit HermiteKernel(const PreparedTriangulation& prepared,
                         std::span<const std::uint8_t> has_gradient = {},
                         Normalization normalization = Normalization::unity)
      : prepared_(prepared),
        planar_(prepared),
        sibson_(prepared),
        has_gradient_(has_gradient),
        normalization_(normalization) {}

  void operator()(const LocatedTarget& place, GradientRow& row);

 private:
  // True if each vertex of the planar row has a gradient.
  [[nodiscard]] bool all_have_gradients() const;
  void weigh_on_contour(const LocatedTarget& place);
  // Sets the row to that of Sibson's method.
  void add_without_gradients(const LocatedTarget& place, GradientRow& row);

  const PreparedTriangulation& prepared_;
  PlanarSibsonKernel planar_;
  SibsonKernel sibson_;
  std::span<const std::uint8_t> has_gradient_;
  Normalization normalization_;
  Row flat_;
};

}  // namespace rondel::interpolation
