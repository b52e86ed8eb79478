// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Isolines and bands in the cells of a mesh: isolines() and bands() of cells.
//
// in    cells as rings of corners, a value for each corner
// out   lines and regions on triangles: cells with three corners, and those from the middle of each
//       other cell to its sides, with the value that native_weights() gives to the middle
// index points as given, then the middles; triangles cell by cell
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrangement/ring_arrays.h"
#include "exact/angles.h"
#include "exact/point_order.h"
#include "exact/vector.h"
#include "interpolation/contour_surface.h"
#include "interpolation/settled_mean.h"
#include "overlay/barycentric.h"
#include "overlay/overlaps.h"
#include "rondel/contours.h"
#include "rondel/error.h"
#include "rondel/native_weights.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"
#include "system/distinct.h"
#include "system/job.h"

namespace rondel {
namespace {

// The triangles of the cells, with the values of their corners.
class CellTriangles {
 public:
  CellTriangles(const CellRings& cells, std::span<const double> values, const Execution& execution)
      : points_(cells.points), values_(values.begin(), values.end()) {
    arrangement::validate_rings(cells);
    if (values.size() != cells.points.size()) {
      throw InvalidInput("there are " + std::to_string(values.size()) + " values for " +
                         std::to_string(cells.points.size()) + " points");
    }
    unite_places();
    std::vector<Point> middles;
    for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) take(cells, cell, middles);
    give_values(cells, middles, execution);
    find_neighbors();
    if (!covers_sphere_once()) require_apart(execution);
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] interpolation::ContourSurface surface() const {
    return {.faces = faces_, .neighbors = neighbors_, .sites = points_};
  }

 private:
  // Finds the first point of each place, which gets the first value there.
  void unite_places() {
    system::Distinct<Point> places = system::distinct<Point>(points_);
    std::vector<Index> first(places.values.size(), no_index);
    own_.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Index& known = first[places.numbers[i]];
      if (known == no_index) known = static_cast<Index>(i);
      own_[i] = known;
      if (std::isnan(values_[known])) values_[known] = values_[i];
    }
  }

  // Takes the triangles of a cell. `middles` are the points that cells with more corners get.
  void take(const CellRings& cells, std::size_t cell, std::vector<Point>& middles) {
    const std::uint64_t num_rings = cells.cells[cell + 1] - cells.cells[cell];
    const std::string text = "cell " + std::to_string(cell);
    if (num_rings > 1) throw InvalidInput(text + " has several rings", cell);
    std::vector<Index> ring;
    if (num_rings == 1) {
      for (const Index i : cells.corners_of(cells.cells[cell])) {
        if (ring.empty() || ring.back() != own_[i]) ring.push_back(own_[i]);
      }
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    }
    if (ring.size() < 3) return;
    require_narrow(ring, text, cell);
    if (ring.size() == 3) {
      const Sign turn = orientation(points_[ring[0]], points_[ring[1]], points_[ring[2]]);
      if (turn == Sign::positive) faces_.push_back({ring[0], ring[1], ring[2]});
      if (turn == Sign::negative) faces_.push_back({ring[0], ring[2], ring[1]});
    } else {
      take_from_middle(ring, text, cell, middles);
    }
    owners_.resize(faces_.size(), static_cast<Index>(cell));
  }

  // Throws InvalidInput for a cell as wide as a hemisphere, as native_weights() does: which of the two sides
  // of its ring is the cell, nothing says.
  void require_narrow(std::span<const Index> ring, const std::string& text,
                      std::size_t cell) const {
    Point sum{0, 0, 0};
    for (const Index i : ring) sum = sum + points_[i];
    const bool is_wide =
        std::ranges::any_of(ring, [&](Index i) { return !(dot(sum, points_[i]) > 0); });
    if (is_wide) throw InvalidInput(text + " is as wide as a hemisphere", cell);
  }

  // The middle is that of the corners, from the one that comes first by coordinates, so that it does
  // not depend on where the ring begins.
  void take_from_middle(std::vector<Index>& ring, const std::string& text, std::size_t cell,
                        std::vector<Point>& middles) {
    turn_left(points_, ring);
    const auto first = std::ranges::min_element(
        ring, [&](Index a, Index b) { return exact::is_less(points_[a], points_[b]); });
    std::rotate(ring.begin(), first, ring.end());
    Point sum{};
    for (const Index corner : ring) sum = sum + points_[corner];
    const Point middle = normalized(sum);
    const auto number = static_cast<Index>(points_.size() + middles.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Index from = ring[k];
      const Index to = ring[k + 1 < ring.size() ? k + 1 : 0];
      if (orientation(points_[from], points_[to], middle) != Sign::positive) {
        throw InvalidInput(text + " is not seen whole from the middle of its corners", cell);
      }
      faces_.push_back({from, to, number});
    }
    middles.push_back(middle);
  }

  // Appends the middles to the points, with the values of native_weights().
  void give_values(const CellRings& cells, const std::vector<Point>& middles,
                   const Execution& execution) {
    if (middles.empty()) return;
    const Weights weights = native_weights(cells, middles, execution);
    points_.insert(points_.end(), middles.begin(), middles.end());
    values_.reserve(points_.size());
    for (std::size_t m = 0; m < middles.size(); ++m) {
      double value = weights.offsets[m] < weights.offsets[m + 1]
                         ? 0
                         : std::numeric_limits<double>::quiet_NaN();
      for (std::uint64_t k = weights.offsets[m]; k < weights.offsets[m + 1]; ++k) {
        value += weights.values[k] * values_[own_[weights.columns[k]]];
      }
      const std::uint64_t end = weights.offsets[m + 1];
      values_.push_back(interpolation::settled_mean(value, [&](const auto& visit) {
        for (std::uint64_t k = weights.offsets[m]; k < end; ++k) {
          visit(weights.values[k], values_[own_[weights.columns[k]]]);
        }
      }));
    }
  }

  // A side of a triangle, named by its ends in ascending order.
  struct FanSide {
    Index low;
    Index high;
    bool is_ascending;  // in the direction of the triangle
    Index face;
    unsigned corner;  // opposite to the side
  };

  // Finds the triangle across each side. Throws InvalidInput if two triangles are on the same side of
  // one, so that they overlap.
  void find_neighbors() {
    std::vector<FanSide> sides;
    sides.reserve(3 * faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        const Index from = faces_[f][(k + 1) % 3];
        const Index to = faces_[f][(k + 2) % 3];
        sides.push_back(
            {std::min(from, to), std::max(from, to), from < to, static_cast<Index>(f), k});
      }
    }
    std::ranges::sort(sides, [](const FanSide& a, const FanSide& b) {
      return std::tie(a.low, a.high, a.is_ascending, a.face) <
             std::tie(b.low, b.high, b.is_ascending, b.face);
    });
    neighbors_.assign(faces_.size(), {no_index, no_index, no_index});
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const FanSide& a = sides[k - 1];
      const FanSide& b = sides[k];
      if (a.low != b.low || a.high != b.high) continue;
      if (a.is_ascending == b.is_ascending) {
        throw InvalidInput(
            "cells overlap: two are on the same side of the arc between the points " +
                std::to_string(a.low) + " and " + std::to_string(a.high),
            a.low);
      }
      neighbors_[a.face][a.corner] = b.face;
      neighbors_[b.face][b.corner] = a.face;
    }
  }

  // True if the triangles have no border and cover the sphere as often as once, by their area: as all turn to
  // the left, they do not overlap then.
  [[nodiscard]] bool covers_sphere_once() const {
    const auto has_border = [](const Triple& neighbors) {
      return std::ranges::count(neighbors, no_index) != 0;
    };
    if (std::ranges::any_of(neighbors_, has_border)) return false;
    double area = 0;
    for (const Triple& face : faces_) {
      area += exact::triangle_area(points_[face[0]], points_[face[1]], points_[face[2]]);
    }
    return area < 6 * std::numbers::pi;
  }

  // Throws InvalidInput for the first two cells that overlap by more than rounding.
  void require_apart(const Execution& execution) const {
    CellRings triangles;
    triangles.points = points_;
    for (const Triple& face : faces_) {
      triangles.append_ring(face);
      triangles.end_cell();
    }
    std::vector<CrossingCells> pairs =
        overlapping_cells(triangles, {.threads = execution.threads, .stop = execution.stop});
    for (CrossingCells& pair : pairs) {
      std::tie(pair.first, pair.second) = std::minmax({owners_[pair.first], owners_[pair.second]});
    }
    const auto first = std::ranges::min_element(
        pairs, {}, [](const CrossingCells& pair) { return std::pair(pair.first, pair.second); });
    if (first != pairs.end()) throw InvalidInput(overlay::message_of(*first), first->second);
  }

  std::vector<Point> points_;
  std::vector<double> values_;
  std::vector<Index> own_;  // the first point in the place of each
  std::vector<Triple> faces_;
  std::vector<Index> owners_;  // the cell of each triangle
  std::vector<Triple> neighbors_;
};

}  // namespace

Isolines isolines(const CellRings& cells, std::span<const double> values,
                  std::span<const double> levels, const Execution& execution) {
  const system::Call call(execution);
  const CellTriangles triangles(cells, values, execution);
  return interpolation::isolines_on(triangles.surface(), triangles.values(), levels, execution);
}

Bands bands(const CellRings& cells, std::span<const double> values, std::span<const double> levels,
            const Execution& execution) {
  const system::Call call(execution);
  const CellTriangles triangles(cells, values, execution);
  return interpolation::bands_on(triangles.surface(), triangles.values(), levels, execution);
}

}  // namespace rondel
