// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Conservative weights: pieces against clipping in long double, and what they promise.

#include "rondel/remap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/regions.h"
#include "support/thrown.h"
#include "unit/overlay/support.h"

namespace rondel::test {
namespace {

CellSet voronoi_of(std::string_view kind, std::size_t n, std::uint64_t seed) {
  return CellSet::voronoi(triangulation_of(kind, n, seed));
}

// The cell of the sphere's octant with the corners x, y, z, as three others would cut it.
CellRings octants() {
  CellRings rings;
  rings.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 3}, {3, 4}, {4, 0}}) {
    for (const Index c : {static_cast<Index>(a), static_cast<Index>(b), Index{2}}) {
      rings.corners.push_back(c);
    }
    rings.rings.push_back(rings.corners.size());
    for (const Index c : {static_cast<Index>(b), static_cast<Index>(a), Index{5}}) {
      rings.corners.push_back(c);
    }
    rings.rings.push_back(rings.corners.size());
  }
  for (std::size_t i = 1; i < rings.rings.size(); ++i) rings.cells.push_back(i);
  return rings;
}

TEST(overlay_remap, pieces_are_those_of_clipping) {
  const auto first = triangulation_of("uniform", 150, 1);
  const auto second = triangulation_of("uniform", 200, 2);
  const Remap remap = rondel::remap(CellSet::voronoi(first), CellSet::voronoi(second));
  const Cells sources = cells(first);
  const Cells targets = cells(second);
  for (std::size_t i = 0; i < 150; ++i) {
    for (std::size_t j = 0; j < 200; ++j) {
      const auto expected = static_cast<double>(area_of_piece(sources, i, targets, j));
      EXPECT_NEAR(piece_of(remap, i, j), expected, 1e-15) << i << ' ' << j;
    }
  }
}

TEST(overlay_remap, of_octants_is_known) {
  const CellSet source = CellSet::polygons(octants());
  ASSERT_TRUE(source.covers_sphere());
  for (const double area : source.areas()) EXPECT_NEAR(area, std::numbers::pi / 2, 4 * ulp);
  const CellSet target = CellSet::voronoi(delaunay(octants().points));
  const Remap remap = rondel::remap(source, target);
  ASSERT_EQ(remap.weights.num_rows(), 6U);
  // The cells of the axes are cut into four parts each.
  for (std::size_t j = 0; j < 6; ++j) {
    ASSERT_EQ(remap.weights.offsets[j + 1] - remap.weights.offsets[j], 4U);
  }
  for (const double weight : remap.weights.values) EXPECT_NEAR(weight, 0.25, 4 * ulp);
}

TEST(overlay_remap, sums_of_rows_and_columns) {
  const CellSet source = voronoi_of("uniform", 3000, 3);
  const CellSet target = voronoi_of("clustered", 2000, 4);
  const Remap remap = rondel::remap(source, target);
  std::vector<double> columns(source.num_cells());
  std::vector<double> areas(target.num_cells());
  for (std::size_t j = 0; j < target.num_cells(); ++j) {
    if (!(target.areas()[j] > 0)) continue;  // a duplicate
    double sum = 0;
    for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k)
      areas[j] += remap.areas[k];
    for (auto k = remap.weights.offsets[j]; k < remap.weights.offsets[j + 1]; ++k) {
      sum += remap.weights.values[k];
      columns[remap.weights.columns[k]] += remap.weights.values[k] * areas[j];
    }
    EXPECT_NEAR(sum, 1, 8 * ulp);
    EXPECT_NEAR(remap.target_fractions[j], 1, 16 * ulp / std::sqrt(target.areas()[j]));
  }
  for (std::size_t i = 0; i < source.num_cells(); ++i) {
    EXPECT_NEAR(columns[i] / source.areas()[i], 1, 16 * ulp / std::sqrt(source.areas()[i]));
    EXPECT_NEAR(columns[i] / remap.source_areas[i], 1, 8 * ulp);
    EXPECT_NEAR(remap.source_fractions[i], 1, 16 * ulp / std::sqrt(source.areas()[i]));
  }
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 4 * std::numbers::pi, 1e-13);
}

// A sum of thousands of pieces is off by its last rounding alone.
TEST(overlay_remap, areas_of_cells_of_many_pieces) {
  const CellSet source = CellSet::voronoi(delaunay(octants().points));
  const Remap remap = rondel::remap(source, voronoi_of("uniform", 20'000, 5));
  std::vector<long double> sums(source.num_cells());
  std::vector<std::size_t> counts(source.num_cells());
  for (std::size_t k = 0; k < remap.areas.size(); ++k) {
    sums[remap.pieces.values[k]] += remap.areas[k];
    ++counts[remap.pieces.values[k]];
  }
  for (std::size_t i = 0; i < source.num_cells(); ++i) {
    EXPECT_GT(counts[i], 3000U);
    EXPECT_NEAR(remap.source_areas[i], static_cast<double>(sums[i]), ulp * remap.source_areas[i]);
  }
}

// Areas of cells of 1e-8 radians are right to 1e-8 of them, and yet their weights sum up to 1.
TEST(overlay_remap, sums_of_rows_of_tiny_cells) {
  const auto patch = [](double width, std::uint64_t seed) {
    Random random(seed);
    std::vector<Point> sites = {{-1, 0, 0}, {0, -1, 0.5}, {0, 1, 0.5}, {0, 0, -1}};
    for (std::size_t i = 0; i < 300; ++i) {
      sites.push_back({1, width * (random.unit() - 0.5), width * (random.unit() - 0.5)});
    }
    return CellSet::voronoi(delaunay(sites));
  };
  for (const double width : {1e-2, 1e-5, 1e-7, 1e-9, 1e-11}) {
    const CellSet source = patch(width, 3);
    const CellSet target = patch(width, 4);
    const Remap remap = rondel::remap(source, target);
    for (std::size_t j = 0; j < target.num_cells(); ++j) {
      double sum = 0;
      for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k)
        sum += remap.weights.values[k];
      EXPECT_NEAR(sum, 1, 8 * ulp) << width << ' ' << j;
    }
  }
}

// A cell of which something is missing keeps its area.
TEST(overlay_remap, what_is_missing_is_no_rounding) {
  const CellSet source = voronoi_of("uniform", 300, 17);
  CellRings half = source.rings();
  half.cells.resize(half.num_cells() / 2 + 1);
  half.rings.resize(half.cells.back() + 1);
  half.corners.resize(half.rings.back());
  const CellSet target = voronoi_of("uniform", 200, 18);
  const Remap remap = rondel::remap(CellSet::polygons(half), target);
  std::size_t num_partial = 0;
  for (std::size_t j = 0; j < target.num_cells(); ++j) {
    if (remap.target_fractions[j] == 1) continue;
    EXPECT_EQ(remap.target_areas[j], target.areas()[j]);
    num_partial += remap.target_fractions[j] > 0 ? 1 : 0;
  }
  EXPECT_GT(num_partial, 20U);
}

TEST(overlay_remap, keeps_integrals_of_any_field) {
  const CellSet source = voronoi_of("uniform", 2000, 5);
  const CellSet target = voronoi_of("uniform", 500, 6);
  std::mt19937_64 random(1);
  std::vector<double> field(source.num_cells());
  for (double& f : field) f = std::uniform_real_distribution(-1.0, 1.0)(random);
  for (const unsigned order : {1U, 2U}) {
    const Remap remap = rondel::remap(source, target, {.order = order});
    std::vector<double> values(target.num_cells());
    apply(remap.weights, field, values);
    double integral = 0;
    double absolute = 0;
    for (std::size_t k = 0; k < remap.areas.size(); ++k) {
      integral += remap.areas[k] * field[remap.pieces.values[k]];
      absolute += remap.areas[k] * std::abs(field[remap.pieces.values[k]]);
    }
    double kept = 0;
    for (std::size_t j = 0; j < target.num_cells(); ++j) {
      double area = 0;
      for (auto k = remap.pieces.offsets[j]; k < remap.pieces.offsets[j + 1]; ++k)
        area += remap.areas[k];
      kept += area * values[j];
    }
    EXPECT_NEAR(kept, integral, 1e-15 * absolute) << order;
  }
}

// Means of a linear field over cells are its values at their centers of mass.
TEST(overlay_remap, linear_fields_with_their_gradients) {
  const auto first = triangulation_of("uniform", 700, 7);
  const CellSet source = CellSet::voronoi(first);
  const CellSet target = voronoi_of("uniform", 900, 8);
  const Remap remap = rondel::remap(source, target, {.order = 2});
  const Point g{0.3, -1.7, 0.9};
  const auto means_of = [&](const Triangulation& t) {
    std::vector<double> result;
    for (const LongVector& c : centers_of(t)) {
      result.push_back(static_cast<double>(3 + g.x * c.x + g.y * c.y + g.z * c.z));
    }
    return result;
  };
  const std::vector<double> means = means_of(first);
  const std::vector<double> expected = means_of(triangulation_of("uniform", 900, 8));
  std::vector<double> values(target.num_cells());
  apply_gradients(remap, means, std::vector<Point>(source.num_cells(), g), values);
  for (std::size_t j = 0; j < values.size(); ++j) EXPECT_NEAR(values[j], expected[j], 2e-14);
  // Gradients by least squares are those of the field to first order.
  std::vector<double> estimated(target.num_cells());
  apply(remap.weights, means, estimated);
  const Remap first_order = rondel::remap(source, target);
  std::vector<double> constant(target.num_cells());
  apply(first_order.weights, means, constant);
  double error = 0;
  double error_of_constant = 0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    error += std::abs(estimated[j] - expected[j]);
    error_of_constant += std::abs(constant[j] - expected[j]);
  }
  EXPECT_LT(error, error_of_constant / 10);
}

// Sites so close to each other that a cell between them is narrower than the rounding of its corners.
TEST(overlay_remap, moments_of_narrow_pieces_are_no_rounding) {
  std::size_t num_narrow = 0;
  for (std::uint64_t round = 0; round < 50; ++round) {
    Random random(round);
    const double apart = std::ldexp(1.0, -static_cast<int>(50 + random.below(50)));
    const std::vector<Point> sites = {
        {0, 1, 0}, {0, 1, apart}, {0, 1, -apart / 1024}, {1, 0, 0}, random.direction()};
    const CellSet target = CellSet::voronoi(delaunay(sites));
    const CellSet whole = CellSet::voronoi(delaunay(std::vector<Point>{{0, 1, 0}}));
    for (const CellSet& source : {whole, voronoi_of("uniform", 12, round)}) {
      const Remap made = remap(source, target, {.order = 2});
      for (std::size_t k = 0; k < made.areas.size(); ++k) {
        if (made.areas[k] > 1e-13) continue;
        ++num_narrow;
        EXPECT_LE(norm(made.moments[k]), 2 * made.areas[k]);
      }
    }
  }
  EXPECT_GT(num_narrow, 20U);
}

TEST(overlay_remap, onto_itself_is_the_identity) {
  for (const char* kind : {"uniform", "s_n", "globe_grid", "platonic_solid"}) {
    const CellSet cells = voronoi_of(kind, 500, 9);
    for (const unsigned order : {1U, 2U}) {
      const Remap remap = rondel::remap(cells, cells, {.order = order});
      for (std::size_t j = 0; j < cells.num_cells(); ++j) {
        if (!(cells.areas()[j] > 0)) continue;
        for (auto k = remap.weights.offsets[j]; k < remap.weights.offsets[j + 1]; ++k) {
          EXPECT_EQ(remap.weights.values[k], remap.weights.columns[k] == j ? 1 : 0) << kind;
        }
      }
    }
  }
}

TEST(overlay_remap, threads_and_order_of_sites_change_nothing) {
  const SiteSet set = generator("uniform").make(4000, 10);
  const CellSet target = voronoi_of("uniform", 3000, 11);
  const Remap one =
      rondel::remap(CellSet::voronoi(delaunay(set.sites)), target, {.order = 2}, {.threads = 1});
  const Remap many =
      rondel::remap(CellSet::voronoi(delaunay(set.sites)), target, {.order = 2}, {.threads = 4});
  EXPECT_EQ(one.weights, many.weights);
  std::vector<Index> order(set.sites.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::shuffle(order, std::mt19937_64(2));
  std::vector<Point> shuffled;
  for (const Index i : order) shuffled.push_back(set.sites[i]);
  const Remap other = rondel::remap(CellSet::voronoi(delaunay(shuffled)), target);
  const Remap same = rondel::remap(CellSet::voronoi(delaunay(set.sites)), target);
  for (std::size_t j = 0; j < target.num_cells(); ++j) {
    for (auto k = other.pieces.offsets[j]; k < other.pieces.offsets[j + 1]; ++k) {
      EXPECT_EQ(other.areas[k], piece_of(same, order[other.pieces.values[k]], j));
    }
  }
}

TEST(overlay_remap, parts_of_the_sphere) {
  const auto all = triangulation_of("uniform", 800, 12);
  CellRings half;  // the triangles of the northern half
  half.points = {all.sites().points().begin(), all.sites().points().end()};
  for (const Triple& face : all.faces()) {
    if (std::ranges::any_of(face, [&](Index v) { return half.points[v].z < 0; })) continue;
    half.corners.insert(half.corners.end(), face.begin(), face.end());
    half.rings.push_back(half.corners.size());
    half.cells.push_back(half.rings.size() - 1);
  }
  const CellSet part = CellSet::polygons(half);
  EXPECT_FALSE(part.covers_sphere());
  const CellSet whole = voronoi_of("uniform", 300, 13);
  const Remap to_whole = rondel::remap(part, whole);
  const double area = std::accumulate(part.areas().begin(), part.areas().end(), 0.0);
  EXPECT_NEAR(std::accumulate(to_whole.areas.begin(), to_whole.areas.end(), 0.0), area, 1e-13);
  const Remap covered = rondel::remap(part, whole, {.norm = RemapNorm::fracarea});
  bool is_any_empty = false;
  bool is_any_partial = false;
  for (std::size_t j = 0; j < whole.num_cells(); ++j) {
    double sum = 0;
    double sum_of_covered = 0;
    for (auto k = to_whole.weights.offsets[j]; k < to_whole.weights.offsets[j + 1]; ++k) {
      sum += to_whole.weights.values[k];
      sum_of_covered += covered.weights.values[k];
    }
    if (to_whole.target_fractions[j] == 0) {
      is_any_empty = true;
      EXPECT_EQ(sum, 0);
    } else {
      EXPECT_NEAR(sum, to_whole.target_fractions[j], 1e-11);
      EXPECT_NEAR(sum_of_covered, 1, 8 * ulp);
      is_any_partial |= sum < 0.999;
    }
  }
  EXPECT_TRUE(is_any_empty && is_any_partial);
  EXPECT_EQ(rondel::remap(part, part).weights.values, std::vector<double>(part.num_cells(), 1));
}

// A ring around a hole, and an island in it.
TEST(overlay_remap, cells_with_holes) {
  const auto circle = [](double lat, std::size_t n, bool is_clockwise, CellRings& rings) {
    for (std::size_t k = 0; k < n; ++k) {
      const double lon =
          360.0 * static_cast<double>(is_clockwise ? n - k : k) / static_cast<double>(n);
      rings.corners.push_back(static_cast<Index>(rings.points.size()));
      rings.points.push_back(unit_vector_deg(lon + 7, lat));
    }
    rings.rings.push_back(rings.corners.size());
  };
  CellRings rings;
  circle(20, 40, false, rings);
  circle(50, 30, true, rings);
  circle(70, 20, false, rings);
  rings.cells.push_back(3);
  const CellSet ring = CellSet::polygons(rings);
  CellRings parts = rings;
  parts.cells = {0, 1, 2, 3};  // without its holes, the hole as a cell turned around, the island
  std::reverse(parts.corners.begin() + 40, parts.corners.begin() + 70);
  const CellSet part = CellSet::polygons(parts);
  const auto alone = [&](Index i) {
    std::vector<Index> groups(3, no_index);
    groups[i] = 0;
    return CellSet::polygons(dissolve(parts, groups, 1));
  };
  EXPECT_NEAR(ring.areas()[0], part.areas()[0] - part.areas()[1] + part.areas()[2], 1e-14);
  for (const std::size_t n : {3U, 50U, 5000U}) {
    const CellSet cells = voronoi_of("uniform", n, 14);
    const Remap of_ring = rondel::remap(ring, cells);
    EXPECT_THROW((void)rondel::remap(part, cells), InvalidInput);
    const Remap outer = rondel::remap(alone(0), cells);
    const Remap hole = rondel::remap(alone(1), cells);
    const Remap island = rondel::remap(alone(2), cells);
    EXPECT_NEAR(std::accumulate(of_ring.areas.begin(), of_ring.areas.end(), 0.0), ring.areas()[0],
                1e-13);
    for (std::size_t j = 0; j < cells.num_cells(); ++j) {
      EXPECT_NEAR(piece_of(of_ring, 0, j),
                  piece_of(outer, 0, j) - piece_of(hole, 0, j) + piece_of(island, 0, j), 1e-14)
          << n;
    }
  }
}

TEST(overlay_remap, few_cells) {
  for (const std::size_t n : {1U, 2U, 3U, 4U}) {
    for (const std::size_t m : {1U, 2U, 3U, 4U, 40U}) {
      const CellSet source = voronoi_of("uniform", n, 15);
      const CellSet target = voronoi_of("uniform", m, 16);
      for (const unsigned order : {1U, 2U}) {
        const Remap remap = rondel::remap(source, target, {.order = order});
        EXPECT_NEAR(std::accumulate(remap.areas.begin(), remap.areas.end(), 0.0),
                    4 * std::numbers::pi, 1e-14)
            << n << ' ' << m;
      }
    }
  }
}

TEST(overlay_remap, masked_cells_take_no_part) {
  const CellSet source = voronoi_of("uniform", 300, 17);
  const CellSet target = voronoi_of("uniform", 200, 18);
  const Remap all = rondel::remap(source, target);
  RemapOptions options;
  for (std::size_t i = 0; i < 300; ++i) options.source_mask.push_back(i % 3 == 0 ? 0 : 1);
  for (std::size_t j = 0; j < 200; ++j) options.target_mask.push_back(j % 5 == 0 ? 0 : 7);
  for (const unsigned order : {1U, 2U}) {
    options.order = order;
    const Remap masked = rondel::remap(source, target, options);
    for (const Index column : masked.weights.columns) EXPECT_NE(column % 3, 0U);
    for (std::size_t j = 0; j < 200; ++j) {
      if (j % 5 == 0) {
        EXPECT_EQ(masked.weights.offsets[j], masked.weights.offsets[j + 1]);
      }
      double covered = 0;
      for (std::size_t i = 0; i < 300; ++i) {
        const bool is_in = i % 3 != 0 && j % 5 != 0;
        EXPECT_EQ(piece_of(masked, i, j), is_in ? piece_of(all, i, j) : 0);
        covered += piece_of(masked, i, j);
      }
      EXPECT_NEAR(masked.target_fractions[j], covered / target.areas()[j], 1e-14);
    }
  }
  options.source_mask.pop_back();
  EXPECT_THROW((void)rondel::remap(source, target, options), InvalidInput);
}

TEST(overlay_remap, names_what_is_wrong) {
  const auto message_of = [](const CellRings& cells) -> std::string {
    return thrown_message<InvalidInput>([&] { const CellSet cell_set = CellSet::polygons(cells); });
  };
  CellRings rings = octants();
  rings.points[3].x = -2;
  EXPECT_EQ(message_of(rings), "cell 2 has a corner that is no unit vector");
  rings = octants();
  rings.corners[4] = 6;
  EXPECT_EQ(message_of(rings), "cell 1 has a corner 6");
  rings = octants();
  rings.rings[1] = 2;
  EXPECT_EQ(message_of(rings), "cell 0 has a ring of 2 corners");
  rings = octants();
  rings.cells.back() = 9;
  EXPECT_EQ(message_of(rings), "the offsets of cells and rings do not fit");
  const CellSet source = CellSet::polygons(octants());
  EXPECT_THROW((void)remap(source, source, {.order = 3}), InvalidInput);
  std::vector<double> out(8);
  EXPECT_THROW(apply_gradients(remap(source, source), out, std::vector<Point>(8), out),
               InvalidInput);
}

double largest_weight(const Remap& remap) {
  double largest = 0;
  for (const double weight : remap.weights.values) largest = std::max(largest, std::abs(weight));
  return largest;
}

// A strip knows no gradient across itself: with one of the bend of a parallel, weights were up to 400 in place of 1.
TEST(overlay_remap, gradients_of_strips_go_along_them) {
  for (const double step : {10.0, 1.0, 0.25, 1e-3}) {
    for (const double south : {-89.0, -60.0, 0.0, 30.0, 80.0}) {
      LonLatGrid coarse{{}, {south, south + step}};
      LonLatGrid fine{{}, {south, south + step / 2, south + step}};
      for (int k = 0; k <= 12; ++k) coarse.lon_deg.push_back(k * step);
      for (int k = 0; k <= 36; ++k) fine.lon_deg.push_back(k * step / 3);
      for (const GridSides sides : {GridSides::parallels, GridSides::great_circles}) {
        if (south + step > 85 && sides == GridSides::great_circles) continue;
        const Remap there = remap(CellSet::lonlat_grid(coarse, sides),
                                  CellSet::lonlat_grid(fine, sides), {.order = 2});
        EXPECT_LT(largest_weight(there), 1.5) << step << ' ' << south;
        // A strip around a pole is no line, and wide cells with other sides stick out of it.
        if (south < -85 || step > 1) continue;
        std::vector<double> values(12);
        std::vector<double> found(72);
        for (std::size_t k = 0; k < 12; ++k) values[k] = static_cast<double>(k);
        apply(there.weights, values, found);
        for (std::size_t k = 3; k < 33; ++k) {
          EXPECT_NEAR(found[k], (static_cast<double>(k) - 1) / 3, 0.05) << step << ' ' << south;
        }
      }
    }
  }
}

TEST(overlay_remap, masks_make_no_gradients_large) {
  const CellSet fine = CellSet::voronoi(triangulation_of("uniform", 900, 3));
  Random random(12);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellSet cells = CellSet::voronoi(triangulation_of("uniform", 200, seed));
    std::vector<std::int32_t> mask(cells.num_cells());
    for (std::int32_t& part : mask) part = random.below(10) < 2 + seed % 6 ? 0 : 1;
    EXPECT_LT(largest_weight(remap(cells, fine, {.order = 2, .source_mask = mask})), 8) << seed;
  }
}

}  // namespace
}  // namespace rondel::test
