// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integrals over triangles from a site z to two corners of its cell, of a density: many triangles at once, in loops that
// become vector code. The nodes are those of a rule of degree 4 in the plane triangle, moved to the sphere: where
// x = p / |p|, the solid angle is det(z, a, b) / |p|^3 times that of the triangle's own coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "exact/vector.h"
#include "rondel/mesh_size.h"

namespace rondel::mesh {

// Of a cell or a part of it, of the density rho.
struct CellSums {
  exact::Vector3<double> moment;  // the integral of rho (x - z); of constant density: of x
  double mass;                    // of rho
  double area;                    // of 1
  double energy;                  // of rho |x - z|^2; of constant density: z.M
};

class DensityNodes {
 public:
  static constexpr std::size_t lanes = 64;

  explicit DensityNodes(const SizeFunction& size);

  // The triangle of a lane: its site, and its corners relative to the site.
  void set(std::size_t lane, const exact::Vector3<double>& site, const exact::Vector3<double>& a,
           const exact::Vector3<double>& b) {
    sites_.set(lane, site);
    first_.set(lane, a);
    second_.set(lane, b);
  }
  void integrate();
  [[nodiscard]] CellSums operator[](std::size_t lane) const {
    return {moments_[lane], masses_[lane], areas_[lane], energies_[lane]};
  }

 private:
  using Numbers = std::array<double, lanes>;
  struct VectorLanes {
    alignas(64) Numbers x;
    alignas(64) Numbers y;
    alignas(64) Numbers z;
    void set(std::size_t lane, const exact::Vector3<double>& v) {
      x[lane] = v.x;
      y[lane] = v.y;
      z[lane] = v.z;
    }
    exact::Vector3<double> operator[](std::size_t lane) const {
      return {x[lane], y[lane], z[lane]};
    }
  };

  void find_solids();
  void place_nodes(double of_first, double of_second);
  void read_raster();
  void add_nodes(double weight);

  const SizeFunction::Raster& raster_;
  VectorLanes sites_, first_, second_;
  alignas(64) Numbers solids_;
  // Of one node in each triangle.
  VectorLanes to_node_;
  alignas(64) Numbers inverse_;
  alignas(64) Numbers s_, t_;  // where in the square of the raster
  std::array<std::uint32_t, lanes> squares_;
  alignas(64) std::array<std::array<float, lanes>, 4> corners_;  // of the raster
  VectorLanes moments_;
  alignas(64) Numbers masses_, areas_, energies_;
};

}  // namespace rondel::mesh
