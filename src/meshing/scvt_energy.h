// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The energy of a tessellation and its gradient:
//
//     F = sum over the cells of  integral of rho(x) |x - z|^2,     dF/dz = -2 (M - (M.z) z),
//
// where M is the integral of rho(x) x over the cell of z. At a minimum every site is the centroid
// of its cell: the tessellation is centroidal.
//
// Constant density: |x - z|^2 = 2 - 2 x.z, so F = 8 pi - 2 sum z.M, and M is a sum over the cell's
// arcs (src/dual/centroids.cpp). Otherwise both are sums over the same nodes in the triangles from
// the site to the arcs (density_nodes.h).
//
// The unknowns are two coordinates a site in its tangent plane, in a frame that turns with the site
// (tangent.h).
//
// in    sites as unit vectors with their triangulation, a size function or none
// out   the energy, and for each site its gradient and mass
// index sites
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/kinetic_delaunay.h"
#include "meshing/tangent.h"
#include "rondel/mesh_size.h"

namespace rondel::mesh {

// The energy and the offsets of all cells, by which a step is judged.
struct EnergyReport {
  double energy = 0;
  double mean_offset = 0;  // mean of |centroid - site| / spacing over the cells
  double largest_offset =
      0;  // largest of these; a cell of area A has the spacing sqrt(2 A / sqrt 3), that of hexagons
};

// The gradient of the energy at a site, and integrals over its cell.
struct SiteSums {
  TangentVector gradient;
  double mass;     // integral of rho over the cell
  double spacing;  // spacing of the cell
};

// Computes the energy of tessellations.
class CentroidalEnergy {
 public:
  // The density is constant if `size` is null. `size` must outlive this object.
  CentroidalEnergy(const SizeFunction* size, unsigned threads) : size_(size), threads_(threads) {}

  // Returns the energy and sets the sums of each site. Where `is_fixed` is not 0, the gradient is 0
  // and the offset does not count; it is empty if no site is fixed. `axes` are those of tangent.h.
  EnergyReport operator()(const KineticDelaunay& surface, std::span<const Point> sites,
                          std::span<const std::uint8_t> axes, std::span<SiteSums> sums,
                          std::span<const std::uint8_t> is_fixed = {}) const;

  // Returns a bound of the rounding error of a difference of energies.
  [[nodiscard]] double noise(double energy) const;

 private:
  const SizeFunction* size_;
  unsigned threads_;
};

}  // namespace rondel::mesh
