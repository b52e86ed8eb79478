// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/grid_walk.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

#include "exact/angles.h"
#include "exact/eft.h"
#include "overlay/arc_bulge.h"
#include "overlay/measure.h"
#include "predicates/bounds.h"

namespace rondel::overlay {
namespace {

constexpr double pi = std::numbers::pi;

// Returns a value that is positive if x is less than 180 degrees east of the meridian that meets
// the equator in m.
double side(const Point& m, const Point& x) { return m.x * x.y - m.y * x.x; }

// Returns a value that is positive if x is less than 90 degrees of longitude from that meridian.
double along(const Point& m, const Point& x) { return m.x * x.x + m.y * x.y; }

// Returns the distance from the axis.
double radius_of(const Point& x) { return std::sqrt(x.x * x.x + x.y * x.y); }

// Returns the area between the arc from p to q, which spans `width` of longitude, and a parallel.
// The area between the arc and the equator is 2 atan(k tan(width / 2)) with k = (sin p + sin q) /
// (1 + cos(p - q)), where p and q are latitudes.
double area_above(const PreparedGrid::Parallel& parallel, const PlaceInGrid& p,
                  const PlaceInGrid& q) {
  const double width = q.offset - p.offset;
  const double dz = q.point.z - p.point.z;
  const double dr = q.radius - p.radius;
  const double bend = (dz * dz + dr * dr) / 2;  // 1 - cos(p - q)
  const double middle =
      ((p.point.z - parallel.sine) + (q.point.z - parallel.sine) + parallel.sine * bend) /
      (2 - bend);
  return width * middle + area_of_bulge(width, parallel.sine + middle);
}

// Returns the area between the arc and the pole next to it. With t = tan(width / 2) it is 2
// (atan(t) - atan(k t)) = 2 atan(g t / (1 + k t^2)), where g = 1 - k = ((1 - sin p) (1 - sin q) +
// cos p cos q) / (1 + cos(p - q)) for the north pole.
double area_at_pole(const PlaceInGrid& p, const PlaceInGrid& q) {
  const double radii = p.radius * q.radius;
  const double g = (p.gap * q.gap + radii) / (1 + p.point.z * q.point.z + radii);
  const exact::SineCosine half = exact::sine_cosine_of_degrees((q.offset - p.offset) * (90 / pi));
  return 2 * exact::argument(g * half.sine * half.cosine,
                             half.cosine * half.cosine + (1 - g) * half.sine * half.sine);
}

// True if a place is south of a parallel. A place that differs from a parallel by rounding is on
// it.
bool is_south_of(const SphereHeight& height, const PreparedGrid::Parallel& parallel) {
  constexpr double of_gap = 8 * predicates::unit_roundoff;
  const SphereHeight low = parallel.height();
  const double above = rise(low, height);
  return is_polar(low, height) ? above < -of_gap * low.gap : above < 0;
}

// True if a place differs from a parallel by no more than rounding.
bool is_about_on(const SphereHeight& height, const PreparedGrid::Parallel& parallel) {
  constexpr double of_sine = 8 * predicates::unit_roundoff;
  const SphereHeight low = parallel.height();
  return std::abs(rise(low, height)) <= of_sine * (is_polar(low, height) ? low.gap : 1);
}

// Sets the point of a place, and what follows from it except for the column.
void set_point(PlaceInGrid& place, const Point& point) {
  place.point = point;
  place.radius = radius_of(point);
  place.gap = height_of(point.z, place.radius).gap;
}

// The height of the point at part t of a chord above a parallel, times the point's distance from
// the center, and the approximate derivative of that by t.
struct RiseAlongChord {
  double above;
  double slope;
};
RiseAlongChord rise_along(const Point& from, const Point& chord, double square, double t,
                          const PreparedGrid::Parallel& parallel) {
  const double length = std::sqrt(1 - t * (1 - t) * square);
  if (std::abs(parallel.sine) > polar_sine) {
    const Point p = from + t * chord;
    const SphereHeight height = height_of(p.z / length, radius_of(p) / length);
    if (is_polar(parallel.height(), height)) {
      const double outward =
          2 * (p.x * chord.x + p.y * chord.y) / (length * (1 + std::abs(height.sine)));
      return {rise(parallel.height(), height) * length, parallel.sine > 0 ? -outward : outward};
    }
  }
  return {from.z + t * chord.z - parallel.sine * length,
          chord.z + parallel.sine * (1 - 2 * t) * square / (2 * length)};
}

// Returns the point where the meridian of a place meets the equator. For a pole, which is on all
// meridians, its column and offset decide.
Point meridian_of(const PreparedGrid& grid, const PlaceInGrid& place) {
  if (place.radius > 0) return {place.point.x / place.radius, place.point.y / place.radius, 0};
  return grid.meridian(place.column, place.offset);
}

// Returns half of the integral of q x dq along a meridian, northward from a parallel to a place.
Point moment_of_meridian(const PreparedGrid::Parallel& south, const PlaceInGrid& north,
                         const Point& meridian) {
  const double height = exact::argument(north.point.z * south.cosine - north.radius * south.sine,
                                        north.radius * south.cosine + north.point.z * south.sine);
  return {height / 2 * meridian.y, -height / 2 * meridian.x, 0};
}

}  // namespace

PlaceInGrid GridWalk::place_of(const Point& point) const {
  const auto& columns = grid_.columns();
  PlaceInGrid place;
  set_point(place, point);
  const Point& first = columns.front().west;
  double turn = exact::argument(side(first, point), along(first, point));
  if (turn < 0) turn += 2 * pi;
  const auto next =
      std::ranges::upper_bound(columns, turn, {}, [](const auto& column) { return column.start; });
  place.column = static_cast<Index>(std::max<std::ptrdiff_t>(next - columns.begin(), 1) - 1);
  const PreparedGrid::Lune& column = columns[place.column];
  place.offset = exact::argument(side(column.west, point), along(column.west, point));
  if (turn - column.start - place.offset > pi) place.offset += 2 * pi;
  if (turn - column.start - place.offset < -pi) place.offset -= 2 * pi;
  place.offset = std::clamp(place.offset, 0.0, column.width);
  place.row = row_of(place.height());
  return place;
}

Index GridWalk::row_between(const SphereHeight& height, Index southern, Index northern) const {
  Index low = southern;
  Index high = northern + 1;
  const bool is_near_pole = std::abs(height.sine) > polar_sine;
  while (high - low > 1) {
    const Index middle = low + (high - low) / 2;
    const PreparedGrid::Parallel& parallel = grid_.parallel(middle);
    const bool is_south =
        is_near_pole ? is_south_of(height, parallel) : height.sine < parallel.sine;
    (is_south ? high : low) = middle;
  }
  return low;
}

void GridWalk::append(const PlaceInGrid& from, const PlaceInGrid& to,
                      std::vector<Strip>& strips) const {
  const auto key = [](const Point& p) { return std::tie(p.x, p.y, p.z); };
  const bool is_swapped = key(to.point) < key(from.point);
  const PlaceInGrid* west = is_swapped ? &to : &from;
  const PlaceInGrid* east = is_swapped ? &from : &to;
  // Offsets in one column are known better than turns.
  double turned =
      east->column == west->column ? east->offset - west->offset : turn(*east) - turn(*west);
  if (turned > pi) turned -= 2 * pi;
  if (turned <= -pi) turned += 2 * pi;
  if (turned == 0) return;
  bool is_west = turned < 0;
  const bool has_pole = west->radius == 0 || east->radius == 0;
  // Near a pole longitudes do not tell on which side the arc passes it.
  if (!has_pole && std::abs(turned) > pi / 2) is_west = side(west->point, east->point) < 0;
  if (is_west) std::swap(west, east);
  const Out out{is_west != is_swapped ? 1.0 : -1.0, strips};
  // A pole has a longitude, too. An arc to a pole is treated as a meridian, whose strips are empty,
  // and a turn in the pole.
  if (has_pole) {
    const bool is_first = west->radius == 0;
    PlaceInGrid turned_to = is_first ? *east : *west;
    turned_to.point = is_first ? west->point : east->point;
    turned_to.radius = 0;
    turned_to.gap = 0;
    turned_to.row = row_of(turned_to.height());
    append_columns(is_first ? *west : turned_to, is_first ? turned_to : *east, out);
    return;
  }
  PlaceInGrid extreme;
  if (has_extreme(*west, *east, extreme)) {
    append_columns(*west, extreme, out);
    append_columns(extreme, *east, out);
  } else {
    append_columns(*west, *east, out);
  }
}

// Returns true, and the northernmost or southernmost point of the arc, if the arc meets a parallel
// on both sides of that point.
bool GridWalk::has_extreme(const PlaceInGrid& from, const PlaceInGrid& to,
                           PlaceInGrid& extreme) const {
  const Point normal = cross(from.point, to.point - from.point);
  const double rise_from = side(normal, from.point);
  const double rise_to = side(normal, to.point);
  if (!(rise_from > 0 && rise_to < 0) && !(rise_from < 0 && rise_to > 0)) return false;
  const Point point = normalized(std::abs(rise_to) * from.point + std::abs(rise_from) * to.point);
  extreme = place_of(point);
  const bool is_rising = rise(from.height(), to.height()) > 0;
  const SphereHeight south = (is_rising ? from : to).height();
  const SphereHeight north = (is_rising ? to : from).height();
  const Index row = extreme.row;
  const Index southern = (is_rising ? from : to).row;
  const Index northern = (is_rising ? to : from).row;
  // An arc that comes back to a parallel from beyond it, and ends there, has met it before.
  const bool comes_back = row == northern ? is_about_on(north, grid_.parallel(row))
                                          : is_about_on(south, grid_.parallel(row + 1));
  const bool is_met_twice =
      southern < northern && (row == northern || row == southern) && comes_back;
  if (row >= southern && row <= northern && !is_met_twice) return false;
  const auto east_of = [&](const PlaceInGrid& place) {
    const double turned = turn(place) - turn(from);
    return turned < -1 ? turned + 2 * pi : turned;
  };
  const double turned = east_of(extreme);
  const PlaceInGrid* const end = turned <= 0 ? &from : turned >= east_of(to) ? &to : nullptr;
  if (end != nullptr) {
    extreme.column = end->column;
    extreme.offset = end->offset;
  }
  return true;
}

void GridWalk::append_columns(const PlaceInGrid& from, const PlaceInGrid& to,
                              const Out& out) const {
  const auto num_columns = static_cast<Index>(grid_.columns().size());
  const bool is_wrapped = turn(to) < turn(from);
  if (!is_wrapped && to.column < from.column) return;  // the arc has no width except for rounding
  Index steps = to.column - from.column + (is_wrapped ? num_columns : 0);
  PlaceInGrid last = from;
  Index row = from.row;
  const Index last_row = to.row;
  // The arc is in the rows of its ends and between them, but its points on meridians are rounded.
  const Index southern = std::min(row, last_row);
  const Index northern = std::max(row, last_row);
  for (; steps > 0; --steps) {
    const Point& border = grid_.eastern_meridian(last.column);
    const double east = std::max(side(border, to.point), 0.0);
    const double west = std::max(-side(border, from.point), 0.0);
    PlaceInGrid next = last;
    if (east > 0 || west > 0) {
      set_point(next, normalized(east * from.point + west * to.point));
    } else if (!(along(border, from.point) >
                 0)) {  // the arc has come through a pole to this meridian
      next.point = to.point;
      next.radius = to.radius;
      next.gap = to.gap;
    }
    next.offset = grid_.columns()[last.column].width;
    const Index next_row = row_between(next.height(), southern, northern);
    append_rows(last, row, next, next_row, out);
    last = next;
    row = next_row;
    last.column = last.column + 1 < num_columns ? last.column + 1 : 0;
    last.offset = 0;
  }
  append_rows(last, row, to, last_row, out);
}

// Appends the strips of an arc in one column, row by row.
void GridWalk::append_rows(const PlaceInGrid& from, Index row, const PlaceInGrid& to,
                           Index last_row, const Out& out) const {
  if (!(from.offset < to.offset)) return;
  PlaceInGrid last = from;
  while (row != last_row) {
    const bool is_north = last_row > row;
    const PlaceInGrid next =
        on_parallel(last, to, grid_.parallel(is_north ? row + 1 : row), is_north);
    append_strip(last, next, row, out);
    last = next;
    row = is_north ? row + 1 : row - 1;
  }
  append_strip(last, to, row, out);
}

// Returns the place where the arc crosses a parallel, by Newton's method along the chord, within an
// interval that is known to contain it.
PlaceInGrid GridWalk::on_parallel(const PlaceInGrid& from, const PlaceInGrid& to,
                                  const PreparedGrid::Parallel& parallel, bool is_north) const {
  const Point chord = to.point - from.point;
  const double square = dot(chord, chord);
  double low = 0;
  double high = 1;
  double t = rise(from.height(), parallel.height()) / rise(from.height(), to.height());
  constexpr int max_steps = 60;
  for (int step = 0; step < max_steps; ++step) {
    if (!(t > low && t < high)) t = (low + high) / 2;
    const auto [above, slope] = rise_along(from.point, chord, square, t, parallel);
    if (above == 0) break;
    ((above > 0) == is_north ? high : low) = t;
    const double next = t - above / slope;
    if (std::abs(next - t) <= 0x1p-53 || high - low <= 0x1p-53) break;
    t = next;
  }
  PlaceInGrid place = from;
  place.point = normalized(from.point + t * chord);
  const Point& west = grid_.columns()[from.column].west;
  double offset = exact::argument(side(west, place.point), along(west, place.point));
  if (offset < from.offset - 1) offset += 2 * pi;
  place.offset = std::clamp(offset, from.offset, to.offset);
  place.point.z = parallel.sine;
  place.radius = parallel.cosine;
  place.gap = parallel.height().gap;
  return place;
}

void GridWalk::append_strip(const PlaceInGrid& from, const PlaceInGrid& to, Index row,
                            const Out& out) const {
  const PreparedGrid::Parallel& parallel = grid_.parallel(row);
  const exact::DoubleDouble width = exact::two_diff(to.offset, from.offset);
  if (width.hi == 0) return;
  Strip& strip = out.strips.emplace_back();
  strip.column = from.column;
  strip.row = row;
  strip.width = out.sign * width.hi;
  strip.width_rest = out.sign * width.lo;
  strip.length = rough_length(from.point, to.point);
  if (is_polar(from.height(), to.height())) {
    strip.pole = from.point.z > 0 ? 1 : -1;
    strip.area = -out.sign * strip.pole * area_at_pole(from, to);
  } else {
    strip.area = out.sign * area_above(parallel, from, to);
  }
  if (has_moments_) {
    const Point west = meridian_of(grid_, from);
    const Point east = meridian_of(grid_, to);
    const Point run = east - west;
    const double out_of_plane = parallel.sine * parallel.cosine / 2;
    const double upward = parallel.cosine * parallel.cosine / 2;
    strip.run = out.sign * run;
    strip.moment =
        out.sign *
        (Point{-out_of_plane * run.y, out_of_plane * run.x, upward * (to.offset - from.offset)} +
         (moment_of_meridian(parallel, to, east) - moment_of_meridian(parallel, from, west)) -
         moment_of_arc(from.point, to.point));
  }
}

}  // namespace rondel::overlay
