// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "unit/overlay/oracle.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "support/random.h"

namespace rondel::test {
namespace {

template <class N>
OracleVector<N> minus(const OracleVector<N>& a, const OracleVector<N>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
OracleVector<N> plus(const OracleVector<N>& a, const OracleVector<N>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
OracleVector<N> times(const N& s, const OracleVector<N>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class N>
N scalar(const OracleVector<N>& a, const OracleVector<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
OracleVector<N> product(const OracleVector<N>& a, const OracleVector<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class N>
OracleVector<N> unit(const OracleVector<N>& a) {
  using std::sqrt;
  const N length = sqrt(scalar(a, a));
  return {a.x / length, a.y / length, a.z / length};
}
// Of unit vectors.
template <class N>
N volume(const OracleVector<N>& a, const OracleVector<N>& b, const OracleVector<N>& c) {
  return scalar(a, product(minus(b, a), minus(c, a)));
}

template <class N>
OracleVector<N> vector_of(const OraclePoint& p) {
  if constexpr (std::is_same_v<N, Wide>) {
    return p.wide();
  } else {
    return p.extended();
  }
}
template <class N>
OracleVector<N> vector_of(const Point& p) {
  return {N(p.x), N(p.y), N(p.z)};
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

// From -1 to 1, of the coordinates.
double noise(const Point& p, std::uint64_t axis) {
  std::uint64_t bits = axis * 0x9e3779b97f4a7c15;
  for (const double x : {p.x, p.y, p.z}) {
    bits = (bits ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0xbf58476d1ce4e5b9;
    bits ^= bits >> 29;
    bits *= 0x94d049bb133111eb;
    bits ^= bits >> 32;
  }
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

// The sign of det(a, b, c), which is never 0 but for equal points.
int side_of(const OraclePoint& a, const OraclePoint& b, const OraclePoint& c) {
  constexpr double relative = 1e-14;
  constexpr double least = 1e-45;
  const Point& p = a.rounded();
  const Point ab = {b.rounded().x - p.x, b.rounded().y - p.y, b.rounded().z - p.z};
  const Point ac = {c.rounded().x - p.x, c.rounded().y - p.y, c.rounded().z - p.z};
  const double value = p.x * (ab.y * ac.z - ab.z * ac.y) + p.y * (ab.z * ac.x - ab.x * ac.z) +
                       p.z * (ab.x * ac.y - ab.y * ac.x);
  const double size_b = std::sqrt(ab.x * ab.x + ab.y * ab.y + ab.z * ab.z);
  const double size_c = std::sqrt(ac.x * ac.x + ac.y * ac.y + ac.z * ac.z);
  const double bound = relative * size_b * size_c +
                       4 * (a.error() + b.error() + c.error()) * (size_b + size_c) + least;
  if (value > bound) return 1;
  if (value < -bound) return -1;
  const Wide exact = volume(a.wide(), b.wide(), c.wide());
  return exact > 0 ? 1 : (exact < 0 ? -1 : 0);
}

// The area of the triangle, negative if it is clockwise; `below` is at least the denominator.
template <class N>
N triangle(const OracleVector<N>& a, const OracleVector<N>& b, const OracleVector<N>& c, N& below) {
  using std::atan2;
  const N denominator = 1 + scalar(a, b) + scalar(b, c) + scalar(c, a);
  if (denominator < below) below = denominator;
  return 2 * atan2(volume(a, b, c), denominator);
}

template <class N>
using Corners = std::vector<OracleVector<N>>;

// What of a convex polygon is on the side of the plane to which the normal points.
template <class N>
void cut(const OracleVector<N>& normal, Corners<N>& ring, Corners<N>& scratch) {
  scratch.clear();
  const std::size_t n = ring.size();
  N at_p = n > 0 ? scalar(normal, ring[0]) : N(0);
  for (std::size_t i = 0; i < n; ++i) {
    const OracleVector<N>& p = ring[i];
    const OracleVector<N>& q = ring[i + 1 < n ? i + 1 : 0];
    const N at_q = scalar(normal, q);
    if (at_p >= 0) scratch.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const N t = at_p / (at_p - at_q);
      scratch.push_back(unit(plus(p, times(t, minus(q, p)))));
    }
    at_p = at_q;
  }
  ring.swap(scratch);
}

template <class N>
N fan(const Corners<N>& ring, N& below) {
  N sum(0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += triangle(ring[0], ring[i], ring[i + 1], below);
  }
  return sum;
}

// Of a convex cell, of which the corners may be no unit vectors.
template <class N>
N area_of_cell(const OracleCell& cell) {
  Corners<N> ring;
  for (const Point& p : cell.corners) ring.push_back(unit(vector_of<N>(p)));
  N below(4);
  return fan(ring, below);
}

}  // namespace

OraclePoint::OraclePoint(const OracleVector<Wide>& computed)
    : rounded_{static_cast<double>(computed.x), static_cast<double>(computed.y),
               static_cast<double>(computed.z)},
      error_(0x1p-52),
      wide_(computed) {}

const OracleVector<Wide>& OraclePoint::wide() const {
  if (!wide_) {
    static const Wide step("1e-50");
    OracleVector<Wide> p = vector_of<Wide>(rounded_);
    p = plus(p, times(step, vector_of<Wide>(Point{noise(rounded_, 1), noise(rounded_, 2),
                                                  noise(rounded_, 3)})));
    wide_ = unit(p);
  }
  return *wide_;
}

OracleVector<long double> OraclePoint::extended() const {
  if (error_ == 0) return unit(vector_of<long double>(rounded_));
  return {static_cast<long double>(wide_->x), static_cast<long double>(wide_->y),
          static_cast<long double>(wide_->z)};
}

OracleCell::OracleCell(std::vector<Point> ring) : corners(std::move(ring)) {
  for (const Point& p : corners) center = {center.x + p.x, center.y + p.y, center.z + p.z};
  const double length = std::hypot(center.x, center.y, center.z);
  center = {center.x / length, center.y / length, center.z / length};
  for (const Point& p : corners) radius = std::max(radius, distance(center, p));
}

namespace {

using Ends = std::pair<std::size_t, std::size_t>;

// Sets of numbers that have become one.
class Joined {
 public:
  explicit Joined(std::size_t size) : firsts_(size) {
    std::iota(firsts_.begin(), firsts_.end(), std::size_t{0});
  }
  std::size_t operator[](std::size_t k) {
    while (firsts_[k] != k) k = firsts_[k] = firsts_[firsts_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { firsts_[(*this)[a]] = (*this)[b]; }

 private:
  std::vector<std::size_t> firsts_;
};

// Sides between different places, without those that run to and fro.
struct NetSides {
  std::vector<Point> places;
  std::vector<OracleSide> sides;
  std::vector<Ends> ends;
  std::vector<int> counts;
};

NetSides net_sides(const std::vector<std::vector<Point>>& rings) {
  NetSides net;
  std::map<std::tuple<double, double, double>, std::size_t> names;
  std::map<Ends, int> counts;
  for (const std::vector<Point>& ring : rings) {
    std::vector<std::size_t> of_ring;
    for (const Point& p : ring) {
      const auto [known, is_new] =
          names.emplace(std::tuple(p.x + 0.0, p.y + 0.0, p.z + 0.0), net.places.size());
      if (is_new) net.places.push_back(p);
      of_ring.push_back(known->second);
    }
    for (std::size_t k = 0; k < of_ring.size(); ++k) {
      const std::size_t from = of_ring[k];
      const std::size_t to = of_ring[k + 1 < of_ring.size() ? k + 1 : 0];
      if (from != to) counts[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [pair, count] : counts) {
    if (count == 0) continue;
    const auto [from, to] = count > 0 ? pair : Ends(pair.second, pair.first);
    net.sides.push_back({OraclePoint(net.places[from]), OraclePoint(net.places[to])});
    net.ends.emplace_back(from, to);
    net.counts.push_back(std::abs(count));
  }
  return net;
}

// In the middle of what is small. Of what is not, the point whose antipode is farthest from all sides.
OraclePoint origin_of(const std::vector<OracleSide>& sides, const std::vector<std::size_t>& some) {
  constexpr double small = 0.3;
  constexpr int num_tries = 24;
  Point middle{};
  for (const std::size_t s : some) {
    const Point& p = sides[s].from.rounded();
    middle = {middle.x + p.x, middle.y + p.y, middle.z + p.z};
  }
  const double length = std::hypot(middle.x, middle.y, middle.z);
  if (length > 0) {
    middle = {middle.x / length, middle.y / length, middle.z / length};
    double radius = 0;
    for (const std::size_t s : some) {
      radius = std::max(radius, distance(middle, sides[s].from.rounded()));
    }
    // Not at a corner, though.
    if (radius < small) {
      return OraclePoint(
          Point{middle.x + 0.11 * radius, middle.y + 0.07 * radius, middle.z - 0.05 * radius});
    }
  }
  Random random(0x6f726967696e);  // none of the corners
  double best = -1;
  Point chosen{};
  for (int k = 0; k < num_tries; ++k) {
    const Point candidate = random.direction();
    double least = 4;
    for (const std::size_t s : some) {
      const auto o = vector_of<long double>(candidate);
      const auto a = sides[s].from.extended();
      const auto b = sides[s].to.extended();
      const auto below = 1 + scalar(o, a) + scalar(a, b) + scalar(b, o);
      least = std::min(least, static_cast<double>(std::hypot(below, volume(o, a, b))));
    }
    if (least <= best) continue;
    best = least;
    chosen = candidate;
  }
  return OraclePoint(chosen);
}

bool do_cross(const OracleSide& s, const OracleSide& t) {
  const int turn = side_of(s.from, t.from, s.to);
  return side_of(t.from, s.to, t.to) == turn && side_of(s.to, t.to, s.from) == turn &&
         side_of(t.to, s.from, t.from) == turn;
}

OraclePoint crossing_of(const OracleSide& s, const OracleSide& t) {
  const OracleVector<Wide>& a = s.from.wide();
  const OracleVector<Wide>& b = s.to.wide();
  OracleVector<Wide> place = unit(product(product(a, b), product(t.from.wide(), t.to.wide())));
  if (scalar(place, plus(a, b)) < 0) place = times(Wide(-1), place);
  return OraclePoint(place);
}

// Of each side, where others cross it, in order; sides that cross are joined.
std::vector<std::vector<OraclePoint>> crossings(const NetSides& net, Joined& joined) {
  struct Range {
    double low;
    double high;
    std::size_t side;
  };
  std::vector<Range> ranges;
  for (std::size_t s = 0; s < net.sides.size(); ++s) {
    const Point& a = net.sides[s].from.rounded();
    const Point& b = net.sides[s].to.rounded();
    const double bulge = distance(a, b) * distance(a, b) / 4 + 1e-15;
    ranges.push_back({std::min(a.x, b.x) - bulge, std::max(a.x, b.x) + bulge, s});
  }
  std::ranges::sort(ranges, {}, &Range::low);
  std::vector<std::vector<OraclePoint>> cuts(net.sides.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    for (std::size_t k = i + 1; k < ranges.size() && ranges[k].low <= ranges[i].high; ++k) {
      const std::size_t s = ranges[i].side;
      const std::size_t t = ranges[k].side;
      const auto& [a, b] = net.ends[s];
      const auto& [c, d] = net.ends[t];
      if (a == c || a == d || b == c || b == d || !do_cross(net.sides[s], net.sides[t])) continue;
      cuts[s].push_back(crossing_of(net.sides[s], net.sides[t]));
      cuts[t].push_back(cuts[s].back());
      joined.join(a, c);
    }
  }
  for (std::size_t s = 0; s < net.sides.size(); ++s) {
    const OracleVector<Wide>& from = net.sides[s].from.wide();
    std::ranges::sort(cuts[s], {}, [&](const OraclePoint& p) {
      const OracleVector<Wide> step = minus(p.wide(), from);
      return scalar(step, step);
    });
  }
  return cuts;
}

// Pieces that follow each other at a corner where nothing else begins or ends have the same on their left: the first of
// them for each.
std::vector<std::size_t> chains_of(const NetSides& net,
                                   const std::vector<std::vector<OraclePoint>>& cuts) {
  std::vector<std::array<std::size_t, 2>> degrees(net.places.size());
  std::vector<std::size_t> last_of(net.places.size());
  std::vector<std::size_t> counts;
  std::size_t size = 0;
  for (std::size_t s = 0; s < net.sides.size(); ++s) {
    size += cuts[s].size() + 1;
    ++degrees[net.ends[s].first][0];
    ++degrees[net.ends[s].second][1];
    last_of[net.ends[s].second] = s;
  }
  std::vector<std::size_t> begins = {0};
  for (const auto& on_side : cuts) begins.push_back(begins.back() + on_side.size() + 1);
  Joined chains(size);
  for (std::size_t s = 0; s < net.sides.size(); ++s) {
    const std::size_t at = net.ends[s].first;
    if (degrees[at] != std::array<std::size_t, 2>{1, 1}) continue;
    const std::size_t before = last_of[at];
    if (net.counts[before] == net.counts[s]) chains.join(begins[s], begins[before + 1] - 1);
  }
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < size; ++k) result.push_back(chains[k]);
  return result;
}

}  // namespace

RegionOracle::Piece RegionOracle::piece_of(const OracleSide& side,
                                           std::shared_ptr<const OraclePoint> origin, int count) {
  const Point& o = origin->rounded();
  const double radius = std::max(distance(o, side.from.rounded()), distance(o, side.to.rounded()));
  const int turn = side_of(*origin, side.from, side.to);
  return {side, std::move(origin), radius, turn, count};
}

RegionOracle::RegionOracle(const std::vector<std::vector<Point>>& rings) {
  const NetSides net = net_sides(rings);
  for (const std::vector<Point>& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      length_ += distance(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
    }
  }
  num_sides_ = net.sides.size();
  if (net.sides.empty()) return;
  Joined joined(net.places.size());
  for (const auto& [from, to] : net.ends) {
    joined.join(from, to);
  }
  const std::vector<std::vector<OraclePoint>> cuts = crossings(net, joined);
  std::map<std::size_t, std::vector<std::size_t>> parts;
  for (std::size_t s = 0; s < net.sides.size(); ++s) {
    parts[joined[net.ends[s].first]].push_back(s);
  }
  std::map<std::size_t, std::shared_ptr<const OraclePoint>> origins;
  for (const auto& [first, some] : parts) {
    origins[first] = std::make_shared<const OraclePoint>(origin_of(net.sides, some));
  }
  std::vector<Piece> pieces;
  for (std::size_t s = 0; s < net.sides.size(); ++s) {
    OraclePoint from = net.sides[s].from;
    const auto& origin = origins[joined[net.ends[s].first]];
    for (const OraclePoint& cut : cuts[s]) {
      pieces.push_back(piece_of({from, cut}, origin, net.counts[s]));
      from = cut;
    }
    pieces.push_back(piece_of({from, net.sides[s].to}, origin, net.counts[s]));
  }
  wind(pieces, chains_of(net, cuts));
  choose_inside(pieces);
}

// The signs of the triangles that have a place, but for one of them.
int RegionOracle::turns_around(const std::vector<Piece>& pieces, const OraclePoint& place,
                               std::size_t without) {
  int around = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i];
    const OraclePoint& o = *piece.origin;
    if (i == without) continue;
    if (piece.radius < 1 && distance(o.rounded(), place.rounded()) > piece.radius + 1e-12) continue;
    if (side_of(o, piece.side.from, place) == piece.turn &&
        side_of(piece.side.to, o, place) == piece.turn &&
        side_of(piece.side.from, piece.side.to, place) == piece.turn) {
      around += piece.turn * piece.count;
    }
  }
  return around;
}

// How often the pieces go around what is left and right of each of them, but for a constant.
void RegionOracle::wind(std::vector<Piece>& pieces, const std::vector<std::size_t>& chains) {
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (chains[k] != k) continue;
    const auto& [from, to] = pieces[k].side;
    const OraclePoint middle(unit(plus(from.wide(), to.wide())));
    pieces[k].left = turns_around(pieces, middle, k) + (pieces[k].turn > 0 ? pieces[k].count : 0);
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    pieces[k].left = pieces[chains[k]].left;
    pieces[k].right = pieces[k].left - pieces[k].count;
  }
}

// What is inside of a border is left of its first piece.
int RegionOracle::constant_of(const std::vector<Piece>& border) {
  const auto& [from, to] = border.front().side;
  const OraclePoint middle(unit(plus(from.wide(), to.wide())));
  return 1 - turns_around(border, middle, 0) - (border.front().turn > 0 ? 1 : 0);
}

// The border of what the pieces go around so often at least.
std::vector<RegionOracle::Piece> RegionOracle::level_set(const std::vector<Piece>& pieces,
                                                         int level) {
  std::vector<Piece> border;
  for (const Piece& piece : pieces) {
    if (!(piece.right < level && level <= piece.left)) continue;
    border.push_back(piece);
    border.back().count = 1;
  }
  return border;
}

Wide RegionOracle::area_of(const std::vector<Piece>& border) {
  Wide sum(0);
  if (border.empty()) return sum;
  static const Wide sphere = 16 * atan(Wide(1));
  sum = constant_of(border) * sphere;
  Wide below(4);
  for (const Piece& piece : border) {
    sum += triangle(piece.origin->wide(), piece.side.from.wide(), piece.side.to.wide(), below);
  }
  return sum;
}

// Of the levels, the one that leaves the least that is neither inside once nor outside.
void RegionOracle::choose_inside(const std::vector<Piece>& pieces) {
  int lowest = pieces.front().right;
  int highest = pieces.front().left;
  for (const Piece& piece : pieces) {
    lowest = std::min(lowest, piece.right);
    highest = std::max(highest, piece.left);
  }
  int inside = highest;
  if (highest - lowest > 1) {
    const Wide sphere = 16 * atan(Wide(1));
    std::map<int, Wide> above;
    for (int level = lowest + 1; level <= highest; ++level) {
      above[level] = area_of(level_set(pieces, level));
    }
    excess_ = std::numeric_limits<double>::infinity();
    for (int level = lowest + 1; level <= highest; ++level) {
      Wide excess(0);
      for (const auto& [other, area] : above) {
        if (other > level) excess += area;
        if (other < level) excess += sphere - area;
      }
      if (static_cast<double>(excess) >= excess_) continue;
      excess_ = static_cast<double>(excess);
      inside = level;
    }
  }
  border_ = level_set(pieces, inside);
  constant_ = constant_of(border_);
}

namespace {

// Each cut moves a side by a few roundings of 2^-64, an area by these times its length; an angle is worse off by the
// denominator.
template <class N>
OracleAnswer answer_of(const N& area, double length, const N& below) {
  constexpr double roundings = 1e-17;
  if constexpr (std::is_same_v<N, Wide>) {
    return {static_cast<double>(area), 1e-40};
  } else {
    const double smallness = std::max(static_cast<double>(below), 1e-10);
    const auto rounded = static_cast<double>(area);
    return {rounded, roundings * length * 4 / smallness + 0x1p-52 * std::abs(rounded) + 1e-25};
  }
}

}  // namespace

template <class N>
OracleAnswer RegionOracle::area_in() const {
  using std::atan;
  N sum = constant_ * (16 * atan(N(1)));
  N below(4);
  double length = constant_ != 0 ? 12 : 0;
  for (const Piece& piece : border_) {
    sum += triangle(vector_of<N>(*piece.origin), vector_of<N>(piece.side.from),
                    vector_of<N>(piece.side.to), below);
    length += 4 * piece.radius;
  }
  return answer_of(sum, length, below);
}

// By how much a rounding of the ends of a cell's sides moves their great circles elsewhere in the cell, at most.
double leverage_of(const OracleCell& cell) {
  double shortest = cell.radius;
  for (std::size_t k = 0; k < cell.corners.size(); ++k) {
    shortest =
        std::min(shortest, distance(cell.corners[k], cell.corners[(k + 1) % cell.corners.size()]));
  }
  return cell.radius / shortest;
}

// The triangles of each side of a region, cut by the sides of a cell, with their signs.
template <class N>
OracleAnswer RegionOracle::piece_in_cell(const OracleCell& cell) const {
  N sum(0);
  N below(4);
  double length = 0;
  std::vector<OracleVector<N>> normals;
  Corners<N> ring;
  Corners<N> scratch;
  for (const Piece& piece : border_) {
    const Point& o = piece.origin->rounded();
    if (piece.radius < 1 && distance(o, cell.center) > piece.radius + cell.radius + 1e-12) continue;
    ring = {vector_of<N>(*piece.origin), vector_of<N>(piece.side.from),
            vector_of<N>(piece.side.to)};
    if (piece.turn < 0) std::swap(ring[1], ring[2]);
    if (normals.empty()) {
      for (std::size_t k = 0; k < cell.corners.size(); ++k) {
        const auto a = vector_of<N>(cell.corners[k]);
        const auto b = vector_of<N>(cell.corners[(k + 1) % cell.corners.size()]);
        normals.push_back(product(a, minus(b, a)));
      }
    }
    for (const OracleVector<N>& normal : normals) {
      cut(normal, ring, scratch);
      if (ring.size() < 3) break;
    }
    if (ring.size() < 3) continue;
    const N area = fan(ring, below);
    sum += piece.turn > 0 ? area : N(-area);
    length += 4 * piece.radius;
  }
  if (constant_ != 0) {
    sum += constant_ * area_of_cell<N>(cell);
    length += 6 * cell.radius;
  }
  return answer_of(sum, length * leverage_of(cell), below);
}

namespace {

// Over the part of an arc in the box's longitudes, the integral of how far the top of the box is above it, at most down
// to the bottom.
template <class N>
class BoxIntegral {
 public:
  explicit BoxIntegral(const OracleBox& box) {
    using std::atan;
    using std::cos;
    using std::sin;
    const N degree = atan(N(1)) / 45;
    const auto sine = [&](double deg) {
      return std::abs(deg) == 90 ? N(deg / 90) : N(sin(N(deg) * degree));
    };
    bottom_ = sine(box.south);
    top_ = sine(box.north);
    const N west = N(box.west) * degree;
    const N east = N(box.east) * degree;
    width_ = east - west;
    from_west_ = {-sin(west), cos(west), N(0)};
    from_east_ = {sin(east), -cos(east), N(0)};
  }
  [[nodiscard]] N area() const { return (top_ - bottom_) * width_; }

  N operator()(OracleVector<N> p, OracleVector<N> q) {
    if (!cut_arc(from_west_, p, q) || !cut_arc(from_east_, p, q)) return N(0);
    // Along the arc z = height cos(t - t0) for the angle t, by the highest point of its great circle.
    const OracleVector<N> normal = unit(product(p, minus(q, p)));
    const OracleVector<N> pole{N(0), N(0), N(1)};
    OracleVector<N> highest = minus(pole, times(normal.z, normal));
    std::vector<OracleVector<N>> stops = {p};
    using std::sqrt;
    const N height2 = scalar(highest, highest);
    if (height2 > 0) {
      const N height = sqrt(height2);
      highest = times(N(1) / height, highest);
      const OracleVector<N> across = product(normal, highest);
      std::vector<std::pair<N, OracleVector<N>>> found;
      for (const N& level : {bottom_, top_}) {
        const N cosine = level / height;
        if (!(cosine * cosine < 1)) continue;
        const N sine = sqrt(1 - cosine * cosine);
        for (const N& s : {sine, N(-sine)}) {
          const OracleVector<N> x = plus(times(cosine, highest), times(s, across));
          // Between p and q.
          if (scalar(normal, product(p, x)) > 0 && scalar(normal, product(x, q)) > 0) {
            const OracleVector<N> step = minus(x, p);
            found.emplace_back(scalar(step, step), x);
          }
        }
      }
      std::ranges::sort(found, [](const auto& a, const auto& b) { return a.first < b.first; });
      for (const auto& [place, x] : found) stops.push_back(x);
    }
    stops.push_back(q);
    N sum(0);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) sum += between(stops[k], stops[k + 1]);
    return sum;
  }

 private:
  static bool cut_arc(const OracleVector<N>& normal, OracleVector<N>& p, OracleVector<N>& q) {
    const N at_p = scalar(normal, p);
    const N at_q = scalar(normal, q);
    if (at_p < 0 && at_q < 0) return false;
    if (at_p >= 0 && at_q >= 0) return true;
    const OracleVector<N> x = unit(plus(p, times(N(at_p / (at_p - at_q)), minus(q, p))));
    (at_p < 0 ? p : q) = x;
    return true;
  }
  // Of a part that is wholly below, within or above.
  [[nodiscard]] N between(const OracleVector<N>& a, const OracleVector<N>& b) const {
    using std::atan2;
    const N turn = atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    const OracleVector<N> middle = unit(plus(a, b));
    if (middle.z >= top_) return N(0);
    if (middle.z <= bottom_) return (top_ - bottom_) * turn;
    N below(4);
    if (middle.z > 0) {
      return triangle(OracleVector<N>{N(0), N(0), N(1)}, a, b, below) - (1 - top_) * turn;
    }
    return (1 + top_) * turn - triangle(OracleVector<N>{N(0), N(0), N(-1)}, b, a, below);
  }

  N bottom_;
  N top_;
  N width_;
  OracleVector<N> from_west_;
  OracleVector<N> from_east_;
};

}  // namespace

template <class N>
OracleAnswer RegionOracle::piece_in_box(const OracleBox& box) const {
  const OraclePoint south(OracleVector<Wide>{Wide(0), Wide(0), Wide(-1)});
  BoxIntegral<N> integral(box);
  const int has_south = constant_ + turns_around(border_, south, border_.size());
  N sum = has_south * integral.area();
  double length = 1;
  for (const Piece& piece : border_) {
    sum += integral(vector_of<N>(piece.side.from), vector_of<N>(piece.side.to));
    length += distance(piece.side.from.rounded(), piece.side.to.rounded());
  }
  constexpr double rounding_of_angles = 2e-15;  // next to a pole, as far as is_near below allows
  OracleAnswer answer = answer_of(sum, length, N(4));
  if constexpr (!std::is_same_v<N, Wide>) answer.error += rounding_of_angles;
  return answer;
}

OracleAnswer RegionOracle::area(bool in_full) const {
  return in_full ? area_in<Wide>() : area_in<long double>();
}

double RegionOracle::missing() const {
  return static_cast<double>(16 * atan(Wide(1)) - area_of(border_));
}

OracleAnswer RegionOracle::piece(const OracleCell& cell, bool in_full) const {
  return in_full ? piece_in_cell<Wide>(cell) : piece_in_cell<long double>(cell);
}

// Next to a pole all depends on the last digits.
OracleAnswer RegionOracle::piece(const OracleBox& box, bool in_full) const {
  constexpr double near = 1e-4;
  const bool is_near = std::ranges::any_of(border_, [](const Piece& piece) {
    const auto a = piece.side.from.extended();
    const auto b = piece.side.to.extended();
    const auto normal = product(a, minus(b, a));
    return std::abs(normal.z) <= near * std::sqrt(scalar(normal, normal));
  });
  return in_full || is_near ? piece_in_box<Wide>(box) : piece_in_box<long double>(box);
}

namespace {

// The sign of det(a, b, c) of the coordinates as they are.
int rational_side(const Point& a, const Point& b, const Point& c) {
  const auto q = [](double x) { return mpq_class(x); };
  const mpq_class value = q(a.x) * (q(b.y) * q(c.z) - q(b.z) * q(c.y)) +
                          q(a.y) * (q(b.z) * q(c.x) - q(b.x) * q(c.z)) +
                          q(a.z) * (q(b.x) * q(c.y) - q(b.y) * q(c.x));
  return sgn(value);
}

}  // namespace

bool has_crossing(const std::vector<std::vector<Point>>& rings) {
  std::vector<std::pair<Point, Point>> sides;
  for (const std::vector<Point>& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      sides.emplace_back(ring[k], ring[k + 1 < ring.size() ? k + 1 : 0]);
    }
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const auto& [a, b] = sides[s];
    const Point middle = {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
    for (std::size_t t = s + 1; t < sides.size(); ++t) {
      const auto& [c, d] = sides[t];
      const Point other = {(c.x + d.x) / 2, (c.y + d.y) / 2, (c.z + d.z) / 2};
      if (distance(middle, other) > distance(a, b) + distance(c, d) + 1e-12) continue;
      const int turn = rational_side(a, c, b);
      if (turn != 0 && rational_side(c, b, d) == turn && rational_side(b, d, a) == turn &&
          rational_side(d, a, c) == turn) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace rondel::test
