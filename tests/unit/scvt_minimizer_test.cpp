// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_minimizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "meshing/scvt_levels.h"
#include "rondel/mesh_size.h"

namespace rondel::mesh {
namespace {

// Nearly all of the mass is in the north, where the sites go until one more step would leave the center of the sphere outside
// of them. A step to the centroids is tried before the minimizer gives up, so another one leads no further.
TEST(scvt_minimizer, is_stuck_only_where_a_step_to_the_centroids_is) {
  const SizeFunction size = SizeFunction::from_function(
      [](std::span<const Point> places, std::span<double> out) {
        for (std::size_t i = 0; i < places.size(); ++i) out[i] = 0.1 * std::exp(-1.5 * places[i].z);
      },
      64);
  const CentroidalEnergy energy(&size, 1);
  const auto go_on = [](int, const EnergyReport&) { return true; };
  for (std::uint64_t seed = 1; seed < 8; ++seed) {
    Minimizer minimizer(sampled_sites(20, nullptr, seed), energy, 1);
    const double before = minimizer.report().energy;
    EXPECT_EQ(minimizer.run({.iterations = 500}, go_on), MinimizerEnd::stuck);
    EXPECT_GT(minimizer.iterations(), 1);
    EXPECT_LT(minimizer.report().energy, before);
    EXPECT_EQ(minimizer.surface().faces().size(), 36U);
    Minimizer again(minimizer.sites(), energy, 1);
    EXPECT_EQ(again.run({.iterations = 1, .lloyd = true}, go_on), MinimizerEnd::stuck);
  }
}

}  // namespace
}  // namespace rondel::mesh
