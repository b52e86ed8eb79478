// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The strip along a side is between the side and its parallel; where the border turns away from the
// outside, the sector around the corner is added to the strip before it:
//
//         .---------------------.        Strips of sides that turn the other way overlap, or share the
//         |        strip        | `.     place where their parallels meet. So do those of nearly
//         |                     |   .    straight sides: then rounding decides nothing.
//       before ---------------- corner
//                                  `
//                                   after
//
// A place whose nearest place is within a side is in the strip of the side; otherwise its nearest
// place is a corner, and it is in the sector. On the other side of the border strips are as wide as
// the tolerance, without gaps at corners, so that they overlap with the polygon itself.
//
// From 90 degrees on, a disk is convex as seen from its complement: a place is farther than the
// distance from a side if it is so from both of its ends, so disks around corners are the buffer.
#include "arrangement/buffer_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "exact/vector.h"
#include "rondel/predicates.h"

namespace rondel::arrangement {
namespace {

void append_cell(const Corners& ring, CellRings& cells) {
  for (const Point& p : ring) {
    cells.corners.push_back(static_cast<Index>(cells.points.size()));
    cells.points.push_back(p);
  }
  cells.end_ring();
  cells.end_cell();
}

// Returns the unit vector at right angles to a side, to its right. The sum or difference of its ends
// is nearly exact where the vector product of the ends is not.
Point right_normal(const Point& from, const Point& to) {
  return normalized(dot(from, to) > 0 ? cross(to, from - to) : cross(to, from + to));
}

void append_hemisphere(const Point& center, CellRings& cells) {
  const Point axis = std::abs(center.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point right = normalized(cross(axis, center));
  const Point up = normalized(cross(center, right));
  append_cell({right, up, -1.0 * right, -1.0 * up}, cells);
}

}  // namespace

BufferPieces::BufferPieces(double distance, double tolerance) {
  constexpr double pi = std::numbers::pi;
  if (distance + tolerance >= pi) {
    kind_ = PieceKind::everything;
  } else if (std::abs(distance - pi / 2) <= tolerance) {
    kind_ = PieceKind::hemispheres;
  } else {
    kind_ = distance < pi / 2 ? PieceKind::sides : PieceKind::disks;
    const double radius = distance < pi / 2 ? distance : pi - distance;
    curves_.emplace(radius, std::min(tolerance, radius / 2));
  }
}

std::size_t BufferPieces::count(const BufferLoop& loop) const {
  const std::size_t size = loop.points.size();
  if (kind_ == PieceKind::everything) return 1;
  return kind_ == PieceKind::sides || !loop.is_line ? size : size / 2 + 1;
}

std::size_t BufferPieces::overlap(const BufferLoop& loop) const {
  if (kind_ != PieceKind::sides) return 0;
  return loop.is_line ? 2 : 1;
}

void BufferPieces::append(const BufferLoop& loop, std::size_t number, CellRings& cells) const {
  const std::size_t k = number % count(loop);
  const Point& p = loop.points[k];
  Corners ring;
  switch (kind_) {
    case PieceKind::sides:
      if (loop.points.size() == 1) {
        curves_->append_circle(p, ring);
        append_cell(ring, cells);
      } else if (!loop.is_line) {
        append_strip(loop.points, k, cells);
      } else {
        // A side and the way back along it, one after the other.
        append_strip(loop.points, k % 2 == 0 ? k / 2 : loop.points.size() - 1 - k / 2, cells);
      }
      return;
    case PieceKind::hemispheres:
      append_hemisphere(p, cells);
      return;
    case PieceKind::disks:
      curves_->append_circle(-1.0 * p, ring);
      std::ranges::reverse(ring);
      append_cell(ring, cells);
      return;
    case PieceKind::everything:
      cells.whole.push_back(static_cast<Index>(cells.num_cells()));
      cells.end_cell();
      return;
  }
}

BufferPieces::Joint BufferPieces::joint(const Point& before, const Point& corner,
                                        const Point& after) const {
  Joint result = {};
  const Point first = result.first_normal = right_normal(before, corner);
  const Point second = result.second_normal = right_normal(corner, after);
  const Sign turn = orientation(before, corner, after);
  // Parallels of short sides may end before they meet.
  result.is_shared = curves_->can_meet(first, second) &&
                     (turn != Sign::negative || (curves_->is_long(before, corner, first, second) &&
                                                 curves_->is_long(corner, after, first, second)));
  if (result.is_shared) {
    result.arrival = result.departure = curves_->meeting(corner, first, second);
    result.inner_arrival = result.inner_departure =
        curves_->inner(corner, normalized(first + second));
    return result;
  }
  result.has_turn = turn == Sign::positive || (turn == Sign::zero && dot(first, second) < 0);
  result.may_gape = !result.has_turn && curves_->may_gape(first, second);
  result.arrival =
      result.has_turn ? curves_->begin_of_turn(corner, first) : curves_->at(corner, first);
  result.departure =
      result.has_turn ? curves_->end_of_turn(corner, second) : curves_->at(corner, second);
  result.inner_arrival = curves_->inner(corner, first);
  result.inner_departure = curves_->inner(corner, second);
  return result;
}

void BufferPieces::append_strip(std::span<const Point> loop, std::size_t side,
                                CellRings& cells) const {
  const auto at = [&](std::size_t k) { return loop[(side + k) % loop.size()]; };
  const Point from = at(0);
  const Point to = at(1);
  const Joint begin = joint(at(loop.size() - 1), from, to);
  const Joint end = joint(from, to, at(2));
  Corners ring = {end.inner_arrival};
  // Between places farther from each other than 90 degrees a side would be far from the border.
  if (dot(from, to) < 0) {
    ring.push_back(curves_->inner(normalized(cross(from, end.first_normal)), end.first_normal));
  }
  ring.push_back(begin.inner_departure);
  if (!begin.is_shared) ring.push_back(from);
  ring.push_back(begin.departure);
  curves_->append_parallel(from, end.first_normal, begin.departure, end.arrival, ring);
  if (end.has_turn) {
    curves_->append_turn(to, end.first_normal, end.second_normal, ring);
  } else {
    ring.push_back(end.arrival);
  }
  if (!end.is_shared) ring.push_back(to);
  if (!end.is_shared && !end.has_turn) {  // the turn is on the other side
    ring.push_back(end.inner_departure);
    if (dot(end.first_normal, end.second_normal) < 0) {
      ring.push_back(curves_->inner(to, cross(end.first_normal, to)));
    }
  }
  append_cell(ring, cells);
  if (end.may_gape) {
    ring.clear();
    curves_->append_circle(to, ring);
    append_cell(ring, cells);
  }
}

}  // namespace rondel::arrangement
