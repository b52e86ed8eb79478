// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "rondel/predicates.h"
#include "unit/dual/support.h"

namespace rondel::test {
namespace {

TEST(cells, keep_the_contract_for_every_generator) {
  for_each_case(14, 3, [](const DualCase& c) {
    const Triangulation& t = c.triangulation;
    const Cells diagram = cells(t);
    ASSERT_EQ(diagram.rings.size(), c.sites.size());
    ASSERT_EQ(diagram.rings.offsets.back(), diagram.rings.values.size());
    std::set<Index> empty;
    for (const Duplicate& d : t.duplicates()) empty.insert(d.site);
    for (const Hidden& h : t.hidden()) empty.insert(h.site);
    for (std::size_t i = 0; i < c.sites.size(); ++i) {
      const auto ring = ring_of(diagram, i);
      const bool is_empty = empty.contains(static_cast<Index>(i)) || t.dimension() == 0;
      ASSERT_EQ(ring.empty(), is_empty) << c.name << " site " << i;
      if (ring.empty()) continue;
      EXPECT_GE(ring.size(), 3U);
      EXPECT_EQ(ring[0], *std::ranges::min_element(ring)) << c.name;
      EXPECT_EQ(std::set<Index>(ring.begin(), ring.end()).size(), ring.size()) << c.name;
      for (std::size_t j = 0; j < ring.size(); ++j) {
        const Point& p = diagram.points[ring[j]];
        const Point& q = diagram.points[ring[(j + 1) % ring.size()]];
        EXPECT_GT(dot_product(p, q), -0.5) << c.name << " site " << i;
        EXPECT_NEAR(dot_product(p, p), 1, 1e-15);
      }
    }
  });
}

TEST(cells, list_the_faces_of_each_site) {
  for_each_case(20, 1, [](const DualCase& c) {
    const Triangulation& t = c.triangulation;
    if (t.dimension() < 2) return;
    const Cells diagram = cells(t);
    std::vector<std::set<Index>> expected(c.sites.size());
    for (Index f = 0; f < t.num_faces(); ++f) {
      for (const Index v : t.faces()[f]) expected[v].insert(f);
    }
    for (std::size_t i = 0; i < c.sites.size(); ++i) {
      std::set<Index> faces;
      for (const Index p : ring_of(diagram, i)) {
        if (p < t.num_faces()) faces.insert(p);
      }
      EXPECT_EQ(faces, expected[i]) << c.name << " site " << i;
    }
  });
}

// Each arc separates two cells: it occurs once in each direction.
TEST(cells, share_their_arcs_with_their_neighbors) {
  for_each_case(20, 2, [](const DualCase& c) {
    const Cells diagram = cells(c.triangulation);
    std::map<std::pair<Index, Index>, int> arcs;
    for (std::size_t i = 0; i < c.sites.size(); ++i) {
      const auto ring = ring_of(diagram, i);
      for (std::size_t j = 0; j < ring.size(); ++j) {
        ++arcs[{ring[j], ring[(j + 1) % ring.size()]}];
      }
    }
    for (const auto& [arc, count] : arcs) {
      EXPECT_EQ(count, 1) << c.name;
      EXPECT_TRUE(arcs.contains({arc.second, arc.first})) << c.name;
    }
  });
}

TEST(cells, hold_their_sites_counterclockwise) {
  const auto sites = generator("uniform").make(500, 1).sites;
  const Cells diagram = cells(triangulated(sites));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const auto ring = ring_of(diagram, i);
    for (std::size_t j = 0; j < ring.size(); ++j) {
      const Point pole =
          cross_product(diagram.points[ring[j]], diagram.points[ring[(j + 1) % ring.size()]]);
      EXPECT_GT(dot_product(pole, sites[i]), 0);
    }
  }
}

TEST(cells, have_arc_points_on_the_bisector_between_antipodal_circumcenters) {
  const std::vector<Point> sites = {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}};
  const Triangulation triangulation = triangulated(sites);
  ASSERT_EQ(triangulation.num_faces(), 2U);
  const Cells diagram = cells(triangulation);
  ASSERT_EQ(diagram.points.size(), 5U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto ring = ring_of(diagram, i);
    ASSERT_EQ(ring.size(), 4U);
    for (const Index p : {ring[1], ring[3]}) {
      EXPECT_GE(p, 2U);
      const Point& site = normalized(sites[i]);
      int equally_near = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        const Point& other = normalized(sites[j]);
        const double difference =
            dot_product(diagram.points[p], site) - dot_product(diagram.points[p], other);
        EXPECT_GT(difference, -4 * ulp);
        if (j != i && std::abs(difference) < 4 * ulp) ++equally_near;
      }
      EXPECT_EQ(equally_near, 1);
    }
  }
}

TEST(cells, are_hemispheres_for_two_sites) {
  const std::vector<Point> sites = {{0, 0, 1}, {0, 0, -3}, {0, 0, 5}};
  const Cells diagram = cells(triangulated(sites));
  EXPECT_EQ(diagram.rings.offsets, (std::vector<std::uint64_t>{0, 4, 8, 8}));
  for (const Point& p : diagram.points) EXPECT_EQ(p.z, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto ring = ring_of(diagram, i);
    const Point pole = cross_product(diagram.points[ring[0]], diagram.points[ring[1]]);
    EXPECT_EQ(pole.z, i == 0 ? 1 : -1);
  }
}

TEST(cells, are_lunes_on_a_great_circle) {
  const std::vector<Point> sites = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const Cells diagram = cells(triangulated(sites));
  ASSERT_EQ(diagram.points.size(), 6U);
  EXPECT_EQ(std::abs(diagram.points[0].z), 1);
  EXPECT_EQ(diagram.points[1].z, -diagram.points[0].z);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto ring = ring_of(diagram, i);
    ASSERT_EQ(ring.size(), 4U);
    for (const Index p : {ring[1], ring[3]}) {
      EXPECT_NEAR(dot_product(diagram.points[p], sites[i]), std::sqrt(0.5), ulp);
    }
  }
}

TEST(cells, of_one_site_and_of_none_are_empty) {
  EXPECT_EQ(cells(Triangulation{}, {}).rings.offsets, std::vector<std::uint64_t>{0});
  const std::vector<Point> sites = {{1, 2, 3}, {2, 4, 6}};
  const Cells diagram = cells(triangulated(sites));
  EXPECT_EQ(diagram.rings.offsets, (std::vector<std::uint64_t>{0, 0, 0}));
  EXPECT_TRUE(diagram.points.empty());
}

// Edges and merged facets.

using Polygon = std::vector<Index>;

std::vector<Polygon> polygons_of(std::span<const Point> sites, Model model = Model::projected) {
  const CompressedRows<Index> facets = merge_cocircular(triangulated(sites, model));
  std::vector<Polygon> result;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    result.emplace_back(facets[k].begin(), facets[k].end());
  }
  return result;
}

// The number of polygons by their number of corners.
std::map<std::size_t, int> sizes(const std::vector<Polygon>& polygons) {
  std::map<std::size_t, int> result;
  for (const Polygon& p : polygons) ++result[p.size()];
  return result;
}

// A dodecahedron with rational corners: (+-1, +-1, +-1) and cyclic (0, +-(1 - h^2), +-(1 + h)) with
// h = 1/2. Its 12 pentagons are exactly flat.
std::vector<Point> pyritohedron() {
  std::vector<Point> result = cube();
  for (const double s : {-0.75, 0.75}) {
    for (const double t : {-1.5, 1.5}) {
      result.push_back({0, s, t});
      result.push_back({s, t, 0});
      result.push_back({t, 0, s});
    }
  }
  return result;
}

TEST(merge_cocircular, finds_the_facets_of_the_platonic_solids) {
  EXPECT_EQ(sizes(polygons_of(octahedron())), (std::map<std::size_t, int>{{3, 8}}));
  EXPECT_EQ(sizes(polygons_of(cube())), (std::map<std::size_t, int>{{4, 6}}));
  EXPECT_EQ(sizes(polygons_of(cube(), Model::weighted)), (std::map<std::size_t, int>{{4, 6}}));
  EXPECT_EQ(sizes(polygons_of(pyritohedron(), Model::weighted)),
            (std::map<std::size_t, int>{{5, 12}}));
}

TEST(merge_cocircular, starts_with_the_lowest_corner_and_turns_counterclockwise) {
  const auto sites = cube();
  for (const Polygon& p : polygons_of(sites)) {
    EXPECT_EQ(p[0], *std::ranges::min_element(p));
    for (std::size_t j = 0; j < p.size(); ++j) {
      EXPECT_EQ(orientation(sites[p[j]], sites[p[(j + 1) % 4]], sites[p[(j + 2) % 4]]),
                Sign::positive);
    }
  }
}

TEST(merge_cocircular, gives_both_sides_of_a_flat_hull) {
  // On one small circle, exactly: integer points at squared distance 25 from (0, 0, 7).
  std::vector<Point> sites;
  for (const auto& [x, y] : {std::pair{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-5, 0}, {-3, -4}}) {
    sites.push_back({static_cast<double>(x), static_cast<double>(y), 7});
  }
  const auto polygons = polygons_of(sites);
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_EQ(polygons[0].size(), 6U);
  Polygon back = polygons[1];
  std::reverse(back.begin() + 1, back.end());
  EXPECT_EQ(polygons[0], back);
}

TEST(merge_cocircular, leaves_no_corner_inside_a_facet) {
  std::vector<Point> sites;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        sites.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
      }
    }
  }
  const auto polygons = polygons_of(sites, Model::weighted);
  EXPECT_EQ(polygons.size(), 6U);
  for (const Polygon& p : polygons) {
    const auto is_extreme = [&](Index i) {
      const Point& s = sites[i];
      return (std::abs(s.x) == 2) + (std::abs(s.y) == 2) + (std::abs(s.z) == 2) >= 2;
    };
    EXPECT_TRUE(std::ranges::all_of(p, is_extreme));
  }
}

TEST(merge_cocircular, gives_a_closed_surface_for_every_generator) {
  for_each_case(20, 2, [](const DualCase& c) {
    const CompressedRows<Index> facets = merge_cocircular(c.triangulation);
    if (c.triangulation.dimension() < 2) {
      EXPECT_EQ(facets.offsets, std::vector<std::uint64_t>{0});
      return;
    }
    std::set<std::array<Index, 2>> borders;
    std::set<Index> corners(facets.values.begin(), facets.values.end());
    for (std::size_t k = 0; k + 1 < facets.offsets.size(); ++k) {
      for (auto j = facets.offsets[k]; j < facets.offsets[k + 1]; ++j) {
        const auto next = j + 1 == facets.offsets[k + 1] ? facets.offsets[k] : j + 1;
        EXPECT_TRUE(borders.insert({facets.values[j], facets.values[next]}).second) << c.name;
      }
    }
    for (const auto& [a, b] : borders) EXPECT_TRUE(borders.contains({b, a})) << c.name;
    // Euler: V - E + F = 2.
    EXPECT_EQ(corners.size() + facets.offsets.size() - 1, borders.size() / 2 + 2) << c.name;
  });
}

TEST(edges, are_sorted_and_those_of_the_faces) {
  for_each_case(20, 1, [](const DualCase& c) {
    std::set<std::array<Index, 2>> expected;
    for (const Triple& f : c.triangulation.faces()) {
      for (std::size_t i = 0; i < 3; ++i) {
        expected.insert({std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])});
      }
    }
    if (c.triangulation.dimension() < 2) return;
    const auto result = edges(c.triangulation);
    EXPECT_TRUE(std::ranges::equal(result, expected)) << c.name;
    EXPECT_EQ(result.size(), 3 * c.triangulation.num_vertices() - 6);
  });
}

TEST(edges, below_dimension_2_go_around_the_ring) {
  const std::vector<Point> sites = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {2, 0, 0}};
  const std::vector<std::array<Index, 2>> square = {{0, 2}, {0, 3}, {1, 2}, {1, 3}};
  EXPECT_EQ(edges(triangulated(sites)), square);
  const std::vector<std::array<Index, 2>> one = {{0, 1}};
  EXPECT_EQ(edges(triangulated(std::span(sites).first(2))), one);
  EXPECT_TRUE(edges(triangulated(std::span(sites).first(1))).empty());
}

}  // namespace
}  // namespace rondel::test
