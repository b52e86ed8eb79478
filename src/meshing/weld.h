// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Welds features that touch up to rounding. Where a corner of one should be on a side of another one,
// rounded numbers leave a gap, or an overlap, of some units in the last decimal. A refinement would
// fill it with triangles that are as small.
//
// in    lines, points and polygons, and how near is too near at each place
// out   the same, without places that are too near to another one, and with lines and rings that run
//       through the places that are too near to them
// index features; sites are their places, each once
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "rondel/cell_rings.h"
#include "rondel/geometries.h"
#include "rondel/types.h"

namespace rondel::meshing {

// The distance of places that should be one, which unit vectors have rounded to different ones.
inline constexpr double rounding_of_places = 1e-12;

// `near_at` returns a distance on the unit sphere. Places that stay keep their coordinates. Places of
// one line or ring are welded only where the way along it is more than eight times as long as their
// distance, or they are as near as rounding_of_places. A ring vanishes of which no three corners are
// left, or all are near one of them, and a small one that would be turned inside out; and so do rings of
// its polygon that are within it. Those all of whose given corners are near one of them vanish first
// (drop_tiny_rings()). A line of which one point is left becomes that point, and one all of whose points
// are near one of them does so first (shrink_tiny_lines()). Polygons that have changed
// are repaired (rondel/set_operations.h), each by itself; those without rings that had the outside of
// these are the whole sphere.
//
// Places that are not `given`, which is sorted, are where features cross: they are no shape of a line or a
// ring, and go to the nearest given place that is too near, but not across a narrow part of a ring. If
// there are none, all are given.
// Precondition: no polygon is the whole sphere.
void weld(Geometries& features, const std::function<double(const Point&)>& near_at,
          std::span<const Point> given = {});

// Leaves out rings all of whose corners are near one of them, and those within them, so that nothing is
// welded to what vanishes.
void drop_tiny_rings(CellRings& polygons, const std::function<double(const Point&)>& near_at);

// Lets lines all of whose points are near one of them become that point.
void shrink_tiny_lines(FeatureLines& lines, const std::function<double(const Point&)>& near_at);

// Returns the points of lines and the corners of polygons, sorted.
std::vector<Point> places_of(const Geometries& features);

}  // namespace rondel::meshing
