// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Integrates a density over triangles between a site z and two corners of its cell, many triangles
// at once, in loops that compilers vectorize. The nodes are those of a rule of degree 4 in the
// plane triangle, projected to the sphere: at x = p / |p| the solid angle is det(z, a, b) / |p|^3
// times the area element of the triangle's coordinates.
//
// in    for each lane a site and two corners relative to it; a size function
// out   for each lane four integrals
// index lanes
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "exact/vector.h"
#include "rondel/mesh_size.h"

namespace rondel::mesh {

struct CubeRaster;

// Integrals over a cell or a part of it, with the density rho.
struct CellSums {
  exact::Vector3<double> moment;  // of rho (x - z); for constant density of x
  double mass;                    // of rho
  double area;                    // of 1
  double energy;                  // of rho |x - z|^2; for constant density z.moment
};

// Many triangles with the sums over the nodes of each.
class DensityNodes {
 public:
  static constexpr std::size_t lanes = 64;

  // Precondition: the size function is known on the whole sphere.
  explicit DensityNodes(const SizeFunction& size);

  // Sets the triangle of a lane: its site, and its two other corners relative to the site.
  void set(std::size_t lane, const exact::Vector3<double>& site, const exact::Vector3<double>& a,
           const exact::Vector3<double>& b) {
    sites_.set(lane, site);
    first_.set(lane, a);
    second_.set(lane, b);
  }
  // Computes the integrals of all lanes; operator[] returns them.
  void integrate();
  // Returns the integrals over the triangle of a lane. Precondition: integrate() has been called.
  [[nodiscard]] CellSums operator[](std::size_t lane) const {
    return {moments_[lane], masses_[lane], areas_[lane], energies_[lane]};
  }

 private:
  // One number, and one vector, for each lane.
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

  // Computes twice the areas of the plane triangles, times the height of the site, and clears the
  // sums.
  void find_solids();
  // Computes one node of each triangle and its square of the raster.
  void place_nodes(double of_first, double of_second);
  // Loads the values of the raster at the corners of these squares.
  void read_raster();
  // Adds the node with this weight to the sums.
  void add_nodes(double weight);

  const SizeFunction::Raster& raster_;
  const CubeRaster& cube_;
  VectorLanes sites_, first_, second_;
  alignas(64) Numbers solids_;
  // The data of one node in each triangle.
  VectorLanes to_node_;
  alignas(64) Numbers inverse_;
  alignas(64) Numbers s_, t_;  // position of the node in its raster square, 0 to 1
  std::array<std::uint32_t, lanes> squares_;
  alignas(64) std::array<std::array<float, lanes>, 4> corners_;  // values of the raster at the
                                                                 // corners of the square
  VectorLanes moments_;
  alignas(64) Numbers masses_, areas_, energies_;
};

}  // namespace rondel::mesh
