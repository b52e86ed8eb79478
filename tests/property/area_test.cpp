// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cells of a diagram cover the sphere once.
#include <cmath>
#include <numbers>

#include "property/property.h"
#include "rondel/diagram.h"

namespace rondel::test {
namespace {

TEST(areas, sum_to_the_whole_sphere) {
  expect_for_all(800, [] {
    const Input input = *inputs(200);
    const SiteSet set = input.make();
    const Triangulation t = triangulate(set, input.model);
    // Power cells cover the sphere if the center is inside the hull.
    RC_PRE(input.model == Model::projected || (t.dimension() == 2 && t.num_ghost_faces() == 0));
    RC_PRE(t.dimension() >= 0);
    const auto area = areas(t);
    RC_ASSERT(area.size() == set.sites.size());
    const double sum = std::accumulate(area.begin(), area.end(), 0.0);
    RC_ASSERT(std::abs(sum / (4 * std::numbers::pi) - 1) < 1e-12);
    RC_ASSERT(std::ranges::all_of(area, [](double a) { return a >= 0; }));
    for (const Duplicate& d : t.duplicates()) RC_ASSERT(area[d.site] == 0);
    for (const Hidden& h : t.hidden()) RC_ASSERT(area[h.site] == 0);
  });
}

}  // namespace
}  // namespace rondel::test
