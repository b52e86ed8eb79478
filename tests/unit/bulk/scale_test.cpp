// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Powers of two change no ray and no plane: the same faces at all scales that doubles have, and
// when rays have lengths of their own.
#include <cmath>

#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

void scale(SiteSet& set, int exponent) {
  for (Point& p : set.sites) {
    p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  }
}

TEST(bulk_scale, all_sites_by_one_factor) {
  const int step = is_shortened() ? 200 : 50;
  for (int exponent = -1000; exponent <= 1000; exponent += step) {
    for (const Model model : {Model::projected, Model::weighted}) {
      SiteSet set = generator("uniform").make(1000, 3);
      scale(set, exponent);
      SCOPED_TRACE(text_of(model) + " " + std::to_string(exponent));
      BulkCase sites(set, model);
      EXPECT_TRUE(sites.run(300));
      EXPECT_TRUE(sites.run(1000));
    }
  }
}

TEST(bulk_scale, each_site_by_a_factor_of_its_own) {
  Random random(5);
  for (const int range : {1, 10, 100, 250, 300, 500, 510, 515, 520, 540, 700, 1000}) {
    for (const Model model : {Model::projected, Model::weighted}) {
      for (const bool few : {false, true}) {
        SiteSet set = generator("uniform").make(1000, 4);
        for (Point& p : set.sites) {
          const int exponent = random.between(-range, range);
          if (!few || random.below(20) == 0) p = std::ldexp(1.0, exponent) * p;
        }
        SCOPED_TRACE(text_of(model) + " " + std::to_string(range));
        BulkCase sites(set, model);
        EXPECT_TRUE(sites.run(100));
        EXPECT_TRUE(sites.run(1000));
      }
    }
  }
}

}  // namespace
}  // namespace rondel::test
