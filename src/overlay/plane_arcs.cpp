// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Why the arcs have the topology of the lines. Let two arcs have the same longitudes at both ends,
// and be in the same order there. In the gnomonic plane of a point between them meridians are
// lines, and the arcs are segments from one of these lines to the other: they do not cross, and
// touch at most at an end. So it suffices that each arc has a corner on the meridian of every
// corner to which it comes nearer than it may be from its line, with the corner on the line: at
// such a meridian the order is that of the plane, and at every other one the distance is larger
// than what could change the order.
//
// A corner that is added may be near a third line, which then gets a corner on the same meridian.
// Only the meridians of the first corners occur, so this ends.
#include "overlay/plane_arcs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "exact/angles.h"
#include "exact/vector.h"
#include "overlay/plane.h"
#include "overlay/plane_corners.h"
#include "rondel/delaunay.h"
#include "system/parallel.h"
#include "system/row_assembly.h"

namespace rondel::overlay {
namespace {

constexpr std::size_t pieces_per_block = 4096;
constexpr double rad_per_deg = std::numbers::pi / 180;

// Divides one line until its arcs are within the tolerance.
class LineDivider {
 public:
  LineDivider(double tolerance, std::vector<LonLat>& positions)
      : tolerance_(tolerance), squared_tolerance_(tolerance * tolerance), positions_(positions) {}

  // Appends the first position of a line and those between.
  void append(const LonLat& from, const LonLat& to) const {
    if (is_surely_straight(from, to)) {
      positions_.push_back(from);
    } else {
      append_between(from, unit_vector(from), to, unit_vector(to), 0);
    }
  }

  // Appends the first of two positions and those between. The middle is the same in both directions
  // of the line.
  void append_between(const LonLat& from, const Point& p, const LonLat& to, const Point& q,
                      unsigned depth) const {
    constexpr unsigned max_halvings = 30;
    const std::optional<bool> known =
        depth == max_halvings ? true : is_straight_by_ends(from, p, to, q);
    if (known && *known) {
      positions_.push_back(from);
      return;
    }
    const LonLat middle = middle_of(from, to);
    const Point m = unit_vector(middle);
    if (!known && is_straight(from, p, to, q, middle, m)) {
      positions_.push_back(from);
      return;
    }
    append_between(from, p, middle, m, depth + 1);
    append_between(middle, m, to, q, depth + 1);
  }

 private:
  // True if a bound shows that is_straight() is true. Let a line have the width w and the height h in
  // radians, and its middle the latitude f. In coordinates with the longitude of the middle as 0,
  // the sum of its ends over 2 cos(h / 2) is u, and the middle is v:
  //
  //   u = (cos(w / 2) cos f, -sin(w / 2) sin f tan(h / 2), sin f)
  //   v = (cos f, 0, sin f)
  //
  // So |u - v|^2 is at most (w^2 / 8)^2 + (w tan(h / 2) / 2)^2, with tan(h / 2) < 0.504 h up to h =
  // 0.3, and |u / |u| - v| < 1.01 |u - v| as long as that is below 0.28. The rest up to the tolerance
  // is for rounding, which is below 1e-14.
  [[nodiscard]] bool is_surely_straight(const LonLat& from, const LonLat& to) const {
    constexpr double widest = 0.3;
    constexpr double least_tolerance = 1e-10;
    const double width = std::abs(to.lon_deg - from.lon_deg) * rad_per_deg;
    const double height = std::abs(to.lat_deg - from.lat_deg) * rad_per_deg;
    if (!(width <= widest && height <= widest && tolerance_ >= least_tolerance)) return false;
    if (from.lat_deg * to.lat_deg < 0) return false;
    const double squared = width * width * (width * width / 64 + 0.0636 * height * height);
    return 1.01 * 1.01 * squared <= 0.81 * squared_tolerance_;
  }

  // Returns whether a line needs no division, where that takes no look at its middle.
  static std::optional<bool> is_straight_by_ends(const LonLat& from, const Point& p,
                                                 const LonLat& to, const Point& q) {
    constexpr double max_degrees = 90;
    if (p == q && std::abs(from.lat_deg) == 90) return true;
    if (std::abs(to.lon_deg - from.lon_deg) > max_degrees ||
        std::abs(to.lat_deg - from.lat_deg) > max_degrees)
      return false;
    if (from.lon_deg == to.lon_deg) return true;
    return std::nullopt;
  }
  // Returns whether the arc is near to other lines in their middle, which is `on_line`.
  [[nodiscard]] bool is_straight(const LonLat& from, const Point& p, const LonLat& to,
                                 const Point& q, const LonLat& middle, const Point& on_line) const {
    const Point m = normalized(p + q);
    if (!is_near(m, on_line)) return false;
    // On one side of the equator an arc bends to one side and is farthest from the line near the
    // middle. Across the equator it bends to both sides and may meet the line in the middle.
    if (!(from.lat_deg * to.lat_deg < 0)) return true;
    return is_near(normalized(p + m), unit_vector(middle_of(from, middle))) &&
           is_near(normalized(m + q), unit_vector(middle_of(middle, to)));
  }

  // True if a point of an arc is within the tolerance of a point of the line.
  [[nodiscard]] bool is_near(const Point& of_arc, const Point& of_line) const {
    const Point off = of_arc - of_line;
    return dot(off, off) <= squared_tolerance_;
  }

  // Returns the middle of a line, which may exceed 180 degrees of longitude.
  static LonLat middle_of(const LonLat& a, const LonLat& b) {
    return {(a.lon_deg + b.lon_deg) / 2, (a.lat_deg + b.lat_deg) / 2};
  }

  double tolerance_;
  double squared_tolerance_;
  std::vector<LonLat>& positions_;
};

// Returns a bound for the distance in latitude of an arc from its straight line, in degrees. Along
// a great circle the latitude f has the second derivative -sin f cos f - 2 tan f (f')^2 by
// longitude, and a function is within w^2/8 of that from its chord; the bound is doubled, since f
// may leave the line.
double bulge_deg(const LonLat& west, const LonLat& east) {
  const double width = (east.lon_deg - west.lon_deg) * rad_per_deg;
  const double height = std::abs(east.lat_deg - west.lat_deg) * rad_per_deg;
  const double near = std::min(std::abs(west.lat_deg), std::abs(east.lat_deg));
  const double far = std::max(std::abs(west.lat_deg), std::abs(east.lat_deg));
  const bool meets_equator = west.lat_deg * east.lat_deg < 0;
  const auto [sine, cosine] = exact::sine_cosine_of_degrees(far);
  const double max_cosine = meets_equator ? 1 : exact::sine_cosine_of_degrees(near).cosine;
  const double level = width * width / 8 * std::min({0.5, sine, max_cosine});
  const double slope = cosine > height ? sine / cosine * height * height / 4 : height;
  return 2 * (level + std::min(slope, height)) / rad_per_deg;
}

bool is_pole(const LonLat& p) { return std::abs(p.lat_deg) == 90; }

// Returns the latitude of a piece at a longitude, within those of its ends in spite of rounding: so
// latitudes along a side change in one direction.
double lat_on(const LinePiece& piece, double lon_deg) {
  const double lat = piece.west.lat_deg + (lon_deg - piece.west.lon_deg) /
                                              (piece.east.lon_deg - piece.west.lon_deg) *
                                              (piece.east.lat_deg - piece.west.lat_deg);
  return std::clamp(lat, std::min(piece.west.lat_deg, piece.east.lat_deg),
                    std::max(piece.west.lat_deg, piece.east.lat_deg));
}

// Returns a number that is at least bulge_deg() and takes less work: with c as the distance of `far`
// from its pole, its tangent is below 1 / c, and its cosine at least 2 / pi times c.
double simple_bulge_deg(const LonLat& west, const LonLat& east) {
  constexpr double above_rounding = 1 + 1e-9;
  const double width = east.lon_deg - west.lon_deg;
  const double height = std::abs(east.lat_deg - west.lat_deg);
  const double from_pole = 90 - std::max(std::abs(west.lat_deg), std::abs(east.lat_deg));
  const double slope = 0.63 * from_pole > height ? height * height / (4 * from_pole) : height;
  return (width * width * (rad_per_deg / 8) + 2 * slope) * above_rounding;
}

// Finds the corners on a piece of a meridian, from south to north.
void find_cuts_of_meridian(const LinePiece& piece, const PlaneCorners& corners,
                           std::vector<LonLat>& cuts) {
  cuts.clear();
  corners.visit_near(piece.west, piece.east, {0, 0}, [&](const LonLat& p, Index) {
    const bool is_between = p.lat_deg > piece.west.lat_deg && p.lat_deg < piece.east.lat_deg;
    if (p.lon_deg == piece.west.lon_deg && is_between) cuts.push_back(p);
  });
}

// Finds the positions where a piece of a side has to be divided, from west to east: on the meridians
// of corners near it. A corner that is exactly on the side is such a position itself, so that two
// sides which cross there have one corner there, and not two up to rounding.
void find_cuts(const LinePiece& piece, const PlaneSide& side, const PlaneCorners& corners,
               std::vector<LonLat>& cuts) {
  cuts.clear();
  if (is_pole(piece.west) && is_pole(piece.east)) return;
  if (piece.west.lon_deg == piece.east.lon_deg) {
    return find_cuts_of_meridian(piece, corners, cuts);
  }
  const auto cut_within = [&](double bulge) {
    cuts.clear();
    corners.visit_near(piece.west, piece.east, {0, bulge}, [&](const LonLat& p, Index) {
      if (p.lon_deg <= piece.west.lon_deg || p.lon_deg >= piece.east.lon_deg) return;
      const double lat = lat_on(piece, p.lon_deg);
      if (std::abs(p.lat_deg - lat) > bulge) return;
      const bool is_on = p.lat_deg != lat && std::abs(p.lat_deg - lat) <= on_side_deg &&
                         side_of_line(side.from, side.to, p) == Sign::zero;
      cuts.push_back({p.lon_deg, is_on ? p.lat_deg : lat});
    });
  };
  cut_within(simple_bulge_deg(piece.west, piece.east) + on_side_deg);
  if (cuts.empty()) return;
  cut_within(bulge_deg(piece.west, piece.east) + on_side_deg);
  std::ranges::sort(cuts, IsWestOf{});
  // One position is kept of each meridian: that of a corner on the side, if there is one.
  auto kept = cuts.begin();
  for (auto first = cuts.begin(); first != cuts.end();) {
    const auto end = std::find_if(first, cuts.end(),
                                  [&](const LonLat& cut) { return cut.lon_deg != first->lon_deg; });
    const auto exact = std::find_if(first, end, [&](const LonLat& cut) {
      return *first == *(end - 1) || side_of_line(side.from, side.to, cut) == Sign::zero;
    });
    *kept++ = exact == end ? *first : *exact;
    first = end;
  }
  cuts.erase(kept, cuts.end());
}

// Divides the pieces at the corners near them. Returns the positions that are new, and appends the
// divided sides to `changed`.
std::vector<LonLat> divide_at(const PlaneCorners& corners, std::span<const PlaneSide> sides,
                              std::vector<LinePiece>& pieces, std::vector<Index>& changed,
                              unsigned threads) {
  std::vector<std::vector<std::pair<std::size_t, std::vector<LonLat>>>> found(
      system::num_pieces(pieces.size(), pieces_per_block));
  system::parallel_for(threads, pieces.size(), pieces_per_block,
                       [&](std::size_t begin, std::size_t end) {
                         std::vector<LonLat> cuts;
                         for (std::size_t k = begin; k < end; ++k) {
                           find_cuts(pieces[k], sides[pieces[k].side], corners, cuts);
                           if (!cuts.empty()) found[begin / pieces_per_block].emplace_back(k, cuts);
                         }
                       });
  std::vector<LonLat> added;
  for (const auto& of_block : found) {
    for (const auto& [k, cuts] : of_block) {
      const LonLat east = pieces[k].east;
      changed.push_back(pieces[k].side);
      pieces[k].east = cuts.front();
      for (std::size_t i = 0; i < cuts.size(); ++i) {
        pieces.push_back({pieces[k].side, cuts[i], i + 1 < cuts.size() ? cuts[i + 1] : east});
      }
      added.insert(added.end(), cuts.begin(), cuts.end());
    }
  }
  return added;
}

// Returns an index of corners without owners.
PlaneCorners corners_at(std::span<const LonLat> positions) {
  std::vector<PlaneCorners::OwnedCorner> corners;
  corners.reserve(positions.size());
  for (const LonLat& p : positions) {
    if (!is_pole(p)) corners.push_back({p, no_index});
  }
  return PlaneCorners(std::move(corners));
}

// Appends the positions of a piece halved `times` times, without the last one. A part with no
// longitude between its ends is not halved: corners on one meridian would have no order along the
// side.
void append_halved(const LonLat& west, const LonLat& east, unsigned times,
                   std::vector<LonLat>& positions) {
  const LonLat middle = {(west.lon_deg + east.lon_deg) / 2, (west.lat_deg + east.lat_deg) / 2};
  if (times == 0 || middle.lon_deg <= west.lon_deg || middle.lon_deg >= east.lon_deg) {
    positions.push_back(west);
    return;
  }
  append_halved(west, middle, times - 1, positions);
  append_halved(middle, east, times - 1, positions);
}

}  // namespace

void append_divided(const LonLat& from, const LonLat& to, double tolerance,
                    std::vector<LonLat>& positions) {
  LineDivider(tolerance, positions).append(from, to);
}

SideDivider::SideDivider(std::span<const PlaneSide> sides, std::size_t num_closed, double tolerance,
                         unsigned threads)
    : sides_(sides), threads_(threads) {
  std::vector<LonLat> added;
  pieces_.reserve(sides.size());
  added.reserve(2 * sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const bool goes_east = is_west_of(sides[s].from, sides[s].to);
    const auto [west, east] =
        goes_east ? std::pair(sides[s].from, sides[s].to) : std::pair(sides[s].to, sides[s].from);
    const std::size_t first = added.size();
    append_divided(west, east, tolerance, added);
    for (std::size_t k = first; k < added.size(); ++k) {
      pieces_.push_back(
          {static_cast<Index>(s), added[k], k + 1 < added.size() ? added[k + 1] : east});
    }
    // The other end of a side of a closed ring is the last corner of another side.
    if (s < num_closed) {
      added[first] = sides[s].to;
    } else {
      added.push_back(sides[s].to);
    }
  }
  match(std::move(added));
}

// Divides pieces at the positions that were added, until none is added any more.
void SideDivider::match(std::vector<LonLat> added) {
  while (!added.empty()) {
    added = divide_at(corners_at(added), sides_, pieces_, changed_, threads_);
  }
}

std::vector<Index> SideDivider::halve(std::span<const std::uint8_t> times) {
  changed_.clear();
  std::vector<LonLat> added;
  for (std::size_t k = 0, end = pieces_.size(); k < end; ++k) {
    const auto [side, west, east] = pieces_[k];
    if (times[side] == 0 || west.lon_deg == east.lon_deg) continue;
    const std::size_t first = added.size();
    append_halved(west, east, times[side], added);
    if (added.size() == first + 1) {
      added.pop_back();
      continue;
    }
    pieces_[k].east = added[first + 1];
    for (std::size_t i = first + 1; i < added.size(); ++i) {
      pieces_.push_back({side, added[i], i + 1 < added.size() ? added[i + 1] : east});
    }
    changed_.push_back(side);
  }
  match(std::move(added));
  std::ranges::sort(changed_);
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  return std::move(changed_);
}

// Sorts the pieces by their sides, and those of a side by `along`.
template <class Along>
void SideDivider::sort_pieces(const Along& along) {
  if (std::ranges::is_sorted(pieces_, {}, along)) return;
  system::RowPlaces places(sides_.size());
  for (const LinePiece& piece : pieces_) places.count(piece.side);
  std::vector<LinePiece> sorted(places.sum());
  for (const LinePiece& piece : pieces_) sorted[places.place(piece.side)] = piece;
  const std::vector<std::uint64_t> offsets = std::move(places).offsets();
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const auto own = std::span(sorted).subspan(offsets[s], offsets[s + 1] - offsets[s]);
    if (own.size() > 1) std::ranges::sort(own, {}, along);
  }
  pieces_ = std::move(sorted);
}

DividedSides SideDivider::divided() {
  // A side as steep as rounding of longitudes has several corners on one meridian.
  const auto along = [&](const LinePiece& piece) {
    const PlaneSide& side = sides_[piece.side];
    const bool goes_east = is_west_of(side.from, side.to);
    const bool goes_north_east = goes_east == (side.from.lat_deg < side.to.lat_deg);
    return std::tuple(piece.side, piece.west.lon_deg,
                      goes_north_east ? piece.west.lat_deg : -piece.west.lat_deg);
  };
  sort_pieces(along);
  DividedSides result;
  result.values.reserve(pieces_.size());
  result.offsets.reserve(sides_.size() + 1);
  for (std::size_t first = 0; first < pieces_.size();) {
    std::size_t end = first;
    while (end < pieces_.size() && pieces_[end].side == pieces_[first].side) ++end;
    const PlaneSide& side = sides_[pieces_[first].side];
    const bool goes_east = is_west_of(side.from, side.to);
    for (std::size_t k = first; k < end; ++k) {
      result.values.push_back(goes_east ? pieces_[k].west : pieces_[first + (end - 1 - k)].east);
    }
    result.end_row();
    first = end;
  }
  return result;
}

}  // namespace rondel::overlay
