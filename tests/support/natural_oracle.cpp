// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "support/natural_oracle.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace rondel::test {
namespace {

constexpr std::size_t no_site = ~std::size_t{0};

bool is_positive(const Real& a) { return a.sign() > 0; }

// A corner of a polygon, and the site whose line its side to the next corner is on.
struct OracleCorner {
  Real x;
  Real y;
  std::size_t site;
};
using Polygon = std::vector<OracleCorner>;

Real excess(const HalfPlane& h, const OracleCorner& c) { return h.x * c.x + h.y * c.y - h.t; }

Polygon cut(const Polygon& polygon, const HalfPlane& half, std::size_t site) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const OracleCorner& a = polygon[i];
    const OracleCorner& b = polygon[(i + 1) % polygon.size()];
    const Real at_a = excess(half, a);
    const Real at_b = excess(half, b);
    if (!is_positive(at_a)) result.push_back(a);
    if (is_positive(at_a) == is_positive(at_b)) continue;
    const Real share = at_a / (at_a - at_b);
    result.push_back(
        {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), is_positive(at_a) ? a.site : site});
  }
  return result;
}

Real twice_area(const Polygon& polygon) {
  Real sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const OracleCorner& a = polygon[i];
    const OracleCorner& b = polygon[(i + 1) % polygon.size()];
    sum = sum + (a.x * b.y - b.x * a.y);
  }
  return sum;
}

// Of all half-planes; has sides of no site where it is not bounded.
Polygon common_part(const std::vector<HalfPlane>& half_planes) {
  std::vector<std::size_t> nearest_first(half_planes.size());
  for (std::size_t i = 0; i < half_planes.size(); ++i) nearest_first[i] = i;
  std::ranges::sort(nearest_first, [&](std::size_t i, std::size_t j) {
    return (half_planes[i].t - half_planes[j].t).sign() < 0;
  });
  const Real far(0x1p1000);
  const Real zero;
  Polygon cell = {{far, far, no_site},
                  {zero - far, far, no_site},
                  {zero - far, zero - far, no_site},
                  {far, zero - far, no_site}};
  for (const std::size_t i : nearest_first) cell = cut(cell, half_planes[i], i);
  return cell;
}

// What the cell takes from the site of its k-th side. Who is nearest anywhere in the cell has a side of
// it: the way from there to him leaves the cell where he is nearest. Next ones first, which leave a
// small polygon to the others.
Polygon stolen(const std::vector<HalfPlane>& half_planes, const Polygon& cell, std::size_t k) {
  const HalfPlane& own = half_planes[cell[k].site];
  Polygon polygon = cell;
  for (std::size_t step = 1; step < cell.size() && !polygon.empty(); ++step) {
    const std::size_t away = step % 2 == 1 ? (step + 1) / 2 : cell.size() - step / 2;
    const std::size_t other = cell[(k + away) % cell.size()].site;
    if (other == cell[k].site) continue;
    const HalfPlane& its = half_planes[other];
    polygon = cut(polygon, {its.x - own.x, its.y - own.y, its.t - own.t}, other);
  }
  return polygon;
}

std::vector<double> divided_by_sum(const std::vector<Real>& shares) {
  Real sum;
  for (const Real& share : shares) sum = sum + share;
  std::vector<double> result;
  for (const Real& share : shares) result.push_back((share / sum).rounded());
  return result;
}

}  // namespace

NaturalOracle::NaturalOracle(std::span<const Point> sites, const Point& center)
    : center_(to_real(center)) {
  for (const Point& p : sites) units_.push_back(normalized(minus(to_real(p), center_)).value());
}

std::vector<HalfPlane> NaturalOracle::half_planes(const Point& target, NaturalPlane plane) const {
  const RealVector u = normalized(minus(to_real(target), center_)).value();
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(u[i].rounded()) < std::abs(u[axis].rounded())) axis = i;
  }
  RealVector along;
  along[axis] = Real(1);
  const RealVector e = normalized(cross(along, u)).value();
  const RealVector f = cross(u, e);
  std::vector<HalfPlane> result;
  for (const RealVector& x : units_) {
    const Real s = Real(1) - dot(x, u);
    const Real factor =
        plane == NaturalPlane::gnomonic ? Real(1) : Real(1) / (Real(1) - s * Real(0.5));
    result.push_back({dot(x, e) * factor, dot(x, f) * factor, s * factor});
  }
  return result;
}

auto NaturalOracle::weights(const Point& target, NaturalPlane plane) const -> Answer {
  const std::vector<HalfPlane> sites = half_planes(target, plane);
  const Polygon cell = common_part(sites);
  Answer answer;
  for (const OracleCorner& c : cell) {
    if (c.site == no_site) return answer;
  }
  std::vector<Real> sides(sites.size());
  std::vector<Real> areas(sites.size());
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const std::size_t i = cell[k].site;
    const OracleCorner& next = cell[(k + 1) % cell.size()];
    const Real dx = next.x - cell[k].x;
    const Real dy = next.y - cell[k].y;
    sides[i] = sqrt((dx * dx + dy * dy) / (sites[i].x * sites[i].x + sites[i].y * sites[i].y));
    areas[i] = twice_area(stolen(sites, cell, k));
  }
  answer.laplace = divided_by_sum(sides);
  answer.sibson = divided_by_sum(areas);
  return answer;
}

}  // namespace rondel::test
