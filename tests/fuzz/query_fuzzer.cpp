// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Locator, of a Triangulation and of a DynamicTriangulation: all answers against brute force over
// all vertices and faces, ranges against single queries, wrong calls.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "fuzz/fuzz_input.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"
#include "rondel/dynamic.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "rondel/query.h"
#include "support/hull_oracle.h"
#include "support/query_oracle.h"

namespace rondel::fuzz {
namespace {

constexpr std::size_t max_queries = 5;

// Sites, their triangulation, and queries, which are finite and not the center.
struct Scene {
  std::vector<Point> sites;
  Options options;
  Triangulation triangulation;
  std::vector<Point> queries;
};

// The directions of which most is known: those of sites, between two and three of them, opposite.
Point next_query(ByteSource& source, const Scene& scene, Scales scales) {
  const Point& center = scene.options.sphere.center;
  const std::vector<Point>& sites = scene.sites;
  const std::size_t kind = source.below(6);
  if (sites.empty() || kind == 0) return next_site(source, sites, scales);
  const Point a = sites[source.below(sites.size())];
  const Point b = sites[source.below(sites.size())];
  const Point c = sites[source.below(sites.size())];
  const auto all = [&](auto&& f) {
    return Point{f(a.x, b.x, c.x, center.x), f(a.y, b.y, c.y, center.y),
                 f(a.z, b.z, c.z, center.z)};
  };
  switch (kind) {
    case 1:
      return a;
    case 2:
      return all([](double p, double q, double, double o) { return p - o + q; });
    case 3:
      return all([](double p, double q, double r, double o) { return p - o + (q - o + r); });
    case 4:
      return all([](double p, double, double, double o) { return o - (p - o); });
    default:
      return next_site(source, scene.queries, scales);
  }
}

void add_queries(ByteSource& source, Scene& scene, Scales scales) {
  for (std::size_t n = 1 + source.below(max_queries); n > 0; --n) {
    const Point p = next_query(source, scene, scales);
    const bool is_finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (is_finite && p != scene.options.sphere.center) scene.queries.push_back(p);
  }
}

// The faces that conflict with the query as the triangulation breaks ties. Of duplicates, the
// smallest stands for the place.
void test_conflicts(const Locator& locator, const Scene& scene, const Point& query) {
  const Triangulation& t = scene.triangulation;
  const std::vector<Index> region = locator.conflict_region(query);
  require(std::ranges::is_sorted(region), "a conflict region is in increasing order");
  const bool is_duplicate = std::ranges::any_of(
      scene.sites, [&](const Point& p) { return is_same_site(p, query, t.model(), t.sphere()); });
  if (t.dimension() < 2 || is_duplicate) {
    require(t.dimension() == 2 || region.empty(), "there are no faces below dimension 2");
    return;
  }
  const test::Places places = test::distinct_places(scene.sites, t.model(), t.sphere());
  std::vector<Point> representative(scene.sites.size());
  for (std::size_t i = 0; i < places.index.size(); ++i) {
    representative[places.index[i]] = places.representative[i];
  }
  std::vector<Index> expected;
  for (Index f = 0; f < t.num_faces(); ++f) {
    const auto& [a, b, c] = t.faces()[f];
    if (is_in_conflict(representative[a], representative[b], representative[c], query, t.model(),
                       t.sphere())) {
      expected.push_back(f);
    }
  }
  require(region == expected, "the conflict region is that of the predicate");
}

void test_order(const Locator& locator, const test::QueryOracle& oracle, std::size_t i,
                const Point& query) {
  const std::vector<Index> expected = oracle.by_distance(i);
  require(locator.k_nearest(query, expected.size() + 2) == expected, "vertices by distance");
  require(locator.nearest(query) == (expected.empty() ? no_index : expected[0]), "the nearest one");
  const std::size_t some = expected.size() / 2;
  require(std::ranges::equal(locator.k_nearest(query, some), std::span(expected).first(some)),
          "some by distance");
}

void test_distance(const Locator& locator, const test::QueryOracle& oracle, std::size_t i,
                   const Scene& scene, Index site) {
  const double distance = locator.distance(scene.queries[i], site);
  require(distance >= 0 && distance <= std::numbers::pi, "a distance is an angle");
  if (scene.options.model != Model::projected) return;
  const double error = std::abs(oracle.distance_minus(i, site, distance));
  require(error <= 8e-16 * distance + 1e-29, "a distance is that of the oracle");
}

// Exactly, the only angle that is.
void test_within_nothing(const Locator& locator, const test::QueryOracle& oracle, std::size_t i,
                         const Scene& scene) {
  std::vector<Index> expected;
  for (const Index v : oracle.by_distance(i)) {
    if (oracle.is_at_distance_0(i, v)) expected.push_back(v);
  }
  std::ranges::sort(expected);
  require(locator.within(scene.queries[i], 0) == expected, "those at distance 0 are exactly these");
}

void test_within(const Locator& locator, const Scene& scene, const Point& query, double angle) {
  const std::vector<Index> inside = locator.within(query, angle);
  std::vector<Index> nearest = locator.k_nearest(query, inside.size());
  std::ranges::sort(nearest);
  require(inside == nearest, "those within an angle are the nearest ones");
  if (angle >= std::numbers::pi) {
    require(inside.size() == scene.triangulation.num_vertices(), "all are within pi");
  }
  const std::vector<Index> all = locator.k_nearest(query, scene.sites.size());
  const double slack = 4e-15 * angle + 4e-15;
  for (std::size_t i = 0; i < all.size() && scene.options.model == Model::projected; ++i) {
    const double distance = locator.distance(query, all[i]);
    require(i < inside.size() ? distance <= angle + slack : distance >= angle - slack,
            "those within an angle are at most that far");
  }
}

void test_neighbors(const Locator& locator, const Scene& scene) {
  std::vector<std::array<Index, 2>> found;
  for (Index i = 0; i < scene.sites.size(); ++i) {
    const bool is_duplicate = std::ranges::any_of(scene.triangulation.duplicates(),
                                                  [&](const Duplicate& d) { return d.site == i; });
    for (const Index j : locator.neighbors(i)) {
      if (!is_duplicate && i < j) found.push_back({i, j});
    }
  }
  std::ranges::sort(found);
  require(found == edges(scene.triangulation), "neighbors are the ends of edges");
}

void test_ranges(const Locator& locator, const Scene& scene, double angle) {
  const std::vector<Point>& queries = scene.queries;
  const auto locations = locator.locate(queries);
  const auto nearest = locator.nearest(queries);
  const auto three = locator.k_nearest(queries, 3);
  const CompressedRows<Index> within = locator.within(queries, angle);
  require(within.size() == queries.size(), "a list for each query");
  for (std::size_t i = 0; i < queries.size(); ++i) {
    require(locations[i] == locator.locate(queries[i]), "one or many are located in one place");
    require(nearest[i] == locator.nearest(queries[i]), "one or many have the same nearest");
    std::vector<Index> expected = locator.k_nearest(queries[i], 3);
    expected.resize(3, no_index);
    require(std::ranges::equal(std::span(three).subspan(3 * i, 3), expected),
            "one or many have the same nearest ones");
    const auto list = within[i];
    require(std::ranges::equal(list, locator.within(queries[i], angle)),
            "one or many have the same within an angle");
  }
}

// The same sites with ids that are not their positions: every answer is renamed.
void test_dynamic(const Locator& locator, const Scene& scene, double angle) {
  DynamicTriangulation changing(scene.options);
  const std::vector<Point>& sites = scene.sites;
  for (std::size_t i = 0; i < sites.size(); i += 3) changing.insert(sites[i]);
  const std::vector<Index> ids = changing.insert(sites);
  require(std::ranges::is_sorted(ids), "ids increase while none is free");
  for (const Index id : changing.ids()) {
    if (std::ranges::find(ids, id) == ids.end()) changing.remove(id);
  }
  const Locator follows(changing);
  const auto renamed = [&](Index i) { return i == no_index ? no_index : ids[i]; };
  const auto all_renamed = [&](std::vector<Index> list) {
    std::ranges::transform(list, list.begin(), renamed);
    return list;
  };
  for (const Point& query : scene.queries) {
    const Location there = locator.locate(query);
    const Location here = follows.locate(query);
    require(here.where == there.where, "a site is in the same place");
    if (here.face != no_index && here.where == Where::face) {
      const Triple& expected = scene.triangulation.faces()[there.face];
      const Triple renamed_face = {renamed(expected[0]), renamed(expected[1]),
                                   renamed(expected[2])};
      require(test::lowest_first(changing.face(here.face)) == test::lowest_first(renamed_face),
              "the face is the same");
    }
    require(follows.nearest(query) == renamed(locator.nearest(query)), "the nearest is the same");
    require(follows.k_nearest(query, 4) == all_renamed(locator.k_nearest(query, 4)),
            "the nearest are the same");
    require(follows.within(query, angle) == all_renamed(locator.within(query, angle)),
            "those within an angle are the same");
    require(follows.conflict_region(query).size() == locator.conflict_region(query).size(),
            "conflict regions are of one size");
  }
}

void refuse_wrong_calls(const Locator& locator, const Scene& scene) {
  std::vector<Point> bad = scene.queries;
  bad.push_back(scene.options.sphere.center);
  bad.push_back({0, std::nan(""), 0});
  const std::size_t first = scene.queries.size();
  const auto size = static_cast<Index>(scene.sites.size());
  refuse(first, [&] { return locator.locate(bad); });
  refuse(first, [&] { return locator.nearest(bad); });
  refuse(first, [&] { return locator.k_nearest(bad, 2); });
  refuse(first, [&] { return locator.within(bad, 1.0); });
  refuse(size, [&] { return locator.neighbors(size); });
  refuse(InvalidInput::no_index, [&] { return locator.within(scene.queries[0], -1); });
  refuse(size, [&] { return locator.distance(scene.queries[0], size); });
}

void test(const Scene& scene, double angle, std::uint8_t what) {
  const Locator locator(scene.triangulation);
  const test::QueryOracle oracle(scene.triangulation, scene.sites, scene.queries);
  for (std::size_t i = 0; i < scene.queries.size(); ++i) {
    const Point& query = scene.queries[i];
    const Location place = locator.locate(query);
    require(place == oracle.locate(i), "a place is that of the oracle");
    require(place.face == no_index || !scene.triangulation.is_ghost(place.face),
            "a face that has the query is solid");
    test_order(locator, oracle, i, query);
    test_within(locator, scene, query, angle);
    test_conflicts(locator, scene, query);
  }
  if (!scene.sites.empty()) {
    test_distance(locator, oracle, 0, scene, static_cast<Index>(what % scene.sites.size()));
    test_within_nothing(locator, oracle, 0, scene);
  }
  switch (what % 8) {
    case 0:
      test_neighbors(locator, scene);
      break;
    case 1:
      refuse_wrong_calls(locator, scene);
      break;
    case 2:
    case 3:
      test_dynamic(locator, scene, angle);
      break;
    default:
      test_ranges(locator, scene, angle);
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  fuzz::Scene scene;
  const std::uint8_t what = source.byte();
  scene.options.model = source.byte() % 2 == 0 ? Model::weighted : Model::projected;
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = 4 + source.below(8);
  const double angle = source.byte() / 80.0;
  scene.options.sphere = fuzz::next_sphere(source, scales);
  while (!source.is_empty() && scene.sites.size() < limit) {
    scene.sites.push_back(fuzz::next_site(source, scene.sites, scales));
  }
  if (scene.options.model == Model::projected) {
    fuzz::remove_center(scene.sites, scene.options.sphere);
  }
  scene.triangulation = delaunay(scene.sites, scene.options);
  fuzz::add_queries(source, scene, scales);
  if (!scene.queries.empty()) fuzz::test(scene, angle, what);
  return 0;
}
