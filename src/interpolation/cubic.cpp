// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/cubic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "interpolation/normalize_weights.h"
#include "topology/mesh.h"

namespace rondel::interpolation {
namespace {

// S of 1 on the unit sphere is at least 0.48 in faces of evenly spread sites, from 40 sites on, and
// near 1 in small faces. In faces below this bound the row is linear.
constexpr double min_image_of_one = 0.25;

}  // namespace

bool CubicKernel::find_corners(std::size_t lane, const LocatedTarget& place) {
  const Index f = place.location.face;
  const topology::Mesh& mesh = prepared_.mesh();
  const topology::Face& face = mesh[f];
  std::array<Index, 6>& vertices = lanes_[lane].vertices;
  const auto lowest =
      static_cast<unsigned>(std::ranges::min_element(face.vertex) - face.vertex.begin());
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned i = (lowest + k) % 3;
    const Index v = face.vertex[i];
    if (!has_gradient(v)) return false;
    vertices[k] = v;
    faces_.set_corner(lane, k, exact::to_vector(prepared_.unit(v).hi),
                      careful_step(prepared_, place, v));
    const topology::Halfedge h = face.opposite[i];
    const Index beyond = topology::face_of(h);
    const Index y = mesh[beyond].vertex[topology::edge_of(h)];
    vertices[3 + k] = y;
    if (prepared_.is_solid(beyond) && has_gradient(y)) {
      faces_.set_opposite(lane, k, exact::to_vector(prepared_.unit(y).hi),
                          careful_step(prepared_, place, y));
    } else {
      faces_.clear_opposite(lane, k);
    }
  }
  return true;
}

// The linear weights of a target are the coordinates at which the element is evaluated.
void CubicKernel::expect(std::size_t lane, const LocatedTarget& place) {
  Lane& expected = lanes_[lane];
  expected.flat.clear();
  linear_(place, expected.flat);
  expected.has_gradients = find_corners(lane, place);
  if (!expected.has_gradients) return;
  std::array<double, 3> l{};
  for (const auto& [v, weight] : expected.flat) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (expected.vertices[k] == v) l[k] = weight;
    }
  }
  faces_.set_point(lane, l);
}

bool CubicKernel::weigh(std::size_t lane, GradientRow& row) const {
  if (!faces_.is_weighed(lane)) return false;
  double sum = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    if (k < 3 || faces_.has_opposite(lane, k - 3)) sum += faces_.weight(lane, k);
  }
  const double square = faces_.squared_norm(lane);
  const double cube = square * std::sqrt(square);
  if (!(sum >= min_image_of_one * cube)) return false;
  const double factor = 1 / (normalization_ == Normalization::unity ? sum : cube);
  const std::array<Index, 6>& vertices = lanes_[lane].vertices;
  row.resize(6);
  std::size_t size = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    if (k >= 3 && !faces_.has_opposite(lane, k - 3)) continue;
    const std::span others(row.data(), size);
    // In triangulations of few sites, one vertex may be opposite to several edges.
    const auto known = std::ranges::find(others, vertices[k], &GradientShare::vertex);
    GradientShare& share = row[static_cast<std::size_t>(known - others.begin())];
    if (known == others.end()) {
      share = {vertices[k], 0, {}};
      ++size;
    }
    share.weight += faces_.weight(lane, k) * factor;
    share.slope = share.slope + exact::to_point(factor * faces_.slope(lane, k));
  }
  row.resize(size);
  if (normalization_ == Normalization::unity) take_up_rounding(row);
  return true;
}

void CubicKernel::add_linear(const LocatedTarget& place, const Row& flat, GradientRow& row) const {
  double lacking = 0;
  for (const auto& [v, weight] : flat) {
    const Vec s = step(place.unit, prepared_.unit(v));
    lacking += weight * dot(s, s);
  }
  const double divisor = normalization_ == Normalization::unity ? 1 : 1 - lacking / 2;
  for (const auto& [v, weight] : flat) row.push_back({v, weight / divisor, {}});
}

void CubicKernel::operator()(std::size_t lane, const LocatedTarget& place, GradientRow& row) {
  if (!are_weighed_) faces_.weigh();
  are_weighed_ = true;
  const Lane& expected = lanes_[lane];
  if (!expected.has_gradients || !weigh(lane, row)) add_linear(place, expected.flat, row);
}

}  // namespace rondel::interpolation
