// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Weights of natural neighbors from their definition, by cutting a polygon with the lines of all sites,
// in numbers so long that rounding does not matter. Knows no triangulation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rondel/types.h"
#include "support/mpfr_oracle.h"

namespace rondel::test {

enum class NaturalPlane : std::uint8_t { gnomonic, stereographic };

// The half-plane x g_x + y g_y <= t.
struct HalfPlane {
  Real x;
  Real y;
  Real t;
};

class NaturalOracle {
 public:
  // No two in one place.
  NaturalOracle(std::span<const Point> sites, const Point& center);

  struct Answer {
    std::vector<double> laplace;  // of each site; empty if the cell of the target is not bounded
    std::vector<double> sibson;
  };
  [[nodiscard]] Answer weights(const Point& target, NaturalPlane plane) const;

 private:
  // Of each site, what is nearer to the target.
  [[nodiscard]] std::vector<HalfPlane> half_planes(const Point& target, NaturalPlane plane) const;

  RealVector center_;
  std::vector<RealVector> units_;
};

}  // namespace rondel::test
