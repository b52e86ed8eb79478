// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The boundary of a region of the sphere, drawn in the plane of longitude and latitude.
//
// The plane is the rectangle [-180, 180] x [-90, 90]: the sphere, cut along the antimeridian, with
// each pole drawn out into a side. A ring that crosses the antimeridian or passes through a pole
// falls into chains that run from side to side of the rectangle:
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
#include <vector>

#include "map/arc.h"

namespace rondel::map {

struct Trace {
  std::vector<MapPoint> points;     // of all chains, one after the other
  std::vector<std::uint32_t> arcs;  // the arc of the ring on which the line from each point runs
  std::vector<std::size_t> starts;  // the first point of each chain; empty: one closed loop
  bool has_north_corners = false;   // the region has the antimeridian at the north pole inside
};

// Draws a ring of at least three points, each snapped() and different from the next; arc i runs
// from point i to the next one and is densified to tolerances[i].
// Which side of a pole an arc passes, and where it crosses the antimeridian, depends on the
// arc alone, so that the regions on both sides of it fit together.
// Precondition: the region, to the left of the ring, is spherically convex (at most a hemisphere).
void draw(std::span<const Point> ring, std::span<const ArcTolerance> tolerances, Trace& trace);

// Draws an open line of at least two points in the same way: all of its chains are in `starts`.
void draw_line(std::span<const Point> line, const ArcTolerance& tolerance, Trace& trace);

}  // namespace rondel::map
