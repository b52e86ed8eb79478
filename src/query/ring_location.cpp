// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "query/ring_location.h"

#include <utility>

#include "kernel/great_circle.h"
#include "predicates/orientation.h"
#include "predicates/ray_order.h"
#include "predicates/turn.h"

namespace rondel::query {
namespace {

Location on_vertex(Index v) { return {Where::vertex, no_index, {v, no_index, no_index}}; }

}  // namespace

RingLocation::RingLocation(std::vector<Point> points, const Point& center)
    : points_(std::move(points)), center_(center) {
  const auto span = kernel::find_span(points_, center);
  if (span.size() < 2) return;
  spanning_ = {span[0], span[1]};
  while (turn(span[0], points_[span[1]]) == Sign::zero) ++axis_;
  for (Index i = 0; i < points_.size() && solid_ == no_index; ++i) {
    if (is_solid(i)) solid_ = i;
  }
}

Sign RingLocation::turn(Index i, const Point& p) const {
  return predicates::turn(center_, points_[i], p, axis_);
}

bool RingLocation::is_solid(Index edge) const {
  return turn(edge, points_[next(edge)]) == Sign::positive;
}

bool RingLocation::is_in_plane(const Point& p) const {
  return predicates::orientation(points_[spanning_[0]], points_[spanning_[1]], p, center_).sign ==
         Sign::zero;
}

Location RingLocation::locate(const Point& p, Index near) const {
  if (solid_ == no_index) {
    if (predicates::are_on_one_ray(points_[near], p, center_)) return on_vertex(near);
    return {};
  }
  if (!is_in_plane(p)) return {};
  return walk(p, is_solid(near) ? near : solid_);
}

// Ahead as long as p is beyond the end of the edge, back as long as it is before the begin. Within
// a cone of less than 180 degrees, or around a full circle, neither turns into the other.
Location RingLocation::walk(const Point& p, Index edge) const {
  for (Index i = edge;;) {
    const Index end = next(i);
    const Sign from_end = turn(end, p);
    const Sign from_begin = turn(i, p);
    if (from_end == Sign::positive) {
      i = end;
    } else if (from_begin == Sign::negative) {
      i = previous(i);
    } else {
      if (from_begin == Sign::zero) return on_vertex(i);
      if (from_end == Sign::zero) return on_vertex(end);
      return {Where::edge, no_index, {i, end, no_index}};
    }
    if (!is_solid(i)) return {};
  }
}

}  // namespace rondel::query
