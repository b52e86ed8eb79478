// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/natural.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "interpolation/linear.h"
#include "interpolation/normalize_weights.h"

namespace rondel::interpolation {
namespace {

// The largest accepted estimate of the error of a weight. Tests find no larger errors
// (docs/theory).
constexpr double max_error = 0x1p-45;
// The relative errors of steps and of sums and products of them, by arithmetic.
constexpr double double_unit = 0x1p-53;
constexpr double wide_unit = 0x1p-98;
constexpr double split_error = 0x1p-98;

using WideVector = exact::Vector3<exact::DoubleDouble>;

WideVector wide(const exact::SplitPoint& u) {
  return {exact::fast_two_sum(u.hi.x, u.lo.x), exact::fast_two_sum(u.hi.y, u.lo.y),
          exact::fast_two_sum(u.hi.z, u.lo.z)};
}

// Returns x - u from split points, with an error of 2^-99.
WideVector wide_step(const exact::SplitPoint& u, const exact::SplitPoint& x) {
  const auto difference = [](double a_hi, double a_lo, double b_hi, double b_lo) {
    return exact::two_diff(b_hi, a_hi) + exact::two_diff(b_lo, a_lo);
  };
  return {difference(u.hi.x, u.lo.x, x.hi.x, x.lo.x), difference(u.hi.y, u.lo.y, x.hi.y, x.lo.y),
          difference(u.hi.z, u.lo.z, x.hi.z, x.lo.z)};
}

// True on an edge with no face on one of its sides, or a flat one.
bool is_on_contour(const PreparedTriangulation& prepared, const Location& location) {
  if (location.where != Where::edge) return false;
  const FlatFaces& flat = prepared.flat_faces();
  if (flat.contains(location.face)) return true;
  const topology::Face& face = prepared.mesh()[location.face];
  for (std::size_t i = 0; i < 3; ++i) {
    if (face.vertex[i] == location.sites[0] || face.vertex[i] == location.sites[1]) continue;
    const Index behind = topology::face_of(face.opposite[i]);
    return !prepared.is_solid(behind) || flat.contains(behind);
  }
  return false;
}

}  // namespace

// If the cell is not bounded even in arbitrary precision, the target is so near to an edge of the
// contour that the weights of that edge are correct.
void NaturalKernel::operator()(const LocatedTarget& place, Row& row) {
  const Location beside = prepared_.flat_faces().location_beside(place);
  if (is_on_contour(prepared_, beside)) {
    weigh_on_edge(prepared_, {place.point, place.unit, beside}, row);
    return;
  }
  region_.find(place);
  if (method_ != NaturalMethod::laplace) region_.list_faces();
  if (weigh_in_doubles(place) || weigh_from_split_points(place) || weigh_exactly(place)) {
    add_shares(row);
  } else {
    LinearKernel{prepared_}(place, row);
  }
}

template <class T>
double NaturalKernel::weigh(NaturalCell<T>& cell) {
  if (method_ == NaturalMethod::planar_sibson) make_stereographic<T>(cell.bisectors());
  const double error =
      method_ == NaturalMethod::laplace ? cell.laplace() : cell.sibson(region_.faces());
  shares_.clear();
  for (const T& share : cell.shares()) shares_.push_back(leading(share));
  return error;
}

bool NaturalKernel::weigh_in_doubles(const LocatedTarget& place) {
  const TangentBasis basis(place.unit.hi);
  const Vec u = exact::to_vector(place.unit.hi);
  auto& bisectors = cell_.bisectors();
  bisectors.clear();
  double nearest = 1;
  for (const Index v : region_.ring()) {
    bisectors.push_back(basis.bisector(u, step(place.unit, prepared_.unit(v))));
    nearest = std::min(nearest, bisectors.back().s);
  }
  if (nearest < min_split_step * min_split_step) return false;
  return weigh(cell_) * double_unit <= max_error;
}

bool NaturalKernel::weigh_from_split_points(const LocatedTarget& place) {
  const TangentBasis basis(place.unit.hi);
  const WideVector u = wide(place.unit);
  auto& bisectors = wide_cell_.bisectors();
  bisectors.clear();
  double nearest = 1;
  for (const Index v : region_.ring()) {
    bisectors.push_back(basis.bisector(u, wide_step(place.unit, prepared_.unit(v))));
    nearest = std::min(nearest, bisectors.back().s.hi);
  }
  const double unit = std::max(wide_unit, split_error / std::sqrt(2 * nearest));
  return weigh(wide_cell_) * unit <= max_error;
}

bool NaturalKernel::weigh_exactly(const LocatedTarget& place) {
  sites_.clear();
  for (const Index v : region_.ring()) sites_.push_back(prepared_.point(v));
  return exact_natural_weights(method_, place.point, sites_, prepared_.center(), region_.faces(),
                               shares_);
}

void NaturalKernel::add_shares(Row& row) const {
  exact::DoubleDouble exact_sum;
  for (const double share : shares_) {
    const auto next = exact::two_sum(exact_sum.hi, std::max(share, 0.0));
    exact_sum = {next.hi, exact_sum.lo + next.lo};
  }
  const double sum = exact_sum.hi + exact_sum.lo;
  const std::span<const Index> ring = region_.ring();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (shares_[i] > 0) row.push_back({ring[i], shares_[i] / sum});
  }
  // The sum of more than `few` terms may be several ulp off when it is taken along the row; for
  // `many` terms, rounding to multiples of one number would change their mean noticeably.
  constexpr std::size_t few = 16;
  constexpr std::size_t many = 1 << 14;
  if (row.size() > few && row.size() < many) {
    round_to_exact_sums(row);
    take_up_rounding(row);
  }
}

}  // namespace rondel::interpolation
