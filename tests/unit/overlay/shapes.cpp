// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "unit/overlay/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/vector.h"
#include "rondel/delaunay.h"
#include "support/random.h"

namespace rondel::test {
namespace {

RingOfPoints turned(RingOfPoints ring) {
  std::ranges::reverse(ring);
  return ring;
}

class ShapeMaker {
 public:
  ShapeMaker(std::uint64_t seed, std::span<const Point> corners)
      : random_(seed), corners_(corners) {}

  std::vector<RingOfPoints> operator()(std::size_t kind);

 private:
  double uniform(double low, double high) { return low + (high - low) * random_.unit(); }
  double power(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  std::size_t below(std::size_t n) { return random_.below(n); }
  bool one_of(std::size_t n) { return below(n) == 0; }
  // The end of an axis now and then, or a corner of the cells.
  Point center() {
    constexpr std::array<Point, 6> ends = {
        {{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}}};
    if (one_of(4)) return ends.at(below(6));
    if (!corners_.empty() && one_of(6)) return corners_[below(corners_.size())];
    return random_.direction();
  }
  static Point placed(const Point& center, double x, double y) {
    const Point axis = std::abs(center.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point east = normalized(cross(axis, center));
    const Point north = cross(center, east);
    return normalized(center + x * east + y * north);
  }
  // So many corners at one distance from a point, counterclockwise.
  RingOfPoints circle(const Point& center, double radius, std::size_t n, double stretch = 1) {
    const Point axis = std::abs(center.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point east = normalized(cross(axis, center));
    const Point north = cross(center, east);
    const double first = one_of(3) ? 0 : uniform(0, 1);
    RingOfPoints ring;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle =
          2 * std::numbers::pi * (static_cast<double>(k) + first) / static_cast<double>(n);
      ring.push_back(normalized(std::cos(radius) * center +
                                std::sin(radius) *
                                    (std::cos(angle) * east + stretch * std::sin(angle) * north)));
    }
    return ring;
  }
  // Rings around points that are apart.
  std::vector<RingOfPoints> islands(const Point& center, double radius, std::size_t n) {
    std::vector<RingOfPoints> result;
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
    const double step = radius / static_cast<double>(side);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t row = k / side;
      const std::size_t column = k % side;
      const double x = step * static_cast<double>(2 * column) - radius + step;
      const double y = step * static_cast<double>(2 * row) - radius + step;
      result.push_back(circle(placed(center, x, y), 0.6 * step * power(-3, 0), 3 + below(6)));
    }
    return result;
  }
  std::size_t many() { return 1 + below(one_of(10) ? 300 : 30); }

  RingOfPoints fold(const Point& center);
  RingOfPoints bow_tie(bool has_corner);
  std::vector<RingOfPoints> keyhole();
  RingOfPoints spike();
  std::vector<RingOfPoints> archipelago(bool is_turned);
  std::vector<RingOfPoints> lagoon();
  std::vector<RingOfPoints> belt();
  RingOfPoints octant();
  RingOfPoints around_pole();
  RingOfPoints at_antimeridian();
  RingOfPoints cap();
  RingOfPoints tangle();
  void attract(std::vector<RingOfPoints>& rings);

  Random random_;
  std::span<const Point> corners_;
};

// Along a great circle and back, to rounding or a little more.
RingOfPoints ShapeMaker::fold(const Point& center) {
  const Point other = random_.direction();
  const double length = power(-6, 0);
  RingOfPoints there;
  const std::size_t size = 3 + below(4);
  for (std::size_t k = 0; k < size; ++k) {
    there.push_back(normalized(center + uniform(-length, length) * other));
  }
  const double width = one_of(2) ? 1e-16 : power(-17, -12);
  RingOfPoints back(there.begin() + 1, there.end() - 1);
  for (Point& p : back) p = normalized(p + width * random_.direction());
  there.insert(there.end(), back.rbegin(), back.rend());
  return there;
}

// With or without a corner where it crosses itself.
RingOfPoints ShapeMaker::bow_tie(bool has_corner) {
  const Point middle = center();
  RingOfPoints ring = circle(middle, power(-9, -0.1), 4);
  std::swap(ring[2], ring[3]);
  if (has_corner) return {ring[0], ring[1], middle, ring[2], ring[3], middle};
  if (one_of(2)) ring[below(4)] = placed(middle, uniform(-0.3, 0.3), uniform(-0.3, 0.3));
  return ring;
}

// A ring that goes to its hole and back; now and then to a hole at its corner, or past another one.
std::vector<RingOfPoints> ShapeMaker::keyhole() {
  const Point middle = center();
  const double radius = power(-9, -0.1);
  const RingOfPoints outer = circle(middle, radius, 3 + below(5));
  RingOfPoints hole = turned(circle(middle, radius / uniform(2.5, 30), 3 + below(4)));
  RingOfPoints ring = outer;
  const auto near =
      std::ranges::max_element(hole, {}, [&](const Point& p) { return dot(p, outer[0]); });
  if (one_of(4)) {
    *near = outer[0];
    return {outer, hole};
  }
  ring.push_back(outer[0]);
  ring.insert(ring.end(), near, hole.end());
  ring.insert(ring.end(), hole.begin(), near + 1);
  if (one_of(4)) {
    const Point aside = normalized(middle + 0.45 * (outer[1] - middle));
    return {ring, turned(circle(aside, radius / 50, 3))};
  }
  return {ring};
}

// Ways out or in, and back.
RingOfPoints ShapeMaker::spike() {
  const Point middle = center();
  const RingOfPoints outer = circle(middle, power(-9, -0.1), 3 + below(5));
  RingOfPoints ring;
  for (const Point& p : outer) {
    ring.push_back(p);
    if (!one_of(2)) continue;
    const double length = one_of(2) ? uniform(0.1, 1) : uniform(-0.9, -0.1);
    const Point end = normalized(p + length * (p - middle));
    ring.push_back(end);
    if (one_of(2)) ring.push_back(normalized(p + end));  // on the way back, to rounding
    ring.push_back(p);
  }
  return ring;
}

std::vector<RingOfPoints> ShapeMaker::archipelago(bool is_turned) {
  std::vector<RingOfPoints> rings = islands(center(), power(-8, -0.3), many());
  if (one_of(10)) rings.push_back(rings[below(rings.size())]);
  if (is_turned) std::ranges::transform(rings, rings.begin(), turned);
  if (one_of(10)) rings[below(rings.size())] = turned(rings[0]);
  return rings;
}

// The sphere less an island, and the island's lagoon.
std::vector<RingOfPoints> ShapeMaker::lagoon() {
  const Point middle = center();
  const double size = power(-9, -0.1);
  return {turned(circle(middle, size, 3 + below(8))), circle(middle, size / uniform(2.1, 9), 5)};
}

// Around the sphere, now and then no wider than some roundings.
std::vector<RingOfPoints> ShapeMaker::belt() {
  const Point middle = center();
  if (one_of(2)) {
    return {circle(middle, uniform(1, 1.6), 3 + below(40)),
            turned(circle(middle, uniform(0.1, 0.3), 3 + below(30)))};
  }
  const double radius = one_of(2) ? std::numbers::pi / 2 : uniform(0.2, 1.7);
  const double width = power(-16, -1);
  const std::size_t n = 3 + below(40);
  const Random before = random_;
  const RingOfPoints outer = circle(middle, radius, n);
  random_ = before;
  return {outer, turned(circle(middle, radius - width, n))};
}

// Between ends of axes.
RingOfPoints ShapeMaker::octant() {
  std::vector<Point> ends = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  if (one_of(2)) {
    const double x = one_of(2) ? 1 : -1;
    const double y = one_of(2) ? 1 : -1;
    const double z = one_of(2) ? 1 : -1;
    const RingOfPoints ring = {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
    return x * y * z < 0 && !one_of(4) ? turned(ring) : ring;
  }
  RingOfPoints ring;
  const std::size_t size = 3 + below(4);
  for (int tries = 0; ring.size() < size && tries < 30; ++tries) {
    const Point& next = ends[below(ends.size())];
    const auto is_far = [&](const Point& p) { return std::abs(dot(p, next)) < 0.5; };
    if (ring.empty() || is_far(ring.back())) ring.push_back(next);
  }
  while (ring.size() > 2 && std::abs(dot(ring.front(), ring.back())) > 0.5) ring.pop_back();
  return ring;
}

// Around a pole, with a corner there, or along meridians.
RingOfPoints ShapeMaker::around_pole() {
  const double z = one_of(2) ? 1 : -1;
  const Point pole{0, 0, z};
  RingOfPoints ring = circle(pole, power(-12, 0.3), 3 + below(12));
  if (one_of(2)) ring[below(ring.size())] = pole;
  if (one_of(4)) ring = turned(ring);
  if (one_of(3)) {  // sides on meridians
    const double lon = uniform(0, 6);
    const double east = lon + uniform(0.1, 3);
    const double height = z * uniform(0.01, 0.9);
    const double radius = std::sqrt(1 - height * height);
    ring = {{radius * std::cos(lon), radius * std::sin(lon), height},
            {radius * std::cos(east), radius * std::sin(east), height},
            pole};
    if (z < 0) ring = turned(ring);
  }
  return ring;
}

// With corners on it, or sides along it.
RingOfPoints ShapeMaker::at_antimeridian() {
  const double lat = uniform(-1.5, 1.5);
  const Point middle = {-std::cos(lat), one_of(2) ? 0.0 : -0.0, std::sin(lat)};
  RingOfPoints ring = circle(middle, power(-9, -0.1), 4 + below(6));
  for (Point& p : ring) {
    if (one_of(2)) p = normalized(Point{p.x, one_of(2) ? 0.0 : -0.0, p.z});
  }
  return ring;
}

// Or all but a cap.
RingOfPoints ShapeMaker::cap() {
  const RingOfPoints ring = circle(center(), uniform(0.01, 1.57), 3 + below(40));
  return one_of(2) ? ring : turned(ring);
}

// A ring through any places nearby.
RingOfPoints ShapeMaker::tangle() {
  const Point middle = center();
  const double radius = power(-9, 0);
  RingOfPoints ring;
  const std::size_t size = 3 + below(5);
  for (std::size_t k = 0; k < size; ++k) {
    ring.push_back(placed(middle, uniform(-radius, radius), uniform(-radius, radius)));
  }
  return ring;
}

// Moves some corners to the nearest of those of the cells.
void ShapeMaker::attract(std::vector<RingOfPoints>& rings) {
  for (RingOfPoints& ring : rings) {
    for (Point& p : ring) {
      if (one_of(2)) continue;
      p = *std::ranges::max_element(corners_, {}, [&](const Point& c) { return dot(p, c); });
    }
  }
}

std::vector<RingOfPoints> ShapeMaker::operator()(std::size_t kind) {
  std::vector<RingOfPoints> rings;
  switch (kind) {
    case 0:
      rings = {circle(center(), power(-9, 0), 3 + below(9), power(-17, 0))};
      break;
    case 1:
      rings = {fold(center())};
      break;
    case 2:
    case 3:
      rings = {bow_tie(kind == 3)};
      break;
    case 4:
      rings = keyhole();
      break;
    case 5:
      rings = {spike()};
      break;
    case 6:
    case 7:
      rings = archipelago(kind == 7);
      break;
    case 8:
      rings = lagoon();
      break;
    case 9:
      rings = belt();
      break;
    case 10:
      rings = {octant()};
      break;
    case 11:
      rings = {around_pole()};
      break;
    case 12:
      rings = {at_antimeridian()};
      break;
    case 13:
      rings = {cap()};
      break;
    default:
      rings = {tangle()};
  }
  if (!corners_.empty() && rings.size() < 9 && one_of(5)) attract(rings);
  return rings;
}

// Neither sides without a length nor half a turn long.
bool are_apart(const Point& a, const Point& b) {
  const Point normal = cross(a, b - a);
  return dot(normal, normal) > 1e-36;
}

RingOfPoints without_repeats(const RingOfPoints& ring) {
  RingOfPoints kept;
  for (const Point& p : ring) {
    if (kept.empty() || are_apart(kept.back(), p)) kept.push_back(p);
  }
  while (kept.size() > 1 && !are_apart(kept.front(), kept.back())) kept.pop_back();
  return kept;
}

}  // namespace

std::vector<RingOfPoints> hostile_shape(std::size_t kind, std::uint64_t seed,
                                        std::span<const Point> corners) {
  std::vector<RingOfPoints> rings;
  for (const RingOfPoints& ring : ShapeMaker(seed * 64 + kind, corners)(kind)) {
    RingOfPoints kept = without_repeats(ring);
    if (kept.size() > 2) rings.push_back(std::move(kept));
  }
  return rings;
}

CellRings one_cell_of(const std::vector<RingOfPoints>& rings) {
  CellRings cells = cells_of_rings(rings);
  cells.cells = {0, rings.size()};
  return cells;
}

CellRings cells_of_rings(const std::vector<RingOfPoints>& rings) {
  CellRings cells;
  for (const RingOfPoints& ring : rings) {
    for (const Point& p : ring) {
      cells.corners.push_back(static_cast<Index>(cells.points.size()));
      cells.points.push_back(p);
    }
    cells.rings.push_back(cells.corners.size());
    cells.cells.push_back(cells.rings.size() - 1);
  }
  return cells;
}

CellRings cells_of_parts(const std::vector<std::vector<RingOfPart>>& cells) {
  CellRings result;
  for (const auto& rings : cells) {
    for (const RingOfPart& ring : rings) {
      for (const LonLat& corner : ring.corners) {
        const Point p = unit_vector(corner);
        const auto known = std::ranges::find(result.points, p);
        result.corners.push_back(static_cast<Index>(known - result.points.begin()));
        if (known == result.points.end()) result.points.push_back(p);
      }
      result.rings.push_back(result.corners.size());
    }
    result.cells.push_back(result.rings.size() - 1);
  }
  return result;
}

}  // namespace rondel::test
