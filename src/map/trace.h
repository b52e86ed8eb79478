// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Draws the boundary of a region of the sphere in the plane of longitude and latitude.
//
// The plane is the rectangle [-180, 180] x [-90, 90]: the sphere, cut along the antimeridian, with
// each pole drawn out into a side. A ring that crosses the antimeridian or passes through a pole
// is cut into chains that run from side to side of the rectangle:
//
//      +--------------N-------------+        a ring around the north pole is one chain
//      |     region   ^             |        from the left side to the right side
//     -+---->---->---------->--->---+-
//      |                            |
//      +--------------S-------------+
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "map/arc.h"

namespace rondel::map {

// A drawn ring or line: its chains, one after the other.
struct Trace {
  std::vector<MapPoint> points;  // the points of all chains
  // For each point, the arc of the ring on which the line that begins there lies.
  std::vector<std::uint32_t> arcs;
  // The first point of each chain; empty if the ring is one closed loop.
  std::vector<std::size_t> starts;
  // True if the north pole's end of the antimeridian is inside of the region.
  bool has_north_corners = false;
};

// Draws a ring of at least three points, each snapped() and different from the next. Arc i runs
// from point i to the next one and is densified to tolerances[i]. The side on which an arc passes a
// pole and the place where it crosses the antimeridian depend on the arc alone, so that the regions
// on both sides of it fit together. Precondition: the region to the left of the ring is spherically
// convex, at most a hemisphere.
void draw(std::span<const Point> ring, std::span<const ArcTolerance> tolerances, Trace& trace,
          MapPositions positions = MapPositions::computed);

// Draws an open line of at least two points in the same way. The first points of all its chains are
// in `starts`.
void draw_line(std::span<const Point> line, const ArcTolerance& tolerance, Trace& trace,
               MapPositions positions = MapPositions::computed);

// Returns all pairs of lines of a trace that meet without being neighbors: the places where a ring
// that is simple on the sphere crosses itself when it is drawn in the plane. A line is named by its
// first point. Nearly parallel arcs that are densified at different places have such lines. The
// time is O(n log n) plus the number of pairs of lines whose rectangles overlap.
std::vector<std::pair<std::size_t, std::size_t>> crossing_lines(const Trace& trace);

// True if two lines of a closed loop of distinct positions meet without being neighbors. The time
// is O(n^2).
bool has_crossing_lines(std::span<const LonLat> loop);

}  // namespace rondel::map
