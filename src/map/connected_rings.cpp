// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "map/connected_rings.h"

#include <algorithm>
#include <cmath>

#include "exact/vector.h"
#include "map/ring_area.h"
#include "rondel/predicates.h"

namespace rondel::map {
namespace {

using Ring = std::span<const Point>;

const Point& after(Ring ring, std::size_t k) { return ring[k + 1 < ring.size() ? k + 1 : 0]; }

Point middle(const Point& p, const Point& q) { return normalized(p + q); }

bool is_left(const Point& p, const Point& q, const Point& r) {
  return orientation(p, q, r) == Sign::positive;
}

// Whether the arcs ab and cd cross; points on the other one's circle count as right of it.
bool do_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const bool left_of_ab = is_left(a, b, c);
  return is_left(a, b, d) != left_of_ab && is_left(c, d, b) == left_of_ab &&
         is_left(c, d, a) != left_of_ab;
}

// Whether p is to the left of the ring: an arc from the middle of a side to p begins on the side's left or right
// and changes sides wherever it crosses the ring.
bool is_inside(Ring ring, const Point& p) {
  std::size_t side = 0;
  while (side + 1 < ring.size() && orientation(ring[side], after(ring, side), p) == Sign::zero)
    ++side;
  const Point start = middle(ring[side], after(ring, side));
  bool is_in = is_left(ring[side], after(ring, side), p);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (k != side && do_cross(start, p, ring[k], after(ring, k))) is_in = !is_in;
  }
  return is_in;
}

// A circle around all corners of a ring that is smaller than a hemisphere.
class Cap {
 public:
  explicit Cap(Ring ring) {
    Point sum{};
    for (const Point& p : ring) sum = sum + p;
    constexpr double least = 1e-3;
    if (!(norm(sum) > least * static_cast<double>(ring.size()))) return;
    center_ = normalized(sum);
    cosine_ = 1;
    for (const Point& p : ring) cosine_ = std::min(cosine_, dot(center_, p));
    if (cosine_ < 0.1) cosine_ = -2;
  }
  [[nodiscard]] bool has(const Point& p) const { return dot(center_, p) >= cosine_ - 1e-12; }

 private:
  Point center_{};
  double cosine_ = -2;  // everything
};

struct Outer {
  std::size_t ring;
  double area;
  Cap cap;
};

}  // namespace

std::vector<std::vector<std::size_t>> connected_rings(std::span<const Ring> rings) {
  if (rings.size() == 1) return {{0}};
  std::vector<Outer> outers;
  std::vector<std::size_t> holes;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const double area = area_on_left(rings[r]);
    if (area > 0) {
      outers.push_back({r, area, Cap(rings[r])});
    } else {
      holes.push_back(r);
    }
  }
  std::vector<std::vector<std::size_t>> parts(outers.size() + 1);
  for (std::size_t k = 0; k < outers.size(); ++k) parts[k + 1].push_back(outers[k].ring);
  for (const std::size_t hole : holes) {
    const Point p = middle(rings[hole][0], rings[hole][1]);
    std::size_t owner = 0;
    for (std::size_t k = 0; k < outers.size(); ++k) {
      if ((owner == 0 || outers[k].area < outers[owner - 1].area) && outers[k].cap.has(p) &&
          is_inside(rings[outers[k].ring], p)) {
        owner = k + 1;
      }
    }
    parts[owner].push_back(hole);
  }
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

}  // namespace rondel::map
