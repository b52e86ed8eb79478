// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/constrained.h: what it promises of any sites and any pairs of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "fuzz/fuzz_input.h"
#include "rondel/constrained.h"
#include "rondel/constrained_features.h"
#include "rondel/constrained_interpolate.h"
#include "rondel/constrained_locator.h"
#include "rondel/delaunay.h"
#include "rondel/longitudes.h"
#include "rondel/polygon_triangles.h"
#include "rondel/predicates.h"

namespace rondel::fuzz {
namespace {

using Edge = std::array<Index, 2>;

// Removes constraints until none is refused, and returns the triangulation of the rest.
ConstrainedTriangulation without_refused(const std::vector<Point>& sites,
                                         std::vector<Edge>& constraints, const Sphere& sphere) {
  while (true) {
    try {
      return constrained_delaunay(sites, constraints, {.sphere = sphere});
    } catch (const CrossingConstraints& error) {
      const auto [first, second] = error.constraints();
      require(first < second && second < constraints.size() && error.index() == second,
              "two constraints cross");
      const LonLat place = error.place();
      require(place.lon_deg >= -180 && place.lon_deg <= 180 && place.lat_deg >= -90 &&
                  place.lat_deg <= 90,
              "they cross at a place");
      const std::vector<Edge> both = {constraints[first], constraints[second]};
      refuse(1, [&] { return constrained_delaunay(sites, both, {.sphere = sphere}); });
      constraints.erase(constraints.begin() + second);
    } catch (const InvalidInput& error) {
      require(error.index() < constraints.size(), "a constraint is named");
      constraints.erase(constraints.begin() + static_cast<std::ptrdiff_t>(error.index()));
    }
  }
}

// A query is in the face where it is found, and otherwise in none.
void test_location(const ConstrainedTriangulation& result, const std::vector<Point>& queries) {
  const Triangulation& t = result.triangulation;
  if (t.dimension() < 2) return;
  const std::vector<Location> found = ConstrainedLocator(result).locate(queries);
  const auto has = [&](Index f, const Point& query) {
    const Triple& face = t.faces()[f];
    for (unsigned i = 0; i < 3; ++i) {
      if (orientation(t.sites()[face[i]], t.sites()[face[(i + 1) % 3]], query, t.sphere()) ==
          Sign::negative) {
        return false;
      }
    }
    return true;
  };
  for (std::size_t k = 0; k < queries.size(); ++k) {
    Index first = 0;
    while (first < t.num_faces() && (t.is_ghost(first) || !has(first, queries[k]))) ++first;
    require(found[k].face == (first < t.num_faces() ? first : no_index),
            "a query is in the first face that has it");
  }
}

// Weights are those of corners of the face in which a query is found, none is negative, and their
// sum is 1.
void test_interpolation(const ConstrainedTriangulation& result, const std::vector<Point>& queries) {
  const Triangulation& t = result.triangulation;
  const ConstrainedInterpolator interpolator(result);
  const Weights weights = interpolator.weights(queries);
  const std::vector<double> field(t.num_sites(), 1.0);
  const std::vector<double> values = interpolator.values(field, queries);
  const std::vector<Location> found = ConstrainedLocator(result).locate(queries);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const std::uint64_t begin = weights.offsets[k];
    const std::uint64_t end = weights.offsets[k + 1];
    require((begin == end) == (found[k].where == Where::outside), "weights exist in faces alone");
    require((begin == end) == !(std::abs(values[k] - 1) <= 1e-12), "the weights have the sum 1");
    for (std::uint64_t e = begin; e < end; ++e) {
      require(weights.values[e] >= 0, "no weight is negative");
      if (t.dimension() < 2) continue;
      const Triple& face = t.faces()[found[k].face];
      const Point& site = t.sites()[weights.columns[e]];
      require(std::ranges::any_of(face,
                                  [&](Index v) {
                                    return is_same_site(t.sites()[v], site, Model::projected,
                                                        t.sphere());
                                  }),
              "weights are those of corners");
    }
  }
}

void test_laws(const std::vector<Point>& sites, std::vector<Edge> constraints,
               const Sphere& sphere) {
  const ConstrainedTriangulation result = without_refused(sites, constraints, sphere);
  const Triangulation& t = result.triangulation;
  const CheckReport report = check_constrained(sites, constraints, t.faces(), sphere);
  require(report.is_valid, report.reason);
  require(result.sides.size() == t.num_faces(), "sides belong to faces");
  require(result.sources.size() == result.edges.size(), "edges come from constraints");
  require(std::ranges::is_sorted(result.edges), "edges are in order");
  std::vector<Point> queries = sites;
  for (const Point& p : sites) queries.push_back({p.y, p.z, p.x});
  std::erase(queries, sphere.center);
  test_location(result, queries);
  test_interpolation(result, queries);
  const auto again = constrained_delaunay(sites, result.edges, {.sphere = sphere});
  require(std::ranges::equal(again.triangulation.faces(), t.faces()), "edges are constraints");
  std::ranges::reverse(constraints);
  for (Edge& edge : constraints) std::swap(edge[0], edge[1]);
  const auto reversed =
      constrained_delaunay(sites, constraints, {.sphere = sphere}, {.threads = 2});
  require(std::ranges::equal(reversed.triangulation.faces(), t.faces()) &&
              reversed.edges == result.edges,
          "the order of constraints changes nothing");
}

// The sides of a triangle of sites have a polygon on their left and one on their right, which cover
// all solid faces, unless one of them leaves the hull.
void test_inside(const std::vector<Point>& sites, const std::vector<Edge>& all,
                 const Sphere& sphere) {
  if (all.empty() || sites.empty()) return;
  const auto [a, b] = all.front();
  const auto c = static_cast<Index>((a + b) % sites.size());
  const std::vector<Edge> sides = {{a, b}, {b, c}, {c, a}, {a, c}, {c, b}, {b, a}};
  CompressedRows<Index> polygons;
  polygons.append(std::array<Index, 3>{0, 1, 2});
  polygons.append(std::array<Index, 3>{3, 4, 5});
  try {
    const auto result = constrained_delaunay(sites, sides, {.sphere = sphere});
    const auto inside = faces_inside(result, sides, polygons);
    const Triangulation& t = result.triangulation;
    std::vector<int> count(t.num_faces());
    for (const Index face : inside.values) ++count[face];
    const bool is_empty = inside.values.empty();  // all sides are on one great circle
    for (Index f = 0; f < count.size(); ++f) {
      const int expected = is_empty || t.is_ghost(f) ? 0 : 1;
      require(count[f] == expected, "each solid face is on one side of a triangle");
    }
  } catch (const InvalidInput&) {
  }
}

// Sites that are not unit vectors are refused; otherwise what crosses is divided.
void test_split(const std::vector<Point>& sites, const std::vector<Edge>& constraints) {
  try {
    const auto result =
        constrained_delaunay(sites, constraints, {.crossings = ConstraintCrossings::split});
    const Triangulation& t = result.triangulation;
    const CheckReport report = check_constrained(t.sites().points(), result.edges, t.faces());
    require(report.is_valid, report.reason);
  } catch (const InvalidInput&) {
  }
}

// Triangles of polygons are positive, have no side in common in one direction, and no point is idle.
void test_triangles(const CellRings& polygons) {
  for (const double spacing : {0.0, 30.0}) {
    try {
      const PolygonTriangles made = triangles_of_polygons(polygons, spacing);
      require(made.triangles.size() == polygons.num_cells(), "each polygon has a row");
      std::vector<bool> is_used(made.points.size());
      std::vector<Edge> sides;
      for (const Triple& t : made.triangles.values) {
        require(orientation(made.points.at(t[0]), made.points.at(t[1]), made.points.at(t[2])) ==
                    Sign::positive,
                "triangles are positive");
        for (std::size_t i = 0; i < 3; ++i) {
          is_used[t[i]] = true;
          sides.push_back({t[i], t[(i + 1) % 3]});
        }
      }
      require(std::ranges::count(is_used, false) == 0, "each point is a corner");
      std::ranges::sort(sides);
      require(std::ranges::adjacent_find(sides) == sides.end(), "triangles do not overlap");
    } catch (const InvalidInput&) {  // sides that do not divide in and out
    }
  }
}

// Degrees of the turn of others are in it: here of those 200 degrees to the east.
void test_turn(const std::vector<Point>& sites, const std::vector<LonLat>& positions) {
  LongitudeExtent given;
  for (const LonLat& place : positions) given.include({place.lon_deg + 200, place.lon_deg + 200});
  require(given.is_empty() == positions.empty(), "an extent without longitudes is empty");
  const double west_deg = west_of(given);
  for (const LonLat& place : short_lonlats(sites, west_deg)) {
    const double from_west = place.lon_deg - west_deg;
    require(from_west > -1e-5 && from_west < 360 + 1e-5, "longitudes are in the turn");
  }
}

// A ring has the sides of the line along it, and one more if its ends are apart.
void test_features(const std::vector<Point>& points) {
  if (points.empty()) return;
  FeatureLines lines;
  lines.rows.append(points);
  lines.end_group();
  lines.end_group();
  CellRings polygons;
  polygons.points = points;
  polygons.end_cell();
  std::vector<Index> ring(points.size());
  std::iota(ring.begin(), ring.end(), Index{0});
  polygons.append_ring(ring);
  polygons.end_cell();
  const FeatureConstraints made = constraints_of_features(lines, polygons);
  const auto of_line = std::ranges::count(made.features, Index{0});
  const auto of_ring = static_cast<std::ptrdiff_t>(made.polygons.values.size());
  require(made.features.size() == made.constraints.size() && made.polygons.size() == 2 &&
              static_cast<std::ptrdiff_t>(made.features.size()) == of_line + of_ring,
          "constraints belong to features");
  require(of_ring == of_line || of_ring == of_line + 1, "a ring closes");
  for (const auto& [a, b] : made.constraints) {
    require(a != b && a < made.sites.size() && b < made.sites.size(), "constraints join sites");
  }
  for (const Point& p : made.sites) {
    require(std::ranges::count(made.sites, p) == 1, "each place is one site");
  }
  const std::vector<LonLat> usual = lonlats(made.sites);
  const std::vector<LonLat> shortest = short_lonlats(made.sites);
  const std::vector<Point> back = unit_vectors(shortest);
  for (std::size_t i = 0; i < usual.size(); ++i) {
    require(shortest[i] == usual[i] || back[i] == made.sites[i],
            "short degrees are those of a site");
  }
  test_turn(made.sites, shortest);
  test_triangles(polygons);
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 40);
  const Sphere sphere = fuzz::next_sphere(source, scales);
  std::vector<std::array<Index, 2>> constraints(source.below(24));
  for (auto& [a, b] : constraints) {
    a = source.byte() % 16;
    b = source.byte() % 16;
  }
  const std::vector<Point> sites =
      fuzz::all_sites(source, limit, scales, {Model::projected, sphere});
  fuzz::test_laws(sites, constraints, sphere);
  fuzz::test_inside(sites, constraints, sphere);
  std::vector<LonLat> positions;
  for (const Point& p : sites) positions.push_back(lonlats(std::span(&p, 1))[0]);
  std::erase_if(positions, [](const LonLat& p) { return !(p.lat_deg <= 90); });
  fuzz::test_split(unit_vectors(positions), constraints);
  fuzz::test_features(unit_vectors(positions));
  return 0;
}
