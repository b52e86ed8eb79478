// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The first part of a local fit: the neighbors of a site in its stereographic plane, their weights,
// and the linear change of coordinates that makes the cloud of neighbors round.
//
// in    for each lane a site and the steps to its neighbors
// out   for each lane coordinates (a, b) and weights of the neighbors
// index lanes, each with one site; neighbors in the order of the steps
#pragma once

#include <cmath>
#include <cstddef>

#include "interpolation/fit_lanes.h"

namespace rondel::interpolation::fits {

// The radius at which weights become 0, in units of the distance of the farthest neighbor.
inline constexpr double reach = 1.2;

// Weights do not grow further within this part of the radius.
inline constexpr double min_radius = 0.25;

// Neighbors within this distance count as being in the place of the site.
inline constexpr double min_scale = 0x1p-1000;
// A cloud is a line if its ratio of breadth to length is below the first bound, or if the second
// bound says that its breadth may come from rounding errors.
inline constexpr double min_thickness = 0x1p-40;
inline constexpr double min_remainder = 0x1p-30;

// Scales the steps by the largest coordinate; the first axis points to the farthest neighbor.
RONDEL_ALWAYS_INLINE inline void set_axes(Fit& fit) {
  for (std::size_t k = 0; k < fit.size; ++k) {
    const LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double xy = larger(std::fabs(p.x[i]), std::fabs(p.y[i]));
      fit.scale[i] = larger(fit.scale[i], larger(xy, std::fabs(p.z[i])));
    }
  }
  Lanes in_scale;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    in_scale[i] = 1 / (fit.scale[i] > min_scale ? fit.scale[i] : 1.0);
  }
  LaneVectors far{};
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      p.x[i] *= in_scale[i];
      p.y[i] *= in_scale[i];
      p.z[i] *= in_scale[i];
      const double square = p.x[i] * p.x[i] + p.y[i] * p.y[i] + p.z[i] * p.z[i];
      const bool is_farther = square > fit.farthest[i];
      far.x[i] = is_farther ? p.x[i] : far.x[i];
      far.y[i] = is_farther ? p.y[i] : far.y[i];
      far.z[i] = is_farther ? p.z[i] : far.z[i];
      fit.farthest[i] = is_farther ? square : fit.farthest[i];
    }
  }
  LaneVectors& first = fit.first_axis;
  LaneVectors& second = fit.second_axis;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    // The step to a unit vector is inclined: x.step = -|step|^2 / 2.
    const double up = fit.farthest[i] * fit.scale[i] / 2;
    const double x = far.x[i] + up * fit.sites.x[i];
    const double y = far.y[i] + up * fit.sites.y[i];
    const double z = far.z[i] + up * fit.sites.z[i];
    const double length = std::sqrt(x * x + y * y + z * z);
    first.x[i] = x / length;
    first.y[i] = y / length;
    first.z[i] = z / length;
    second.x[i] = fit.sites.y[i] * first.z[i] - fit.sites.z[i] * first.y[i];
    second.y[i] = fit.sites.z[i] * first.x[i] - fit.sites.x[i] * first.z[i];
    second.z[i] = fit.sites.x[i] * first.y[i] - fit.sites.y[i] * first.x[i];
  }
}

// Replaces the steps by coordinates in the stereographic plane.
RONDEL_ALWAYS_INLINE inline void set_chart(Fit& fit) {
  const LaneVectors& first = fit.first_axis;
  const LaneVectors& second = fit.second_axis;
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double square = p.x[i] * p.x[i] + p.y[i] * p.y[i] + p.z[i] * p.z[i];
      const double stretch = 1 / (1 - square * (fit.scale[i] * fit.scale[i]) / 4);
      const double a = (first.x[i] * p.x[i] + first.y[i] * p.y[i] + first.z[i] * p.z[i]) * stretch;
      const double b =
          (second.x[i] * p.x[i] + second.y[i] * p.y[i] + second.z[i] * p.z[i]) * stretch;
      p.x[i] = a;
      p.y[i] = b;
      fit.largest[i] = larger(fit.largest[i], a * a + b * b);
    }
  }
}

// Sets the weights and the change of coordinates. Entries that only fill a lane lie at (0, 0),
// where all terms and moments are 0.
RONDEL_ALWAYS_INLINE inline void set_weights(Fit& fit) {
  Lanes radius;
  Lanes least;
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    radius[i] = reach * std::sqrt(fit.largest[i]);
    least[i] = (min_radius * min_radius) * (radius[i] * radius[i]);
  }
  Lanes aa{};
  Lanes ab{};
  Lanes bb{};
  Lanes squares{};
  for (std::size_t k = 0; k < fit.size; ++k) {
    LaneVectors& p = fit.points[k];
    RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
      const double a = p.x[i];
      const double b = p.y[i];
      const double square = a * a + b * b;
      const double lacking = radius[i] - std::sqrt(square);
      const double root = (lacking * lacking) / larger(square, least[i]);
      const double weight = root * root;
      p.z[i] = weight;
      aa[i] += weight * (a * a);
      ab[i] += weight * (a * b);
      bb[i] += weight * (b * b);
      squares[i] += (weight * weight) * square;
    }
  }
  RONDEL_KEEP_LOOP for (std::size_t i = 0; i < lanes; ++i) {
    fit.mean_weight[i] = squares[i] / (aa[i] + bb[i]);
    fit.shear[i] = ab[i] / aa[i];
    const double rest = bb[i] - fit.shear[i] * ab[i];
    const bool is_plane =
        both(both(rest > (min_thickness * min_thickness) * aa[i], rest > min_remainder * bb[i]),
             fit.scale[i] >= min_scale);
    fit.is_found[i] = is_plane ? 1.0 : 0.0;
    fit.round_a[i] = 1 / std::sqrt(aa[i]);
    fit.round_b[i] = 1 / std::sqrt(is_plane ? rest : 1.0);
  }
}

}  // namespace rondel::interpolation::fits
