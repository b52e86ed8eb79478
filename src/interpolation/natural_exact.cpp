// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/natural_exact.h"

#include <cstddef>
#include <optional>

#include "exact/exact_sign.h"
#include "interpolation/natural_cell.h"

namespace rondel::interpolation {
namespace {

using exact::Ball;
using exact::BallVector;

constexpr exact::Magnitude weight_radius = -50;

template <std::size_t N>
std::optional<BallVector<N>> unit(const Point& p, const Point& center) {
  const BallVector<N> ray = exact::BallStep<N>()(center, p);
  const auto inverse = exact::inverse_square_root(dot(ray, ray));
  if (!inverse) return std::nullopt;
  return BallVector<N>{ray.x * *inverse, ray.y * *inverse, ray.z * *inverse};
}

// Returns true if N words were enough.
template <std::size_t N>
bool weigh(NaturalMethod method, const Point& target, std::span<const Point> sites,
           const Point& center, std::span<const RegionFace> faces, std::vector<double>& weights) {
  const auto u = unit<N>(target, center);
  if (!u) return false;
  const TangentBasis basis({leading(u->x), leading(u->y), leading(u->z)});
  NaturalCell<Ball<N>> cell;
  for (const Point& site : sites) {
    const auto x = unit<N>(site, center);
    if (!x) return false;
    cell.bisectors().push_back(basis.bisector(*u, *x - *u));
  }
  if (method == NaturalMethod::planar_sibson) make_stereographic<Ball<N>>(cell.bisectors());
  if (method == NaturalMethod::laplace) {
    cell.laplace();
  } else {
    cell.sibson(faces);
  }
  Ball<N> sum;
  for (const Ball<N>& share : cell.shares()) sum = sum + share;
  weights.clear();
  for (const Ball<N>& share : cell.shares()) {
    const Ball<N> weight = quotient(share, sum);
    if (weight.radius() > weight_radius) return false;
    weights.push_back(leading(weight));
  }
  return true;
}

}  // namespace

bool exact_natural_weights(NaturalMethod method, const Point& target, std::span<const Point> sites,
                           const Point& center, std::span<const RegionFace> faces,
                           std::vector<double>& weights) {
  return weigh<6>(method, target, sites, center, faces, weights) ||
         weigh<24>(method, target, sites, center, faces, weights) ||
         weigh<104>(method, target, sites, center, faces, weights);
}

}  // namespace rondel::interpolation
