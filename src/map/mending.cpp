// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "map/mending.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "exact/vector.h"

namespace rondel::map {
namespace {

bool is_at_pole(const LonLat& p) { return std::abs(p.lat_deg) == 90; }

// Returns the position of a point of the arc between two positions. Precondition: the arc is on one
// side of the antimeridian. A point on the antimeridian gets the sign of longitude of the
// positions.
LonLat position_between(const Point& p, const LonLat& a, const LonLat& b) {
  const auto [west, east] = std::minmax(a.lon_deg, b.lon_deg);
  LonLat position = lonlat_of(p, std::abs(west) > std::abs(east) ? west > 0 : east > 0);
  position.lon_deg = std::clamp(position.lon_deg, west, east);
  return position;
}

LonLat middle_in_plane(const LonLat& a, const LonLat& b) {
  return {std::midpoint(a.lon_deg, b.lon_deg), std::midpoint(a.lat_deg, b.lat_deg)};
}

// Returns the position where two crossing lines cross, rounded.
LonLat crossing_of(const Trouble& lines) {
  const auto& [kind, a, b, c, d, loop] = lines;
  const LonLat u{b.lon_deg - a.lon_deg, b.lat_deg - a.lat_deg};
  const LonLat v{d.lon_deg - c.lon_deg, d.lat_deg - c.lat_deg};
  const double turn = u.lon_deg * v.lat_deg - u.lat_deg * v.lon_deg;
  if (turn == 0) return c;
  const double share =
      ((c.lon_deg - a.lon_deg) * v.lat_deg - (c.lat_deg - a.lat_deg) * v.lon_deg) / turn;
  const double along = std::clamp(share, 0.0, 1.0);
  return {std::lerp(a.lon_deg, b.lon_deg, along), std::lerp(a.lat_deg, b.lat_deg, along)};
}

}  // namespace

double reach_of_pass(int pass) {
  constexpr int patience = 8;
  constexpr int steps_of_four = 8;  // from 2^-46 to 2^-30
  const int steps = std::clamp((pass - patience) / 3, 0, steps_of_four);
  return std::ldexp(merge_distance, 2 * steps);
}

Mending::Mending(SharedLines& lines, int pass)
    : lines_(lines), reach_(reach_of_pass(pass)), bisects_first_(pass >= 24 && pass % 3 == 2) {}

void Mending::mend(const Trouble& trouble) {
  switch (trouble.kind) {
    case Trouble::TroubleKind::touching:
      divide(trouble.a, trouble.b, trouble.c);
      break;
    case Trouble::TroubleKind::crossing:
      uncross(trouble);
      break;
    case Trouble::TroubleKind::unpaired:
      pair(trouble);
      break;
    case Trouble::TroubleKind::beside:
      snap(trouble);
      break;
    case Trouble::TroubleKind::turned:
      turn(trouble.loop);
      break;
  }
}

bool Mending::divide(const LonLat& a, const LonLat& b, const LonLat& at) {
  if (!lines_.divide(a, b, at)) return false;
  changes_.push_back({a, b, lines_.place(at)});
  return true;
}

bool Mending::merge(const LonLat& a, const LonLat& b) {
  if (!lines_.merge(a, b)) return false;
  changes_.push_back({a, b, lines_.place(a), true});
  return true;
}

// Merges two corners that are within the reach of each other.
bool Mending::join(const LonLat& a, const LonLat& b) {
  if (a == b || is_at_pole(a) || is_at_pole(b)) return false;
  return distance(point_at(a), point_at(b)) <= reach_ && merge(a, b);
}

// Divides a line at the point of its arc opposite a corner.
bool Mending::align(const LonLat& a, const LonLat& b, const LonLat& corner) {
  if (corner == a || corner == b || is_at_pole(corner) || !lines_.is_current(a, b)) return false;
  if (is_at_pole(a) && is_at_pole(b)) return false;
  const Point p = point_at(a);
  const Point q = point_at(b);
  const Point v = point_at(corner);
  const std::optional<Point> foot = foot_on_arc(v, p, q);
  if (!foot || distance(*foot, p) <= reach_ || distance(*foot, q) <= reach_) return false;
  const LonLat opposite = position_between(*foot, a, b);
  const bool is_on_line = distance(*foot, v) <= reach_ && are_near_in_plane(opposite, corner);
  return divide(a, b, is_on_line ? corner : opposite);
}

// Divides a line at the middle of its arc if the line's own middle is farther from that than the
// reach.
bool Mending::bisect(const LonLat& a, const LonLat& b) {
  if (a.lon_deg == b.lon_deg || (is_at_pole(a) && is_at_pole(b)) || !lines_.is_current(a, b))
    return false;
  const Point middle = normalized(point_at(a) + point_at(b));
  if (distance(middle, point_at(middle_in_plane(a, b))) <= reach_) return false;
  return divide(a, b, position_between(middle, a, b));
}

bool Mending::align_all(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d) {
  bool has_changed = align(a, b, c);
  has_changed |= align(a, b, d);
  has_changed |= align(c, d, a);
  has_changed |= align(c, d, b);
  return has_changed;
}

bool Mending::bisect_both(const LonLat& a, const LonLat& b, const LonLat& c, const LonLat& d) {
  const bool has_changed = bisect(a, b);
  return bisect(c, d) || has_changed;
}

// Mends two lines that cross: merges ends, aligns or bisects, and if nothing helps divides both at
// the crossing.
void Mending::uncross(const Trouble& lines) {
  const auto& [kind, a, b, c, d, loop] = lines;
  if (!lines_.is_current(a, b) || !lines_.is_current(c, d)) return;
  if (join(a, b) || join(c, d) || join(a, c) || join(a, d) || join(b, c) || join(b, d)) return;
  if (bisects_first_ ? bisect_both(a, b, c, d) || align_all(a, b, c, d)
                     : align_all(a, b, c, d) || bisect_both(a, b, c, d))
    return;
  const LonLat place = crossing_of(lines);
  divide(a, b, place);
  divide(c, d, place);
}

// Mends two unpaired lines that leave one position.
void Mending::pair(const Trouble& lines) {
  const auto& [kind, a, b, c, d, loop] = lines;
  if (!lines_.is_current(a, b) || !lines_.is_current(a, d)) return;
  if (join(a, b) || join(a, d) || join(b, d) || align(a, b, d) || align(a, d, b)) return;
  bisect_both(a, b, a, d);
}

// Divides one of two lines that leave a position at the end of the other line, if that end is
// within the reach.
void Mending::snap(const Trouble& lines) {
  const auto& [kind, a, b, c, d, loop] = lines;
  for (const auto& [end, other] : {std::pair(b, d), std::pair(d, b)}) {
    if (end == other || is_at_pole(end) || is_at_pole(other) || !lines_.is_current(a, end))
      continue;
    if (join(end, other)) return;
    const Point corner = point_at(other);
    const auto foot = foot_on_arc(corner, point_at(a), point_at(end));
    if (foot && distance(*foot, corner) <= reach_ &&
        are_near_in_plane(position_between(*foot, a, end), other) && divide(a, end, other))
      return;
  }
}

// Mends a loop with its region on the wrong side: aligns the line nearest to each corner with that
// corner, and bisects all lines if that changes nothing.
void Mending::turn(const Loop& loop) {
  constexpr std::size_t most = 512;
  const std::size_t n = loop.size();
  const auto after = [&](std::size_t k) -> const LonLat& { return loop[k + 1 == n ? 0 : k + 1]; };
  bool has_changed = false;
  for (std::size_t k = 0; n <= most && k < n; ++k) {
    if (is_at_pole(loop[k])) continue;
    const Point corner = point_at(loop[k]);
    std::optional<std::size_t> nearest;
    double least = 4;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || (i + 1) % n == k || (is_at_pole(loop[i]) && is_at_pole(after(i)))) continue;
      const auto foot = foot_on_arc(corner, point_at(loop[i]), point_at(after(i)));
      if (!foot || distance(*foot, corner) >= least) continue;
      least = distance(*foot, corner);
      nearest = i;
    }
    has_changed |= join(loop[k], after(k));
    if (nearest) has_changed |= align(loop[*nearest], after(*nearest), loop[k]);
  }
  if (has_changed) return;
  for (std::size_t k = 0; k < n; ++k) bisect(loop[k], after(k));
}

}  // namespace rondel::map
