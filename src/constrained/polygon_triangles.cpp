// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: halve sides that are too long, add points for the inside, triangulate, and take the faces
// in polygons. Whether an added point is in a polygon need not be known: outside of all polygons it
// changes no face inside, from which it cannot be seen.
#include "rondel/polygon_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "arrangement/arc_checks.h"
#include "arrangement/ring_arrays.h"
#include "constrained/constraints.h"
#include "rondel/constrained.h"
#include "rondel/constrained_features.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel {
namespace constrained {
namespace {

constexpr double most_added_points = 1e8;

// The share of the spacing by which added points are at least away from corners.
constexpr double least_gap = 0.6;

Point unit_vector_of(const LonLat& place) { return unit_vectors(std::array{place}).front(); }

double squared_chord(const Point& a, const Point& b) {
  const double x = a.x - b.x;
  const double y = a.y - b.y;
  const double z = a.z - b.z;
  return x * x + y * y + z * z;
}

// Returns the squared chord of an arc, with the same bits on every machine.
double squared_chord_of(double degrees) {
  return squared_chord({1, 0, 0}, unit_vector_of({degrees, 0}));
}

// Returns the middle of a side, with the same bits for both directions of it; the zero vector for
// opposite points.
Point middle_of(const Point& a, const Point& b) {
  const Point sum = {a.x + b.x, a.y + b.y, a.z + b.z};
  const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
  return length > 0 ? Point{sum.x / length, sum.y / length, sum.z / length} : Point{};
}

// Polygons whose long sides are halved as often as necessary.
class HalvedSides {
 public:
  HalvedSides(const CellRings& polygons, double spacing_deg)
      : polygons_(polygons), longest_(squared_chord_of(spacing_deg)) {}

  CellRings made() {
    require_few();
    halved_.whole = polygons_.whole;
    for (std::size_t cell = 0; cell < polygons_.num_cells(); ++cell) {
      for (std::uint64_t r = polygons_.cells[cell]; r < polygons_.cells[cell + 1]; ++r) {
        const std::span<const Index> ring = polygons_.corners_of(r);
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Point& from = polygons_.points[ring[k]];
          append(from);
          append_inner(from, polygons_.points[ring[(k + 1) % ring.size()]]);
        }
        halved_.end_ring();
      }
      halved_.end_cell();
    }
    return std::move(halved_);
  }

 private:
  void require_few() const {
    double estimate = 0;
    for (std::size_t r = 0; r + 1 < polygons_.rings.size(); ++r) {
      const std::span<const Index> ring = polygons_.corners_of(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point& to = polygons_.points[ring[(k + 1) % ring.size()]];
        estimate += std::sqrt(squared_chord(polygons_.points[ring[k]], to) / longest_);
      }
    }
    if (estimate <= most_added_points) return;
    throw InvalidInput("the spacing is too small for the sides of the polygons");
  }
  void append(const Point& point) {
    halved_.corners.push_back(static_cast<Index>(halved_.points.size()));
    halved_.points.push_back(point);
  }
  void append_inner(const Point& from, const Point& to) {
    if (!(squared_chord(from, to) > longest_)) return;
    const Point middle = middle_of(from, to);
    if (middle == from || middle == to || middle == Point{}) return;
    append_inner(from, middle);
    append(middle);
    append_inner(middle, to);
  }

  const CellRings& polygons_;
  double longest_;  // the squared chord of the longest side
  CellRings halved_;
};

// Returns points in rows along parallels.
std::vector<Point> points_in_rows(double spacing_deg, double low_deg, double high_deg) {
  const double height = spacing_deg * std::sqrt(0.75);  // of a triangle with equal sides
  const double rows = std::ceil(180 / height);
  const double step = 180 / rows;
  const double first = std::max(0.0, std::floor((low_deg + 90) / step - 0.5));
  const double last = std::min(rows - 1, std::ceil((high_deg + 90) / step - 0.5));
  const double estimate = (last - first + 1) * std::ceil(360 / spacing_deg);
  if (!(estimate <= most_added_points)) {
    throw InvalidInput("the spacing " + system::shortest_text(spacing_deg) +
                       " is too small for polygons of this size");
  }
  std::vector<LonLat> places;
  for (double row = first; row <= last; ++row) {
    const double lat = -90 + (row + 0.5) * step;
    const double circle = 360 * unit_vector_of({0, lat}).x;  // in degrees of a great circle
    const double count = std::max(1.0, std::round(circle / spacing_deg));
    const double shift = std::fmod(row, 2) == 0 ? 0 : 0.5;
    for (double k = 0; k < count; ++k) places.push_back({(k + shift) / count * 360 - 180, lat});
  }
  return unit_vectors(places);
}

// Sites, and the sides of polygons between them.
struct SidesOfPolygons {
  std::vector<Point> sites;
  std::vector<std::array<Index, 2>> constraints;
  CompressedRows<Index> polygons;
  std::vector<Index> whole;  // the polygons that are the whole sphere, which have no sides
};

// A triangulation and the faces of each polygon.
struct FilledPolygons {
  Triangulation triangulation;
  CompressedRows<Index> faces;
};

// Throws InvalidInput with the first polygon of which arrange(), which splits sides that cross, would
// refuse a side.
void require_splittable(const SidesOfPolygons& given) {
  for (std::size_t p = 0; p < given.polygons.size(); ++p) {
    for (const Index side : given.polygons[p]) {
      const auto [a, b] = given.constraints[side];
      const std::array ends = {given.sites[a], given.sites[b]};
      try {
        arrangement::validate_points(ends);
        arrangement::validate_ends(ends[0], ends[1], p);
      } catch (const InvalidInput& error) {
        throw InvalidInput(
            "polygon " + std::to_string(p) + " has a side that cannot be divided: " + error.what(),
            p);
      }
    }
  }
}

FilledPolygons faces_of(const SidesOfPolygons& given, const Sites& sites,
                        const Execution& execution) {
  const auto build = [&](ConstraintCrossings crossings) {
    return constrained_delaunay(sites, given.constraints, {.crossings = crossings}, execution);
  };
  ConstrainedTriangulation made;
  try {
    made = build(ConstraintCrossings::refuse);
  } catch (const CrossingConstraints&) {
    require_splittable(given);
    made = build(ConstraintCrossings::split);
  }
  FilledPolygons filled;
  CompressedRows<Index> inside = faces_inside(made, given.constraints, given.polygons);
  filled.triangulation = made.triangulation;
  if (given.whole.empty()) {
    filled.faces = std::move(inside);
    return filled;
  }
  auto whole = given.whole.begin();
  for (Index p = 0; p < inside.size(); ++p) {
    if (whole == given.whole.end() || *whole != p) {
      filled.faces.append(inside[p]);
      continue;
    }
    ++whole;
    for (Index f = 0; f < made.triangulation.num_faces(); ++f) {
      if (!made.triangulation.is_ghost(f)) filled.faces.values.push_back(f);
    }
    filled.faces.end_row();
  }
  return filled;
}

// Fills the polygons. If they leave the hull of the sites, so do the points of the axes, which
// become sites.
FilledPolygons filled(const SidesOfPolygons& given, const std::vector<Point>& added,
                      const Execution& execution) {
  std::vector<Point> sites = given.sites;
  sites.insert(sites.end(), added.begin(), added.end());
  const bool has_sides = !given.constraints.empty();
  if (given.whole.empty()) {
    try {
      FilledPolygons made = faces_of(given, sites, execution);
      if (made.triangulation.dimension() == 2 || !has_sides) return made;
    } catch (const CrossingConstraints&) {
      throw;
    } catch (const InvalidInput&) {
      // Either they leave the hull, or what is wrong is told below.
    }
  }
  for (const double sign : {1.0, -1.0}) {
    for (const Point& axis : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
      sites.push_back({sign * axis.x, sign * axis.y, sign * axis.z});
    }
  }
  return faces_of(given, sites, execution);
}

// True if a pole, at z = 1 or -1, is in a face, up to rounding.
bool has_pole(const Triangulation& t, const Triple& face, double z) {
  const auto sites = t.sites().points();
  bool is_inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& a = sites[face[i]];
    const Point& b = sites[face[(i + 1) % 3]];
    is_inside = is_inside && z * (a.x * b.y - a.y * b.x) >= 0;
  }
  return is_inside;
}

// Returns points for the inside of polygons, apart from their corners. Some may be outside.
std::vector<Point> inner_points(const SidesOfPolygons& given, double spacing_deg,
                                const Execution& execution) {
  const FilledPolygons first = filled(given, {}, execution);
  double low = 90;
  double high = -90;
  for (const LonLat& place : lonlats(given.sites)) {
    low = std::min(low, place.lat_deg - spacing_deg);
    high = std::max(high, place.lat_deg + spacing_deg);
  }
  for (const Index face : first.faces.values) {
    const Triple& corners = first.triangulation.faces()[face];
    if (has_pole(first.triangulation, corners, 1)) high = 90;
    if (has_pole(first.triangulation, corners, -1)) low = -90;
  }
  std::vector<Point> points = points_in_rows(spacing_deg, low, high);
  if (given.sites.empty()) return points;
  const Locator corners(delaunay(given.sites, {}, execution));
  const std::vector<Index> nearest = corners.nearest(points, execution);
  const double gap = least_gap * least_gap * squared_chord_of(std::min(spacing_deg, 180.0));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (squared_chord(points[i], given.sites[nearest[i]]) >= gap) points[kept++] = points[i];
  }
  points.resize(kept);
  return points;
}

// Leaves out the points that are no corners.
PolygonTriangles compacted(const FilledPolygons& given) {
  PolygonTriangles made;
  const auto sites = given.triangulation.sites().points();
  std::vector<Index> numbers(sites.size(), no_index);
  const auto faces = given.triangulation.faces();
  for (const Index face : given.faces.values) {
    for (const Index corner : faces[face]) numbers[corner] = 0;
  }
  for (Index i = 0; i < sites.size(); ++i) {
    if (numbers[i] == no_index) continue;
    numbers[i] = static_cast<Index>(made.points.size());
    made.points.push_back(sites[i]);
  }
  made.triangles.values.reserve(given.faces.values.size());
  for (std::size_t p = 0; p < given.faces.size(); ++p) {
    for (const Index face : given.faces[p]) {
      const Triple& corners = faces[face];
      made.triangles.values.push_back(
          {numbers[corners[0]], numbers[corners[1]], numbers[corners[2]]});
    }
    made.triangles.end_row();
  }
  return made;
}

SidesOfPolygons sides_of(const CellRings& polygons) {
  CellRings rings = polygons;
  rings.whole.clear();
  FeatureLines lines;
  lines.offsets.resize(polygons.cells.size());
  FeatureConstraints made = constraints_of_features(lines, rings);
  return {std::move(made.sites), std::move(made.constraints), std::move(made.polygons),
          polygons.whole};
}

// Returns the same where no two points of the polygons are in one place, without a search for equal
// points; or nothing if the arrays do not fit or a point is not finite.
std::optional<SidesOfPolygons> sides_by_numbers(const CellRings& polygons) {
  try {
    arrangement::validate_rings(polygons);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  SidesOfPolygons made;
  made.whole = polygons.whole;
  made.sites.reserve(polygons.points.size());
  made.constraints.reserve(polygons.corners.size());
  made.polygons.values.reserve(polygons.corners.size());
  std::vector<Index> numbers(polygons.points.size(), no_index);
  const auto number = [&](Index corner) {
    if (numbers[corner] == no_index) {
      numbers[corner] = static_cast<Index>(made.sites.size());
      made.sites.push_back(polygons.points[corner]);
    }
    return numbers[corner];
  };
  for (std::size_t cell = 0; cell < polygons.num_cells(); ++cell) {
    for (std::uint64_t r = polygons.cells[cell]; r < polygons.cells[cell + 1]; ++r) {
      const std::span<const Index> ring = polygons.corners_of(r);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Index from = number(ring[k]);
        const Index to = number(ring[k + 1 < ring.size() ? k + 1 : 0]);
        if (from == to) continue;
        made.polygons.values.push_back(static_cast<Index>(made.constraints.size()));
        made.constraints.push_back({from, to});
      }
    }
    made.polygons.end_row();
  }
  const bool are_finite = std::ranges::all_of(made.sites, [](const Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
  if (!are_finite || made.sites.size() > max_sites) return std::nullopt;
  return made;
}

// Triangulates polygons whose points are in different places, as they are where polygons share
// them. Returns nothing if two are in one place or anything is wrong.
std::optional<PolygonTriangles> triangles_by_numbers(const CellRings& polygons,
                                                     const Execution& execution) {
  const bool may_be_apart =
      polygons.rings.size() > 2 && polygons.points.size() >= polygons.corners.size();
  if (may_be_apart) return std::nullopt;
  const std::optional<SidesOfPolygons> sides = sides_by_numbers(polygons);
  if (!sides) return std::nullopt;
  try {
    const FilledPolygons made = filled(*sides, {}, execution);
    const auto duplicates = made.triangulation.duplicates();
    // Added points may be in the places of corners.
    const bool are_different = duplicates.empty() || duplicates.front().site >= sides->sites.size();
    if (are_different) return compacted(made);
  } catch (const InvalidInput&) {
    // Who looks for equal points says what is wrong.
  }
  return std::nullopt;
}

// Throws InvalidInput with the first polygon that has a side without an arc.
void require_arcs_of(const SidesOfPolygons& given) {
  for (std::size_t p = 0; p < given.polygons.size(); ++p) {
    for (const Index side : given.polygons[p]) {
      require_arc(given.sites, given.constraints[side], {},
                  "polygon " + std::to_string(p) + " has a side that", p);
    }
  }
}

// Triangulates polygons, with points in their inside unless the spacing is 0.
PolygonTriangles triangles_by_places(const CellRings& polygons, double spacing_deg,
                                     const Execution& execution) {
  SidesOfPolygons sides = sides_of(polygons);
  try {
    std::vector<Point> added;
    if (spacing_deg > 0) {
      sides = sides_of(HalvedSides(polygons, std::min(spacing_deg, 180.0)).made());
      added = inner_points(sides, spacing_deg, execution);
    }
    return compacted(filled(sides, added, execution));
  } catch (const InvalidInput&) {
    require_arcs_of(sides);  // what the triangulation says of a side has no polygon
    throw;
  }
}

void require_spacing(double spacing_deg) {
  if (spacing_deg >= 0 && spacing_deg <= std::numeric_limits<double>::max()) return;
  throw InvalidInput("the spacing " + system::shortest_text(spacing_deg) +
                     " is no angle from 0 degrees on");
}

}  // namespace
}  // namespace constrained

PolygonTriangles triangles_of_polygons(const CellRings& polygons, double spacing_deg,
                                       const Execution& execution) {
  const system::Call call(execution);
  constrained::require_spacing(spacing_deg);
  if (spacing_deg == 0) {
    if (auto made = constrained::triangles_by_numbers(polygons, execution)) return std::move(*made);
  }
  return constrained::triangles_by_places(polygons, spacing_deg, execution);
}

}  // namespace rondel
