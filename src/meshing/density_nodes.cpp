// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/density_nodes.h"

#include <cmath>

#include "meshing/size_raster.h"
#include "system/wide_vectors.h"

namespace rondel::mesh {
namespace {

// The rule of degree 4 with 6 nodes (Dunavant 1985): the weights sum up to 1, the nodes are the
// permutations of (a, a, 1 - 2a).
struct Orbit {
  double weight;
  double a;
};
constexpr std::array<Orbit, 2> degree_4 = {
    {{0.223381589678011, 0.445948490915965}, {0.109951743655322, 0.091576213509771}}};

}  // namespace

// Lanes that no caller sets have a triangle, so that they compute with finite numbers.
DensityNodes::DensityNodes(const SizeFunction& size)
    : raster_(*size.raster_), cube_(std::get<CubeRaster>(raster_.places)) {
  for (std::size_t k = 0; k < lanes; ++k) set(k, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
}

inline void DensityNodes::find_solids() {
  for (std::size_t k = 0; k < lanes; ++k) {
    solids_[k] = 0.5 * det(sites_[k], first_[k], second_[k]);
    moments_.x[k] = moments_.y[k] = moments_.z[k] = 0;
    masses_[k] = areas_[k] = energies_[k] = 0;
  }
}

// Computes the nodes with these barycentric coordinates, and the squares of the raster in which
// they lie.
inline void DensityNodes::place_nodes(double of_first, double of_second) {
  const double scale = 0.5 * static_cast<double>(cube_.steps);
  const auto last = static_cast<std::int32_t>(cube_.steps - 1);
  const auto side = static_cast<std::int32_t>(cube_.side());
  for (std::size_t k = 0; k < lanes; ++k) {
    const auto z = sites_[k];
    const auto p = z + (of_first * first_[k] + of_second * second_[k]);
    const double inverse = 1 / std::sqrt(dot(p, p));
    inverse_[k] = inverse;
    to_node_.x[k] = inverse * p.x - z.x;
    to_node_.y[k] = inverse * p.y - z.y;
    to_node_.z[k] = inverse * p.z - z.z;
    const double ax = std::abs(p.x);
    const double ay = std::abs(p.y);
    const double az = std::abs(p.z);
    const double a_of_yz = ay >= az ? p.z : p.x;
    const double b_of_yz = ay >= az ? p.x : p.y;
    const double along_yz = ay >= az ? p.y : p.z;
    const bool is_x = ax >= ay && ax >= az;
    const double along = is_x ? p.x : along_yz;
    const double per_length = scale / std::abs(along);
    double u = (is_x ? p.y : a_of_yz) * per_length + scale;
    double v = (is_x ? p.z : b_of_yz) * per_length + scale;
    u = u > 0 ? u : 0;
    v = v > 0 ? v : 0;
    auto i = static_cast<std::int32_t>(u);
    auto j = static_cast<std::int32_t>(v);
    i = i < last ? i : last;
    j = j < last ? j : last;
    s_[k] = u - i;
    t_[k] = v - j;
    const std::int32_t axis = is_x ? 0 : (ay >= az ? 2 : 4);
    const std::int32_t face = axis + (along < 0 ? 1 : 0);
    squares_[k] = static_cast<std::uint32_t>((face * side + j) * side + i);
  }
}

// The raster is read apart from the vectorized loops, since its values lie at computed places.
inline void DensityNodes::read_raster() {
  const std::size_t side = cube_.side();
  for (std::size_t k = 0; k < lanes; ++k) {
    const float* const low = &raster_.relative[squares_[k]];
    corners_[0][k] = low[0];
    corners_[1][k] = low[1];
    corners_[2][k] = low[side];
    corners_[3][k] = low[side + 1];
  }
}

// The raster has r, the smallest spacing over the spacing, which is bilinear in each square; the
// density is r^4.
inline void DensityNodes::add_nodes(double weight) {
  for (std::size_t k = 0; k < lanes; ++k) {
    const double low = corners_[0][k];
    const double high = corners_[2][k];
    const double below = low + s_[k] * (corners_[1][k] - low);
    const double above = high + s_[k] * (corners_[3][k] - high);
    const double r = below + t_[k] * (above - below);
    const double inverse = inverse_[k];
    const double area = weight * solids_[k] * (inverse * inverse * inverse);
    const double mass = area * ((r * r) * (r * r));
    const auto to_node = to_node_[k];
    moments_.x[k] += mass * to_node.x;
    moments_.y[k] += mass * to_node.y;
    moments_.z[k] += mass * to_node.z;
    energies_[k] += mass * dot(to_node, to_node);
    masses_[k] += mass;
    areas_[k] += area;
  }
}

void DensityNodes::integrate() {
  system::with_wide_vectors([this]() RONDEL_ALWAYS_INLINE { find_solids(); });
  for (const Orbit& orbit : degree_4) {
    const double b = 1 - 2 * orbit.a;
    const std::array<std::array<double, 2>, 3> places = {
        {{orbit.a, orbit.a}, {b, orbit.a}, {orbit.a, b}}};
    for (const auto& place : places) {
      // Named variables are captured, since Clang 14 captures no structured bindings.
      const double of_first = place[0];
      const double of_second = place[1];
      system::with_wide_vectors([=, this]()
                                    RONDEL_ALWAYS_INLINE { place_nodes(of_first, of_second); });
      read_raster();
      system::with_wide_vectors([=, this]() RONDEL_ALWAYS_INLINE { add_nodes(orbit.weight); });
    }
  }
}

}  // namespace rondel::mesh
