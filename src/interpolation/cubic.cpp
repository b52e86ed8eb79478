// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/cubic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "interpolation/unity.h"
#include "topology/mesh.h"

namespace rondel::interpolation {
namespace {

// S of one on the unit sphere is 0.48 and more in faces of evenly spread sites, from 40 sites up, and near
// 1 in small faces. Below this the face is odd.
constexpr double least_image_of_one = 0.25;

}  // namespace

bool CubicKernel::find_corners(const TargetPlace& place) {
  const Index f = place.location.face;
  const topology::Mesh& mesh = ground_.mesh();
  const topology::Face& face = mesh[f];
  const auto lowest =
      static_cast<unsigned>(std::ranges::min_element(face.vertex) - face.vertex.begin());
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned i = (lowest + k) % 3;
    const Index v = face.vertex[i];
    if (!has_gradient(v)) return false;
    vertices_[k] = v;
    face_.corners[k] = {exact::to_vector(ground_.unit(v).hi), careful_step(ground_, place, v)};
    const topology::Halfedge h = face.opposite[i];
    const Index beyond = topology::face_of(h);
    const Index y = mesh[beyond].vertex[topology::edge_of(h)];
    vertices_[3 + k] = y;
    face_.has_opposite[k] = ground_.is_solid(beyond) && has_gradient(y);
    if (!face_.has_opposite[k]) continue;
    face_.opposites[k] = {exact::to_vector(ground_.unit(y).hi), careful_step(ground_, place, y)};
  }
  return true;
}

bool CubicKernel::weigh(const Row& flat, SlopeRow& row) {
  std::array<double, 3> l{};
  for (const auto& [v, weight] : flat) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertices_[k] == v) l[k] = weight;
    }
  }
  if (!face_.weigh(l, result_)) return false;
  double sum = 0;
  for (const double weight : result_.weights) sum += weight;
  const double square = face_.squared_norm(l);
  const double cube = square * std::sqrt(square);
  if (!(sum >= least_image_of_one * cube)) return false;
  const double factor = 1 / (normalization_ == Normalization::unity ? sum : cube);
  row.resize(6);
  std::size_t size = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    if (k >= 3 && !face_.has_opposite[k - 3]) continue;
    const std::span others(row.data(), size);
    // In triangulations of few sites a vertex may be opposite to several edges.
    const auto known = std::ranges::find(others, vertices_[k], &SlopeShare::vertex);
    SlopeShare& share = row[static_cast<std::size_t>(known - others.begin())];
    if (known == others.end()) {
      share = {vertices_[k], 0, {}};
      ++size;
    }
    share.weight += result_.weights[k] * factor;
    share.slope = share.slope + exact::to_point(factor * result_.slopes[k]);
  }
  row.resize(size);
  if (normalization_ == Normalization::unity) take_up_rounding(row);
  return true;
}

void CubicKernel::add_linear(const TargetPlace& place, SlopeRow& row) const {
  double lacking = 0;
  for (const auto& [v, weight] : flat_) {
    const Vec s = step(place.unit, ground_.unit(v));
    lacking += weight * dot(s, s);
  }
  const double divisor = normalization_ == Normalization::unity ? 1 : 1 - lacking / 2;
  for (const auto& [v, weight] : flat_) row.push_back({v, weight / divisor, {}});
}

void CubicKernel::operator()(const TargetPlace& place, SlopeRow& row) {
  flat_.clear();
  linear_(place, flat_);
  if (!find_corners(place) || !weigh(flat_, row)) add_linear(place, row);
}

}  // namespace rondel::interpolation
