// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "unit/dual/support.h"

namespace rondel::test {
namespace {

TEST(cells, keep_the_contract_for_every_generator) {
  for_each_case(14, 3, [](const DualCase& c) {
    const Triangulation& t = c.triangulation;
    const Cells diagram = cells(t);
    ASSERT_EQ(diagram.offsets.size(), c.sites.size() + 1);
    ASSERT_EQ(diagram.offsets.back(), diagram.rings.size());
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
  EXPECT_EQ(diagram.offsets, (std::vector<std::uint64_t>{0, 4, 8, 8}));
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
  EXPECT_EQ(cells(Triangulation{}, {}).offsets, std::vector<std::uint64_t>{0});
  const std::vector<Point> sites = {{1, 2, 3}, {2, 4, 6}};
  const Cells diagram = cells(triangulated(sites));
  EXPECT_EQ(diagram.offsets, (std::vector<std::uint64_t>{0, 0, 0}));
  EXPECT_TRUE(diagram.points.empty());
}

}  // namespace
}  // namespace rondel::test
