// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divide and conquer by itself, and whole builds, on thousands of small sets in which everything is
// degenerate: integers of one digit, so that most sites are cocircular, on one line or hidden.
#include "support/divided_faces.h"
#include "unit/bulk/support.h"

namespace rondel::test {
namespace {

// Small integers on one face of the cube.
SiteSet small_integers_on_a_face(Random& random) {
  SiteSet set;
  const int n = random.between(2, 40);
  const int depth = random.between(0, 3);
  const int width = random.between(1, 6);
  const int pole = random.coin() ? 8 : 7;
  for (int i = 0; i < n; ++i) {
    const int z = pole + random.between(0, depth);
    set.sites.push_back({static_cast<double>(random.between(-width, width)),
                         static_cast<double>(random.between(-width, width)),
                         static_cast<double>(random.coin() ? pole : z)});
  }
  return set;
}

struct Count {
  std::size_t solved = 0;
  std::size_t left = 0;
};

template <class T>
void compare(const SiteSet& set, Count& count) {
  const Divided result = divide_and_compare<T>(set, {6.9, 16});
  EXPECT_NE(result, Divided::different);
  if (result == Divided::same) ++count.solved;
  if (result == Divided::left_to_seam) ++count.left;
}

TEST(bulk_divide, finds_the_faces_that_the_center_sees) {
  Random random(21);
  Count projected;
  Count weighted;
  for (std::size_t i = 0; i < scaled(5000); ++i) {
    const SiteSet set = small_integers_on_a_face(random);
    SCOPED_TRACE(i);
    compare<models::ProjectedPoints>(set, projected);
    compare<models::WeightedPoints>(set, weighted);
    ASSERT_FALSE(HasFailure());
  }
  // Only weighted sites that are hidden on a line with others are left to the seam.
  EXPECT_EQ(projected.left, 0U);
  EXPECT_GT(weighted.solved, weighted.left / 4);
  RecordProperty("weighted_left", std::to_string(weighted.left));
}

// General positions, most sites hidden.
TEST(bulk_divide, sites_that_hide_each_other) {
  Random random(22);
  Count count;
  for (std::size_t i = 0; i < scaled(3000); ++i) {
    SiteSet set;
    const int n = random.between(4, 60);
    const double depth = random.unit();
    for (int k = 0; k < n; ++k) {
      const Point p = {random.signed_unit(), random.signed_unit(), 1};
      set.sites.push_back((7 + depth * random.unit()) * p);
    }
    SCOPED_TRACE(i);
    compare<models::WeightedPoints>(set, count);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_EQ(count.left, 0U);
}

TEST(bulk_divide, whole_builds_of_small_integers) {
  Random random(23);
  for (std::size_t i = 0; i < scaled(1500); ++i) {
    SiteSet set;
    const int size = random.between(2, 5);
    const int n = random.between(40, 200);
    const Point shift = {0, 0, static_cast<double>(random.coin() ? size + 2 : 0)};
    for (int k = 0; k < n; ++k) {
      const Point p = Point{static_cast<double>(random.between(-size, size)),
                            static_cast<double>(random.between(-size, size)),
                            static_cast<double>(random.between(-size, size))} +
                      shift;
      if (p != Point{}) set.sites.push_back(p);
    }
    for (const Model model : {Model::projected, Model::weighted}) {
      SCOPED_TRACE(text_of(model) + " " + std::to_string(i));
      BulkCase sites(set, model);
      const bool is_flat = sites.expected().dimension < 2;
      EXPECT_NE(sites.run(static_cast<std::size_t>(random.between(33, 100))), is_flat);
      EXPECT_NE(sites.run(1000), is_flat);
    }
    ASSERT_FALSE(HasFailure());
  }
}

}  // namespace
}  // namespace rondel::test
