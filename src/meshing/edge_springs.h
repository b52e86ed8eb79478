// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A model of the energy's second derivative that is never negative. The second derivative is, with
// x the points on the wall between the cells of i and j,
//
//     H_ii = 2 mass_i - sum over j of W_ij,   H_ij = W_ij,
//     W_ij = 2 density / |z_i - z_j| times the integral of x x' over the wall,
//
// and it is negative in some directions wherever edges are about to flip, so that steps computed
// with it are useless there. On a wall, the component of x across the wall is half an edge and the
// component along it is small. Without the latter, each edge is a spring,
//
//     x.S x = sum over edges of k (e.(x_i - x_j))^2,   k = density |wall| |z_i - z_j| / 2,   e = its direction.
//
// In the hexagonal lattice S is 1.04 and 1.5 times H for long waves, longitudinal and transverse.
// As (e.(x_i - x_j))^2 is at most 2 (x_i^2 + x_j^2), 0 <= S <= D with D = 2 sum k at each site,
// four times the mass of its cell. So a Chebyshev polynomial in S / D approximates the inverse of
// S: it is positive, needs no sums over all sites, and its steps are between Lloyd's and Newton's.
//
// in    a tessellation; forces at the sites
// out   displacements of the sites
// index sites
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/kinetic_delaunay.h"
#include "meshing/scvt_energy.h"
#include "meshing/tangent.h"

namespace rondel::mesh {

class EdgeSprings {
 public:
  explicit EdgeSprings(unsigned threads) : threads_(threads) {}

  // Computes the springs of the tessellation.
  void measure(const KineticDelaunay& surface, std::span<const Point> sites,
               std::span<const SiteSums> sums);

  // Replaces forces by displacements, approximately S^-1 times the forces. `axes` are those of
  // tangent.h.
  void yield(std::span<const Point> sites, std::span<const std::uint8_t> axes,
             std::span<TangentVector> forces);

 private:
  // A spring as one of its two sites has it, in 16 bytes.
  struct Spring {
    Index neighbor;
    float x, y, z;  // sqrt(k) e
  };

  // Takes one step of the Chebyshev recurrence: keep times the last step plus gain times the
  // residual.
  void relax(double keep, double gain);

  unsigned threads_;
  std::vector<std::uint64_t> offsets_;  // by site: where its springs begin
  std::vector<Spring> springs_;
  std::vector<double> softness_;  // 1 / D
  std::vector<Vector> forces_;
  std::vector<Vector> steps_;
  std::vector<Vector> displacements_;
  std::vector<Vector> next_;
};

}  // namespace rondel::mesh
