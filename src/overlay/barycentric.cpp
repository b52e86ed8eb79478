// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Implements the weights of barycentric.h.
//
// Wachspress:   w_i = det(x_i-1, x_i, x_i+1) / (A_i-1 A_i), here times the product of all A
// Mean value:   w_i = (tan(a_i-1 / 2) + tan(a_i / 2)) / s_i with the angle a_i at u from x_i to x_i+1
//
// Both satisfy sum w_i p_i = 0, so the sum of w_i x_i is along u. In another gnomonic plane the
// homogeneous coordinates of x_i have other lengths; these cancel in Wachspress's quotient, but for
// one factor for each corner, so that the plane does not matter.
#include "overlay/barycentric.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "exact/vector.h"
#include "map/ring_area.h"

namespace rondel {
namespace {

// What the weights need of a corner as seen from u.
struct SeenCorner {
  Point away;     // p_i
  double sine;    // s_i
  double area;    // A_i
  double cosine;  // p_i . p_i+1
};

Point away_from(const Point& u, const Point& x) {
  const Point d = x - u;
  return d - dot(d, u) * u;
}

std::vector<SeenCorner> seen_from(std::span<const Point> points, const Point& u,
                                  const std::vector<CornerWeight>& row) {
  std::vector<SeenCorner> seen(row.size());
  for (std::size_t k = 0; k < row.size(); ++k) {
    seen[k].away = away_from(u, points[row[k].corner]);
    seen[k].sine = norm(seen[k].away);
  }
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Point& other = seen[k + 1 < row.size() ? k + 1 : 0].away;
    seen[k].area = det(u, seen[k].away, other);
    seen[k].cosine = dot(seen[k].away, other);
  }
  return seen;
}

// Returns det(a, b, c) of unit vectors near each other.
double turn_at(const Point& a, const Point& b, const Point& c) { return det(b, c - b, a - b); }

bool divide_by_sum(std::vector<CornerWeight>& row) {
  double sum = 0;
  for (const CornerWeight& entry : row) sum += entry.weight;
  if (!(sum > 0) || !std::isfinite(sum)) return false;
  for (CornerWeight& entry : row) entry.weight /= sum;
  return true;
}

// Returns tan(a / 2) for the angle a whose sine and cosine are area and cosine, times s_i s_i+1.
double tangent_of_half(const SeenCorner& seen, double sines) {
  if (seen.cosine >= 0) return seen.area / (sines + seen.cosine);
  // The other form has no cancellation for an obtuse angle. Where rounding leaves nothing of the
  // area, the place is on the side, and only the ends of this side count.
  constexpr double least = 0x1p-1000;
  const double area = std::abs(seen.area) < least ? std::copysign(least, seen.area) : seen.area;
  return (sines - seen.cosine) / area;
}

}  // namespace

bool is_sharp(const Point& a, const Point& b, const Point& c) {
  return turn_at(a, b, c) > least_turn * norm(a - b) * norm(c - b);
}

void turn_left(std::span<const Point> points, std::vector<Index>& ring) {
  std::vector<Point> corners;
  corners.reserve(ring.size());
  for (const Index i : ring) corners.push_back(points[i]);
  if (map::is_clockwise(corners)) std::ranges::reverse(ring);
}

// The sines are those of the angles to the ends: w_a s_a = w_b s_b.
bool weigh_side(std::span<const Point> points, const Point& u, std::vector<CornerWeight>& row) {
  row[0].weight = norm(away_from(u, points[row[1].corner]));
  row[1].weight = norm(away_from(u, points[row[0].corner]));
  return divide_by_sum(row);
}

bool weigh_convex(std::span<const Point> points, const Point& u, std::vector<CornerWeight>& row) {
  std::vector<SeenCorner> seen = seen_from(points, u, row);
  const std::size_t n = row.size();
  double largest = 0;
  for (SeenCorner& corner : seen) {
    // The exact signs are positive; rounding may leave less than nothing.
    corner.area = std::max(corner.area, 0.0);
    largest = std::max(largest, corner.area);
  }
  if (!(largest > 0)) return weigh_any(points, u, row);
  for (SeenCorner& corner : seen) corner.area /= largest;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = k > 0 ? k - 1 : n - 1;
    const std::size_t after = k + 1 < n ? k + 1 : 0;
    double product =
        turn_at(points[row[before].corner], points[row[k].corner], points[row[after].corner]);
    for (std::size_t j = 0; j < n; ++j) {
      if (j != before && j != k) product *= seen[j].area;
    }
    row[k].weight = product;
  }
  // Products of many small areas may underflow, in cells of very many corners.
  return divide_by_sum(row) || weigh_any(points, u, row);
}

bool weigh_any(std::span<const Point> points, const Point& u, std::vector<CornerWeight>& row) {
  const std::vector<SeenCorner> seen = seen_from(points, u, row);
  const std::size_t n = row.size();
  const auto at = std::ranges::find(seen, 0.0, &SeenCorner::sine);
  if (at != seen.end()) {
    // The place is not at the corner, and nearer than any number tells.
    for (CornerWeight& entry : row) entry.weight = 0;
    row[static_cast<std::size_t>(at - seen.begin())].weight = 1;
    return true;
  }
  std::vector<double> tangents(n);
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    tangents[k] = tangent_of_half(seen[k], seen[k].sine * seen[k + 1 < n ? k + 1 : 0].sine);
    largest = std::max(largest, std::abs(tangents[k]));
  }
  if (!(largest > 0) || !std::isfinite(largest)) return false;
  double area = 0;  // positive if the ring is counterclockwise around u
  for (std::size_t k = 0; k < n; ++k) {
    const double sum = tangents[k > 0 ? k - 1 : n - 1] / largest + tangents[k] / largest;
    row[k].weight = sum / seen[k].sine;
    area += row[k].weight;
  }
  if (area < 0) {
    for (CornerWeight& entry : row) entry.weight = -entry.weight;
  }
  return divide_by_sum(row);
}

}  // namespace rondel
