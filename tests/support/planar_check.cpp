// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "support/planar_check.h"

#include <gmpxx.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

namespace rondel::test {
namespace {

struct Exact {
  mpq_class x;
  mpq_class y;
  friend bool operator==(const Exact& p, const Exact& q) { return p.x == q.x && p.y == q.y; }
  friend bool operator<(const Exact& p, const Exact& q) {
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  }
};

using ExactRing = std::vector<Exact>;

int turn(const Exact& p, const Exact& q, const Exact& r) {
  return sgn(mpq_class((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)));
}

bool is_on(const Exact& a, const Exact& b, const Exact& p) {
  return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

std::string at(const char* what, const Exact& p) {
  std::ostringstream text;
  text.precision(17);
  text << what << " at " << p.x.get_d() << ' ' << p.y.get_d();
  return text.str();
}

// 1 inside, 0 on the ring, -1 outside.
int place_in(const ExactRing& ring, const Exact& p) {
  bool is_inside = false;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const Exact& a = ring[k];
    const Exact& b = ring[k + 1];
    if (is_on(a, b, p)) return 0;
    if ((a.y > p.y) != (b.y > p.y) && (turn(a, b, p) > 0) == (b.y > a.y)) is_inside = !is_inside;
  }
  return is_inside ? 1 : -1;
}

// The place of a ring that does not cross the other one: that of its first corner or middle of a side that is not on the other ring.
int place_of(const ExactRing& ring, const ExactRing& other) {
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const Exact middle{(ring[k].x + ring[k + 1].x) / 2, (ring[k].y + ring[k + 1].y) / 2};
    for (const Exact& p : {ring[k], middle}) {
      if (const int place = place_in(other, p); place != 0) return place;
    }
  }
  return 0;
}

mpq_class area_of_ring(const ExactRing& ring) {
  mpq_class sum = 0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k)
    sum += ring[k].x * ring[k + 1].y - ring[k + 1].x * ring[k].y;
  return sum;
}

struct Side {
  std::size_t ring;
  std::size_t index;
  double west;
  double east;
  double south;
  double north;
  Exact a;
  Exact b;
};

// Whether two sides have more than a position in common, or cross. A position is given back in `touched`.
bool is_bad_meeting(const Side& s, const Side& t, std::vector<Exact>& touched) {
  const int c = turn(s.a, s.b, t.a);
  const int d = turn(s.a, s.b, t.b);
  const int a = turn(t.a, t.b, s.a);
  const int b = turn(t.a, t.b, s.b);
  if (c * d < 0 && a * b < 0) return true;
  for (const Exact& p : {t.a, t.b}) {
    if (is_on(s.a, s.b, p)) touched.push_back(p);
  }
  for (const Exact& p : {s.a, s.b}) {
    if (is_on(t.a, t.b, p)) touched.push_back(p);
  }
  std::ranges::sort(touched, [](const Exact& p, const Exact& q) { return p < q; });
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched.size() > 1;
}

class Checker {
 public:
  explicit Checker(const PlanarRegion& region) {
    for (std::size_t polygon = 0; polygon < region.size(); ++polygon) {
      for (std::size_t r = 0; r < region[polygon].size(); ++r) {
        ExactRing& ring = rings_.emplace_back();
        for (const LonLat& p : region[polygon][r]) ring.push_back({p.lon_deg, p.lat_deg});
        polygons_.push_back(polygon);
        is_outer_.push_back(r == 0);
      }
    }
  }

  std::string why() {
    for (const auto check : {&Checker::check_rings, &Checker::check_sides, &Checker::check_nesting,
                             &Checker::check_connected}) {
      if (std::string found = (this->*check)(); !found.empty()) return found;
    }
    return {};
  }

 private:
  std::string check_rings() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const ExactRing& ring = rings_[r];
      if (ring.size() < 4 || !(ring.front() == ring.back())) return "a ring is not closed";
      if (sgn(area_of_ring(ring)) != (is_outer_[r] ? 1 : -1))
        return at("a ring is turned over", ring[0]);
      for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
        if (ring[k] == ring[k + 1]) return at("a position is repeated", ring[k]);
        const auto [west, east] = std::minmax({ring[k].x.get_d(), ring[k + 1].x.get_d()});
        const auto [south, north] = std::minmax({ring[k].y.get_d(), ring[k + 1].y.get_d()});
        sides_.push_back({r, k, west, east, south, north, ring[k], ring[k + 1]});
      }
    }
    return {};
  }

  std::string check_sides() {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Side& s = sides_[i];
        const Side& t = sides_[j];
        if (are_apart(s, t)) continue;
        std::vector<Exact> touched;
        if (is_bad_meeting(s, t, touched)) return at("sides cross or overlap", s.a);
        if (touched.empty()) continue;
        if (s.ring != t.ring) {
          touches_[touched[0]].insert({s.ring, 0});
          touches_[touched[0]].insert({t.ring, 0});
        } else if (const std::size_t n = rings_[s.ring].size() - 1;
                   (s.index + 1) % n != t.index && (t.index + 1) % n != s.index) {
          return at("a ring touches itself", touched[0]);
        }
      }
    }
    return {};
  }

  static bool are_apart(const Side& s, const Side& t) {
    return s.east < t.west || t.east < s.west || s.north < t.south || t.north < s.south;
  }

  // A side of a ring that crosses another one in a common corner lies on both sides of it.
  std::string check_nesting() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      std::vector<int> covers(rings_.size());
      for (std::size_t other = 0; other < rings_.size(); ++other) {
        if (other == r) continue;
        for (std::size_t k = 0; k + 1 < rings_[r].size(); ++k) {
          const Exact& a = rings_[r][k];
          const Exact& b = rings_[r][k + 1];
          const int place = place_in(rings_[other], {(a.x + b.x) / 2, (a.y + b.y) / 2});
          if (place != 0 && covers[other] == -place) return at("rings cross", a);
          if (place != 0) covers[other] = place;
        }
        const bool is_own = polygons_[r] == polygons_[other];
        const bool is_inside = place_of(rings_[r], rings_[other]) > 0;
        if (is_own && is_outer_[other] && !is_inside) return at("a hole is outside", rings_[r][0]);
        if (is_own && !is_outer_[other] && is_inside)
          return at("a ring lies in a hole of its polygon", rings_[r][0]);
      }
      if (const std::string found = check_overlap(r); !found.empty()) return found;
    }
    return {};
  }

  // An outer ring inside of another polygon's has to lie in one of its holes.
  std::string check_overlap(std::size_t r) {
    if (!is_outer_[r]) return {};
    for (std::size_t other = 0; other < rings_.size(); ++other) {
      if (other == r || !is_outer_[other] || place_of(rings_[r], rings_[other]) <= 0) continue;
      bool is_in_hole = false;
      for (std::size_t hole = 0; hole < rings_.size(); ++hole) {
        is_in_hole = is_in_hole || (polygons_[hole] == polygons_[other] && !is_outer_[hole] &&
                                    place_of(rings_[r], rings_[hole]) > 0);
      }
      if (!is_in_hole) return at("polygons overlap", rings_[r][0]);
    }
    return {};
  }

  // Rings of a polygon and the positions where they touch, as a graph without circles.
  std::string check_connected() {
    std::vector<std::size_t> parents(rings_.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    const auto root = [&](std::size_t r) {
      while (parents[r] != r) r = parents[r];
      return r;
    };
    for (const auto& [position, rings] : touches_) {
      std::map<std::size_t, std::vector<std::size_t>> by_polygon;
      for (const auto& [ring, unused] : rings) by_polygon[polygons_[ring]].push_back(ring);
      for (const auto& [polygon, own] : by_polygon) {
        for (std::size_t k = 1; k < own.size(); ++k) {
          const std::size_t x = root(own[0]);
          const std::size_t y = root(own[k]);
          if (x == y) return at("the inside is not connected", position);
          parents[y] = x;
        }
      }
    }
    return {};
  }

  std::vector<ExactRing> rings_;
  std::vector<std::size_t> polygons_;
  std::vector<bool> is_outer_;
  std::vector<Side> sides_;
  std::map<Exact, std::map<std::size_t, int>> touches_;
};

}  // namespace

std::string why_invalid(const PlanarRegion& region) { return Checker(region).why(); }

}  // namespace rondel::test
