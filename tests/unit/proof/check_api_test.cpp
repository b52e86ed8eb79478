// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// check() against delaunay(), on sets too large for brute force.
#include <gtest/gtest.h>

#include <limits>

#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "support/generators.h"
#include "unit/proof/check_support.h"

namespace rondel::test {
namespace {

TEST(check_api, accepts_what_delaunay_builds) {
  for (const Generator& kind : generators()) {
    for (const Model model : {Model::projected, Model::weighted}) {
      if (kind.weighted_only && model == Model::projected) continue;
      for (const std::size_t n : {std::size_t{50}, scaled(700)}) {
        const SiteSet set = kind.make(n, 21);
        Options options;
        options.model = model;
        options.sphere = set.sphere;
        const Triangulation built = delaunay(set.sites, options);
        const CheckReport report = check(set.sites, built.faces(), options);
        EXPECT_TRUE(report.is_valid) << kind.name << ' ' << report.reason;
        EXPECT_EQ(report.num_duplicates, built.duplicates().size()) << kind.name;
        if (built.dimension() < 2) continue;
        EXPECT_EQ(report.num_vertices, built.num_vertices()) << kind.name;
        EXPECT_EQ(report.num_hidden, built.hidden().size()) << kind.name;
      }
    }
  }
}

TEST(check_api, refutes_one_flipped_edge_among_thousands) {
  Random random(4);
  const SiteSet set = generator("globe_grid").make(2000, 1);
  const Triangulation built = delaunay(set.sites);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<Triple> faces(built.faces().begin(), built.faces().end());
    const Triple& face = faces[random.below(faces.size())];
    flip(faces, face[0], face[1]);
    EXPECT_FALSE(check(set.sites, faces).is_valid);
  }
}

TEST(check_api, throws_on_invalid_sites) {
  std::vector<Point> sites = cube_sites();
  sites[5].y = std::numeric_limits<double>::quiet_NaN();
  try {
    check(sites, {});
    FAIL() << "accepted a coordinate that is not a number";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.index(), 5U);
  }
  sites[5] = {};
  EXPECT_THROW(check(sites, {}), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
