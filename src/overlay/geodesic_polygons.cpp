// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/vector.h"
#include "map/ring_area.h"
#include "overlay/border_rings.h"
#include "overlay/feature_polygons.h"
#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "rondel/regions.h"

namespace rondel::overlay {
namespace {

// Returns the sign of a turn, or zero if rounding of the corners may have made it.
Sign sure_turn(const Point& p, const Point& q, const Point& r) {
  constexpr double rounding = 1e-12;
  const exact::Vector3<double> in = exact::to_vector(q) - exact::to_vector(p);
  const exact::Vector3<double> out = exact::to_vector(r) - exact::to_vector(q);
  const double turn = dot(exact::to_vector(q), cross(in, out));
  if (!(std::abs(turn) > rounding * (norm(in) + norm(out)))) return Sign::zero;
  return turn > 0 ? Sign::positive : Sign::negative;
}

// The corner of a ring that is farthest in the west, of several of them the one with the least latitude.
// Longitudes are compared as they were given but for whole turns, which the ring adds up to.
class WesternmostCorner {
 public:
  explicit WesternmostCorner(const std::vector<LonLat>& positions) {
    const std::size_t n = positions.size();
    double turns = 0;
    double west = positions[0].lon_deg;
    double east = west;
    for (std::size_t k = 1; k <= n; ++k) {
      const LonLat& p = positions[k < n ? k : 0];
      const double step = p.lon_deg - positions[k - 1].lon_deg;
      if (std::abs(step) > 180) turns -= std::nearbyint(step / 360);
      if (std::abs(p.lat_deg) == 90 || std::abs(std::remainder(step, 360)) == 180) return;
      if (k == n) break;
      const double lon = p.lon_deg + 360 * turns;
      if (lon < west || (lon == west && p.lat_deg < positions[corner_].lat_deg)) corner_ = k;
      west = std::min(west, lon);
      east = std::max(east, lon);
    }
    is_known_ = turns == 0 && east - west < 180 && n > 2;
  }

  // False for a ring that spans 180 degrees of longitude or has a pole.
  [[nodiscard]] bool is_known() const { return is_known_; }
  [[nodiscard]] std::size_t operator*() const { return corner_; }

 private:
  std::size_t corner_ = 0;
  bool is_known_ = false;
};

// True if a ring is clockwise. For a ring that spans less than 180 degrees of longitude and has no
// pole the turn at its westernmost corner says so, whose meridian has the ring on one side, unless
// rounding may have changed that. Otherwise the smaller side is the inside.
bool goes_clockwise(const std::vector<LonLat>& positions, const std::vector<Point>& corners) {
  const std::size_t n = positions.size();
  const WesternmostCorner west(positions);
  // A corner that the ring passes twice may be the foot of a spike, which says nothing.
  if (west.is_known() && std::ranges::count(corners, corners[*west]) == 1) {
    const Point& before = corners[*west > 0 ? *west - 1 : n - 1];
    const Point& after = corners[*west + 1 < n ? *west + 1 : 0];
    const Sign sign = sure_turn(before, corners[*west], after);
    if (sign != Sign::zero) return sign == Sign::negative;
  }
  return map::area_on_left(corners) < 0;
}

// Converts all features.
class GeodesicCells {
 public:
  GeodesicCells(const map::PolygonFeatures& features, const Execution& execution, FaultTexts texts)
      : features_(features),
        execution_(execution),
        texts_(texts),
        areas_(features.rings.size(), 0) {}

  // Returns the cells of all features. Throws FileError.
  CellRings operator()() {
    CellRings given;
    for (std::size_t f = 0; f < features_.rings.size(); ++f) {
      const std::vector<map::LonLatRing>& rings = features_.rings[f];
      std::size_t part = arcs_.size();
      ArcBalance balance;  // of the part
      Index shell = 0;
      for (Index r = 0; r < rings.size(); ++r) {
        const std::size_t first = arcs_.size();
        append(f, r);
        for (std::size_t k = first; k < arcs_.size(); ++k) {
          given.corners.push_back(static_cast<Index>(k));
          given.points.push_back(arcs_[k].from);
        }
        given.end_ring();
        require_area(f, r, first);
        if (!rings[r].is_hole) {
          part = first;
          shell = r;
          balance = {};
        }
        balance.add(std::span(arcs_).subspan(first));
        if (rings[r].is_hole && balance.may_be_nothing() &&
            is_nothing(std::span(arcs_).subspan(part))) {
          refuse_feature(features_, f,
                         "the holes of " + ring_name(rings, shell) + " leave nothing of it");
        }
      }
      given.end_cell();
    }
    require_no_crossings(given);
    CellRings cells = rings_around(arcs_, features_.rings.size(), execution_.threads);
    take_whole(given, cells);
    return cells;
  }

 private:
  // Throws FileError if sides of a feature cross.
  void require_no_crossings(const CellRings& given) const {
    for (const CrossingCells& pair : crossing_cells(given, execution_)) {
      if (pair.first != pair.second) continue;
      refuse_feature(features_, pair.first,
                     "the polygon crosses itself at " + text_of_place(pair.place));
    }
  }

  // Throws FileError if all sides of a ring cancel, or if it is on a line.
  void require_area(std::size_t feature, Index ring, std::size_t first_arc) const {
    const std::span<const KeyedArc> arcs = std::span(arcs_).subspan(first_arc);
    if (!is_nothing(arcs) && !is_on_one_line(arcs)) return;
    const std::vector<map::LonLatRing>& rings = features_.rings[feature];
    refuse_feature(features_, feature,
                   ring_name(rings, ring) + " runs to and fro along a line at " +
                       text_of_place(rings[ring].positions.front()));
  }

  // Returns whether a ring is on one great circle, exactly, and does not go around that.
  static bool is_on_one_line(std::span<const KeyedArc> arcs) {
    std::vector<Point> corners;
    for (const KeyedArc& arc : arcs) {
      if (orientation(arcs[0].from, arcs[0].to, arc.to) != Sign::zero) return false;
      corners.push_back(arc.from);
    }
    constexpr double sphere = 4 * std::numbers::pi;
    return std::abs(std::remainder(map::area_on_left(corners), sphere)) < 1;
  }

  // Finds the features that are the whole sphere. The sides that are left after cancelling bound a
  // feature up to whole spheres, whose number follows from the areas. Throws FileError for features
  // that cover a place twice.
  void take_whole(const CellRings& given, CellRings& cells) const {
    constexpr double sphere = 4 * std::numbers::pi;
    const std::vector<double> left = areas(cells);
    for (std::size_t f = 0; f < left.size(); ++f) {
      const double spheres = std::round((areas_[f] - left[f]) / sphere);
      if (spheres == 0) continue;
      if (spheres == 1 && cells.cells[f] == cells.cells[f + 1]) {
        cells.whole.push_back(static_cast<Index>(f));
      } else {
        refuse_overlap(given, f);
      }
    }
  }

  // Throws FileError with two parts of a feature that overlap.
  [[noreturn]] void refuse_overlap(const CellRings& given, std::size_t feature) const {
    constexpr const char* brief = "parts of it overlap";
    if (texts_ == FaultTexts::brief) refuse_feature(features_, feature, brief);
    CellRings parts;
    parts.points = given.points;
    for (std::uint64_t r = given.cells[feature]; r < given.cells[feature + 1]; ++r) {
      const bool is_hole = features_.rings[feature][r - given.cells[feature]].is_hole;
      parts.append_ring(given.corners_of(r));
      if (is_hole && parts.num_cells() > 0) parts.cells.pop_back();
      parts.end_cell();
    }
    for (const CrossingCells& pair : overlapping_cells(parts, execution_)) {
      const std::string first = "part " + std::to_string(pair.first);
      refuse_feature(features_, feature,
                     (pair.first == pair.second
                          ? first + " crosses or overlaps itself at "
                          : first + " and part " + std::to_string(pair.second) + " overlap at ") +
                         text_of_place(pair.place));
    }
    refuse_feature(features_, feature, brief);
  }

  // Appends the arcs of a ring.
  void append(std::size_t feature, Index ring) {
    const std::vector<map::LonLatRing>& rings = features_.rings[feature];
    const std::vector<Point> corners = geodesic_ring(rings[ring]).corners;
    if (corners.size() > 2) {
      const double area = std::abs(map::area_on_left(corners));
      areas_[feature] += rings[ring].is_hole ? -area : area;
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Point& to = corners[k + 1 < corners.size() ? k + 1 : 0];
      if (corners[k] == -1.0 * to) {
        refuse_feature(features_, feature,
                       ring_name(rings, ring) + " joins antipodes: there is no shortest way from " +
                           text_of_place(corners[k]) + " to " + text_of_place(to));
      }
      arcs_.push_back({static_cast<Index>(feature), corners[k], to});
    }
  }

  const map::PolygonFeatures& features_;
  const Execution& execution_;
  FaultTexts texts_;
  std::vector<KeyedArc> arcs_;
  std::vector<double> areas_;  // of each feature: the sum over its rings, without holes
};

}  // namespace

CellRings geodesic_cells(const map::PolygonFeatures& features, const Execution& execution,
                         FaultTexts texts) {
  return GeodesicCells(features, execution, texts)();
}

GeodesicRing geodesic_ring(const map::LonLatRing& ring) {
  GeodesicRing made;
  auto& [positions, corners] = made;
  positions.reserve(ring.positions.size());
  corners.reserve(ring.positions.size());
  for (const LonLat& position : ring.positions) {
    const Point corner = unit_vector(position);
    if (!corners.empty() && corners.back() == corner) continue;
    positions.push_back(position);
    corners.push_back(corner);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) {
    positions.pop_back();
    corners.pop_back();
  }
  if (!corners.empty() && goes_clockwise(positions, corners) != ring.is_hole) {
    std::ranges::reverse(positions);
    std::ranges::reverse(corners);
  }
  return made;
}

void refuse_geodesic_holes(const map::PolygonFeatures& features, std::size_t feature,
                           const Execution& execution) {
  // One feature for each ring, as if it was no hole.
  map::PolygonFeatures alone;
  const std::vector<map::LonLatRing>& rings = features.rings[feature];
  for (map::LonLatRing ring : rings) {
    ring.is_hole = false;
    alone.rings.push_back({std::move(ring)});
  }
  std::vector<CrossingCells> overlaps;
  try {
    overlaps = overlapping_cells(geodesic_cells(alone, execution), execution);
  } catch (const FeatureFault& fault) {
    refuse_feature(features, feature,
                   ring_name(rings, static_cast<Index>(fault.feature())) + ": " + fault.fault());
  }
  const auto overlap = [&](Index a, Index b) {
    return std::ranges::any_of(overlaps, [&](const CrossingCells& pair) {
      return std::minmax(pair.first, pair.second) == std::minmax(a, b);
    });
  };
  Index shell = 0;
  for (Index r = 0; r < rings.size(); ++r) {
    if (!rings[r].is_hole) {
      shell = r;
      continue;
    }
    const auto refuse = [&](const std::string& where) {
      refuse_feature(features, feature,
                     ring_name(rings, r) + ", a hole, does not lie inside of its polygon" + where +
                         " at " + text_of_place(rings[r].positions.front()));
    };
    if (!overlap(shell, r)) refuse("");
    for (Index other = shell + 1; other < r; ++other) {
      if (overlap(other, r)) refuse(" but in " + ring_name(rings, other));
    }
  }
}

}  // namespace rondel::overlay
