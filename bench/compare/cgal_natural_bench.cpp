// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// cgal_natural_bench N TARGETS [--seed S]: compares Sibson's weights of uniform targets among N
// uniform sites by Rondel and by CGAL, with one thread; prints medians of repetitions, each with
// its own targets. CGAL's function takes the points that it should use, and says whether they were
// enough: the nearest ones in a k-d tree, twice as many until they are. The largest difference of a
// weight is that from CGAL with exact numbers, at 300 sites.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/surface_neighbor_coordinates_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <span>
#include <vector>

#include "compare/cgal_points.h"
#include "measure.h"
#include "rondel/delaunay.h"
#include "rondel/interpolate.h"

namespace {

using rondel::Point;
using rondel::bench::seconds_of;

template <class Kernel>
using Coordinates = std::vector<std::pair<typename Kernel::Point_3, typename Kernel::FT>>;

template <class Kernel>
typename Kernel::Vector_3 normal(const typename Kernel::Point_3& p) {
  return p - typename Kernel::Point_3(0, 0, 0);
}

// Compares with exact weights that use all sites.
double largest_difference(std::uint64_t seed) {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  constexpr std::size_t n = 300;
  const auto points = rondel::bench::make_input("uniform", 2 * n, seed);
  const auto sites = std::span(points).first(n);
  const auto targets = std::span(points).last(n);
  const auto weights = rondel::Interpolator(rondel::delaunay(sites))
                           .weights(targets, {.method = rondel::Method::sibson});
  const auto of_cgal = rondel::bench::cgal_points<Kernel>({sites.begin(), sites.end()});
  double largest = 0;
  for (std::size_t t = 0; t < n; ++t) {
    std::map<std::array<double, 3>, double> expected;
    const Kernel::Point_3 p(targets[t].x, targets[t].y, targets[t].z);
    Coordinates<Kernel> coordinates;
    const auto result =
        CGAL::surface_neighbor_coordinates_3(of_cgal.begin(), of_cgal.end(), p, normal<Kernel>(p),
                                             std::back_inserter(coordinates), Kernel());
    for (const auto& [q, share] : coordinates) {
      expected[{CGAL::to_double(q.x()), CGAL::to_double(q.y()), CGAL::to_double(q.z())}] =
          CGAL::to_double(share / result.second);
    }
    for (auto k = weights.offsets[t]; k < weights.offsets[t + 1]; ++k) {
      const Point& site = sites[weights.columns[k]];
      double& weight = expected[{site.x, site.y, site.z}];
      weight -= weights.values[k];
    }
    for (const auto& [place, difference] : expected) {
      largest = std::max(largest, std::abs(difference));
    }
  }
  return largest;
}

// If the points do not surround the target, CGAL 5.5 reads beyond an array. With 32 random points
// that happens for one target in 60 million.
constexpr unsigned fewest = 32;
constexpr std::uint64_t repetitions = 7;

// Returns the sum of x over the targets, so that no work is optimized away.
double sum_by_cgal(const std::vector<Point>& sites, std::span<const Point> targets,
                   double& seconds) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;
  const auto points = rondel::bench::cgal_points<Kernel>(sites);
  Search::Tree tree(points.begin(), points.end());
  tree.build();
  double sum = 0;
  seconds = seconds_of([&] {
    std::vector<Kernel::Point_3> near;
    Coordinates<Kernel> coordinates;
    for (const Point& target : targets) {
      const Kernel::Point_3 p(target.x, target.y, target.z);
      bool is_certain = false;
      for (unsigned k = fewest; !is_certain && k <= points.size(); k *= 2) {
        const Search search(tree, p, k);
        near.clear();
        double square = 0;
        for (const auto& [q, distance] : search) {
          near.push_back(q);
          square = std::max(square, distance);
        }
        coordinates.clear();
        const auto result = CGAL::surface_neighbor_coordinates_certified_3(
            near.begin(), near.end(), p, normal<Kernel>(p), square, std::back_inserter(coordinates),
            Kernel());
        is_certain = result.fourth;
        if (!is_certain) continue;
        for (const auto& [q, share] : coordinates) sum += share / result.second * q.x();
      }
    }
  });
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: cgal_natural_bench N TARGETS [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t num_targets = std::strtoull(argv[2], nullptr, 10);
  const auto sites = rondel::bench::make_input("uniform", n, seed);
  const rondel::Interpolator interpolator(rondel::delaunay(sites));
  std::vector<double> field;
  for (const Point& p : sites) field.push_back(p.x);
  const rondel::InterpolationOptions options{.method = rondel::Method::sibson};
  const rondel::Execution one{.threads = 1};
  rondel::bench::keep_freed_memory();
  std::vector<double> all_seconds;
  std::vector<double> all_cgal_seconds;
  double difference = 0;
  for (std::uint64_t k = 0; k < repetitions; ++k) {
    const auto targets = rondel::bench::make_input("uniform", num_targets, seed + 1000 + k);
    std::vector<double> values;
    all_seconds.push_back(
        seconds_of([&] { values = interpolator.values(field, targets, options, one); }));
    double sum = 0;
    for (const double value : values) sum += value;
    double cgal_seconds = 0;
    difference = std::max(difference, std::abs(sum - sum_by_cgal(sites, targets, cgal_seconds)));
    all_cgal_seconds.push_back(cgal_seconds);
  }
  const double seconds = rondel::bench::median(all_seconds);
  const double cgal_seconds = rondel::bench::median(all_cgal_seconds);
  rondel::bench::print_json({{"sites", static_cast<double>(n)},
                             {"targets", static_cast<double>(num_targets)},
                             {"seconds", seconds},
                             {"cgal_seconds", cgal_seconds},
                             {"cgal_over_rondel", cgal_seconds / seconds},
                             {"difference_of_sums", difference},
                             {"largest_difference_of_weights", largest_difference(seed)}});
  return 0;
}
