// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/cover_walk.h"

namespace rondel::overlay {

namespace {

// Returns the last index of [first, end) for which `holds` is true, by bisection. Precondition: it
// is true for a first part of the range, `first` included, and false for the rest.
template <class Holds>
Index last_of(Index first, Index end, const Holds& holds) {
  while (end - first > 1) {
    const Index middle = first + (end - first) / 2;
    (holds(middle) ? first : end) = middle;
  }
  return first;
}

}  // namespace

// Returns the exit of a large convex cell by bisection. The corners left of the line are
// consecutive around the cell, and so are those right of it; the exit leads from the last right one
// to the first left one. One corner of each kind is known: the ends of the halfedge by which the
// line entered, or else, if the line starts in the cell, corners of the triangle with the start, of
// the fan of triangles around corner 0.
Halfedge CoverWalk::way_out_by_search(const TracedLine& line, Index cell, Halfedge in) const {
  const Index begin = cover_.begin_of(cell);
  const Index size = cover_.end_of(cell) - begin;
  const auto corner = [&](Index k) -> const Point& {
    return cover_.origin(begin + (k < size ? k : k - size));
  };
  const auto is_right = [&](Index k) { return !line.is_left(corner(k)); };
  Index right = 0;
  Index left = size;
  if (in != no_index) {
    right = in - begin + 1;
    left = in - begin + size;
  } else {
    const Index k = last_of(1, size - 1, [&](Index middle) {
      return CoverEdge(corner(0), corner(middle)).is_left(line.from());
    });
    if (is_right(0)) {
      left = is_right(k) ? k + 1 : k;
    } else {
      right = is_right(k) ? k : k + 1;
    }
  }
  return begin + last_of(right, left, is_right) % size;
}

// Finds the triangle by two bisections: the corners less than 180 degrees counterclockwise of the
// first one come before the others.
Halfedge CoverWalk::halfedge_before(const Point& p, Index cell) const {
  const Point& c = cover_.centers[cell];
  const Halfedge begin = cover_.begin_of(cell);
  const Halfedge end = cover_.end_of(cell);
  const auto is_past = [&](Halfedge h) { return CoverEdge(c, cover_.origin(h)).is_left(p); };
  const Halfedge half = last_of(begin, end, [&](Halfedge h) {
    return orientation(c, cover_.origin(begin), cover_.origin(h)) == Sign::positive;
  });
  if (is_past(begin)) return last_of(begin, half + 1, is_past);
  return half + 1 < end && is_past(half + 1) ? last_of(half + 1, end, is_past) : half;
}

// Goes through the triangles of the center c and each halfedge, beginning with the triangle that
// has the start of the line or with that of `in`. If c is to the left, the line turns
// counterclockwise around c. The sides of triangles by which the line leaves have their origin
// right of it and their end left of it.
Halfedge CoverWalk::way_out_of_star(const TracedLine& line, Index cell, Halfedge in) const {
  const Point& c = cover_.centers[cell];
  Halfedge h = in == no_index ? halfedge_before(line.from(), cell) : in;
  const auto ends_before = [&](const Point& from, const Point& to) {
    return CoverEdge(from, to).is_left(line.to());
  };
  if (line.is_left(c)) {
    while (!line.is_left(cover_.end(h))) {
      if (ends_before(cover_.end(h), c)) return no_index;
      h = cover_.next(h);
    }
  } else {
    while (line.is_left(cover_.origin(h))) {
      if (ends_before(c, cover_.origin(h))) return no_index;
      h = cover_.previous(h);
    }
  }
  return h;
}

}  // namespace rondel::overlay
