// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// nanoflann_bench N QUERIES: measures the nearest of uniform sites to other uniform points by a k-d
// tree in space, with the queries in the given order. On the sphere the nearest site in space is
// the nearest in angle.

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <nanoflann.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "inputs.h"
#include "measure.h"

namespace {

// The interface that nanoflann requires.
struct Cloud {
  std::span<const rondel::Point> points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    const rondel::Point& p = points[i];
    return axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud, double>, Cloud,
                                        3, std::uint32_t>;

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = rondel::bench::take_seed(argc, argv);
  if (argc < 3) {
    std::fprintf(stderr, "usage: nanoflann_bench N QUERIES [--seed S]\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t q = std::strtoull(argv[2], nullptr, 10);
  const auto points = rondel::bench::make_input("uniform", n + q, seed);
  const Cloud cloud{std::span(points).first(n)};
  const auto queries = std::span(points).last(q);

  const rondel::bench::Stopwatch build_watch;
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const double build = build_watch.seconds();
  std::vector<std::uint32_t> nearest(q);
  const double seconds = rondel::bench::seconds_of([&] {
    for (std::size_t i = 0; i < q; ++i) {
      const std::array<double, 3> at = {queries[i].x, queries[i].y, queries[i].z};
      double squared_distance = 0;
      tree.knnSearch(at.data(), 1, &nearest[i], &squared_distance);
    }
  });
  const auto sum = std::accumulate(nearest.begin(), nearest.end(), std::uint64_t{0});
  rondel::bench::print_json({{"sites", static_cast<double>(n)},
                             {"queries", static_cast<double>(q)},
                             {"build", build},
                             {"seconds", seconds},
                             {"sum", static_cast<double>(sum)}});
}
