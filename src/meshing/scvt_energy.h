// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The energy of a tessellation, and its gradient:
//
//     F = sum over the cells of  integral of rho(x) |x - z|^2,     dF/dz = -2 (M - (M.z) z),
//
// where M is the integral of rho(x) x over the cell of z. At a minimum every site is the centroid of its
// cell: the tessellation is centroidal.
//
// Constant density: |x - z|^2 = 2 - 2 x.z, so F = 8 pi - 2 sum z.M, and M is a sum over the cell's arcs
// (src/dual/centroids.cpp). Otherwise both are sums over the same nodes in the triangles from the site
// to the arcs (density_nodes.h).
//
// Unknowns are two coordinates a site in its tangent plane, in a frame that turns with the site.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/scvt_surface.h"
#include "meshing/tangent.h"
#include "rondel/mesh_size.h"

namespace rondel::mesh {

// What a step is judged by.
struct EnergyReport {
  double energy = 0;
  double mean_offset = 0;  // of |centroid - site| / spacing of the cell
  double largest_offset =
      0;  // the spacing of a cell of area A is that of hexagons, sqrt(2 A / sqrt 3)
};

struct SiteSums {
  TangentVector gradient;
  double mass;     // the integral of rho
  double spacing;  // of the cell
};

class CentroidalEnergy {
 public:
  // Constant density where `size` is null; it must outlive this.
  CentroidalEnergy(const SizeFunction* size, unsigned threads) : size_(size), threads_(threads) {}

  // Of the surface's sites, for each its gradient and mass. Where `is_fixed` is not 0 (empty: nowhere) the gradient is 0 and the
  // offset does not count.
  EnergyReport operator()(const MovingSurface& surface, std::span<const Point> sites,
                          std::span<const std::uint8_t> axes, std::span<SiteSums> sums,
                          std::span<const std::uint8_t> is_fixed = {}) const;

  // What rounding may do to a difference of energies.
  [[nodiscard]] double noise(double energy) const;

 private:
  const SizeFunction* size_;
  unsigned threads_;
};

}  // namespace rondel::mesh
