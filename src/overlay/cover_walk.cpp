// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "overlay/cover_walk.h"

namespace rondel::overlay {

Halfedge CoverWalk::way_out_by_steps(const TracedLine& line, Index cell) const {
  Halfedge h = cover_.begin_of(cell);
  while (line.is_left(cover_.origin(h))) h = cover_.next(h);
  while (!line.is_left(cover_.end(h))) h = cover_.next(h);
  return h;
}

// Through the triangles of the center c and each halfedge, from that which has the start or that behind
// `in`. With c to the left, the line turns counterclockwise around it. Sides of triangles by which
// it leaves have their origin right and their end left.
Halfedge CoverWalk::way_out_of_star(const TracedLine& line, Index cell, Halfedge in) const {
  const Point& c = cover_.centers[cell];
  Halfedge h = in;
  if (in == no_index) {
    const Point& p = line.from();
    h = cover_.begin_of(cell);
    while (!CoverEdge(c, cover_.origin(h)).is_left(p) || CoverEdge(c, cover_.end(h)).is_left(p)) {
      h = cover_.next(h);
    }
  }
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
