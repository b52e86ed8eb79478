// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Why the arcs have the topology of the lines. Let two arcs have the same longitudes at both ends, and be in the same
// order there. In the gnomonic plane of a point between them meridians are lines, and arcs are segments that go from one
// of these to the other: they do not cross, nor touch but at an end. So it suffices that each arc has a corner on the
// meridian of every corner to which it comes nearer than it may be from its line, on the line: at such a meridian the order
// is that of the plane, at every other one the distance is larger than what could change it.
//
// A corner that is added may be near to a third line, which then gets one on the same meridian: no meridians but those of
// the first corners occur, so that ends.
#include "overlay/plane_arcs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "exact/degrees.h"
#include "exact/vector.h"
#include "overlay/plane.h"
#include "overlay/plane_corners.h"
#include "rondel/delaunay.h"
#include "system/parallel.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t pieces_per_block = 4096;
constexpr double rad_per_deg = std::numbers::pi / 180;

class LineDivider {
 public:
  LineDivider(double tolerance, std::vector<LonLat>& positions)
      : squared_tolerance_(tolerance * tolerance), positions_(positions) {}

  // The middle is the same both ways.
  void append_between(const LonLat& from, const Point& p, const LonLat& to, const Point& q,
                      unsigned depth) const {
    constexpr unsigned most_halvings = 30;
    const LonLat middle = middle_of(from, to);
    if (depth == most_halvings || is_straight(from, p, to, q, middle)) {
      positions_.push_back(from);
      return;
    }
    const Point m = unit_vector(middle);
    append_between(from, p, middle, m, depth + 1);
    append_between(middle, m, to, q, depth + 1);
  }

 private:
  [[nodiscard]] bool is_straight(const LonLat& from, const Point& p, const LonLat& to,
                                 const Point& q, const LonLat& middle) const {
    constexpr double most_degrees = 90;
    if (p == q && std::abs(from.lat_deg) == 90) return true;
    if (std::abs(to.lon_deg - from.lon_deg) > most_degrees ||
        std::abs(to.lat_deg - from.lat_deg) > most_degrees)
      return false;
    if (from.lon_deg == to.lon_deg) return true;
    const Point m = normalized(p + q);
    if (!is_near(m, middle)) return false;
    // On one side of the equator an arc bends one way, and is farthest from the line about the middle. Across the equator
    // it bends both ways, and may meet the line there.
    if (!(from.lat_deg * to.lat_deg < 0)) return true;
    return is_near(normalized(p + m), middle_of(from, middle)) &&
           is_near(normalized(m + q), middle_of(middle, to));
  }

  [[nodiscard]] bool is_near(const Point& of_arc, const LonLat& of_line) const {
    const Point off = of_arc - unit_vector(of_line);
    return dot(off, off) <= squared_tolerance_;
  }

  static LonLat middle_of(const LonLat& a, const LonLat& b) {
    return {(a.lon_deg + b.lon_deg) / 2, (a.lat_deg + b.lat_deg) / 2};
  }

  double squared_tolerance_;
  std::vector<LonLat>& positions_;
};

// A piece of a side, which has a number; it goes from west to east.
struct LinePiece {
  Index side;
  LonLat west;
  LonLat east;
};

// The largest distance in latitude of an arc from its straight line, in degrees. Along a great circle the latitude f has the second
// derivative -sin f cos f - 2 tan f (f')^2 by longitude, and a function is within w^2/8 of that from its chord; twice
// that, as f may leave the line.
double bulge_deg(const LonLat& west, const LonLat& east) {
  const double width = (east.lon_deg - west.lon_deg) * rad_per_deg;
  const double height = std::abs(east.lat_deg - west.lat_deg) * rad_per_deg;
  const double near = std::min(std::abs(west.lat_deg), std::abs(east.lat_deg));
  const double far = std::max(std::abs(west.lat_deg), std::abs(east.lat_deg));
  const bool meets_equator = west.lat_deg * east.lat_deg < 0;
  const auto [sine, cosine] = exact::sine_cosine_of_degrees(far);
  const double most_cosine = meets_equator ? 1 : exact::sine_cosine_of_degrees(near).cosine;
  const double level = width * width / 8 * std::min({0.5, sine, most_cosine});
  const double slope = cosine > height ? sine / cosine * height * height / 4 : height;
  return 2 * (level + std::min(slope, height)) / rad_per_deg;
}

bool is_pole(const LonLat& p) { return std::abs(p.lat_deg) == 90; }

double lat_on(const LinePiece& piece, double lon_deg) {
  return piece.west.lat_deg + (lon_deg - piece.west.lon_deg) /
                                  (piece.east.lon_deg - piece.west.lon_deg) *
                                  (piece.east.lat_deg - piece.west.lat_deg);
}

// Positions on the piece, from west to east, on the meridians of corners that are near.
void find_cuts(const LinePiece& piece, const PlaneCorners& corners, std::vector<LonLat>& cuts) {
  cuts.clear();
  if (piece.west.lon_deg == piece.east.lon_deg || (is_pole(piece.west) && is_pole(piece.east)))
    return;
  const double bulge = bulge_deg(piece.west, piece.east) + on_side_deg;
  corners.visit_near(piece.west, piece.east, bulge, [&](const LonLat& p, Index) {
    if (p.lon_deg <= piece.west.lon_deg || p.lon_deg >= piece.east.lon_deg) return;
    const double lat = lat_on(piece, p.lon_deg);
    if (std::abs(p.lat_deg - lat) <= bulge) cuts.push_back({p.lon_deg, lat});
  });
  std::ranges::sort(cuts, is_west_of);
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
}

// Divides the pieces at the corners; returns those that are new.
std::vector<LonLat> divide_at(const PlaneCorners& corners, std::vector<LinePiece>& pieces,
                              unsigned threads) {
  std::vector<std::vector<std::pair<std::size_t, std::vector<LonLat>>>> found(
      system::num_pieces(pieces.size(), pieces_per_block));
  system::parallel_for(threads, pieces.size(), pieces_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         std::vector<LonLat> cuts;
                         for (std::size_t k = begin; k < end; ++k) {
                           find_cuts(pieces[k], corners, cuts);
                           if (!cuts.empty()) found[begin / pieces_per_block].emplace_back(k, cuts);
                         }
                       });
  std::vector<LonLat> added;
  for (const auto& of_block : found) {
    for (const auto& [k, cuts] : of_block) {
      const LonLat east = pieces[k].east;
      pieces[k].east = cuts.front();
      for (std::size_t i = 0; i < cuts.size(); ++i) {
        pieces.push_back({pieces[k].side, cuts[i], i + 1 < cuts.size() ? cuts[i + 1] : east});
      }
      added.insert(added.end(), cuts.begin(), cuts.end());
    }
  }
  return added;
}

PlaneCorners corners_at(std::span<const LonLat> positions) {
  std::vector<PlaneCorners::OwnedCorner> corners;
  corners.reserve(positions.size());
  for (const LonLat& p : positions) {
    if (!is_pole(p)) corners.push_back({p, no_index});
  }
  return PlaneCorners(std::move(corners));
}

}  // namespace

void append_divided(const LonLat& from, const LonLat& to, double tolerance,
                    std::vector<LonLat>& positions) {
  LineDivider(tolerance, positions).append_between(from, unit_vector(from), to, unit_vector(to), 0);
}

DividedSides divide_sides(std::span<const PlaneSide> sides, double tolerance, unsigned threads) {
  std::vector<LinePiece> pieces;
  std::vector<LonLat> added;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const bool goes_east = is_west_of(sides[s].from, sides[s].to);
    const auto [west, east] =
        goes_east ? std::pair(sides[s].from, sides[s].to) : std::pair(sides[s].to, sides[s].from);
    const std::size_t first = added.size();
    append_divided(west, east, tolerance, added);
    for (std::size_t k = first; k < added.size(); ++k) {
      pieces.push_back(
          {static_cast<Index>(s), added[k], k + 1 < added.size() ? added[k + 1] : east});
    }
  }
  // The last corner of a side is the first one of another.
  for (const PlaneSide& side : sides) added.push_back(side.to);
  while (!added.empty()) added = divide_at(corners_at(added), pieces, threads);

  std::ranges::sort(pieces, [](const LinePiece& p, const LinePiece& q) {
    return p.side != q.side ? p.side < q.side : is_west_of(p.west, q.west);
  });
  DividedSides result;
  result.positions.reserve(pieces.size());
  for (std::size_t first = 0; first < pieces.size();) {
    std::size_t end = first;
    while (end < pieces.size() && pieces[end].side == pieces[first].side) ++end;
    const bool goes_east = is_west_of(sides[pieces[first].side].from, sides[pieces[first].side].to);
    for (std::size_t k = first; k < end; ++k) {
      result.positions.push_back(goes_east ? pieces[k].west : pieces[first + (end - 1 - k)].east);
    }
    result.offsets.push_back(result.positions.size());
    first = end;
  }
  return result;
}

}  // namespace rondel::overlay
