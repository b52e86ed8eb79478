// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// nanoflann_bench N QUERIES: the nearest of uniform sites to other uniform points by a k-d tree in
// space, the queries in the order given. On the sphere the nearest in space is the
// nearest in angle.

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <nanoflann.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "inputs.h"

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// The interface that nanoflann asks for.
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
  if (argc < 3) {
    std::fprintf(stderr, "usage: nanoflann_bench N QUERIES\n");
    return 2;
  }
  const std::size_t n = std::strtoull(argv[1], nullptr, 10);
  const std::size_t q = std::strtoull(argv[2], nullptr, 10);
  const auto points = rondel::bench::make_input("uniform", n + q);
  const Cloud cloud{std::span(points).first(n)};
  const auto queries = std::span(points).last(q);

  const double start = now();
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const double built = now();
  std::vector<std::uint32_t> nearest(q);
  for (std::size_t i = 0; i < q; ++i) {
    const std::array<double, 3> at = {queries[i].x, queries[i].y, queries[i].z};
    double squared_distance = 0;
    tree.knnSearch(at.data(), 1, &nearest[i], &squared_distance);
  }
  const double done = now();
  const auto sum = std::accumulate(nearest.begin(), nearest.end(), std::uint64_t{0});
  std::printf(
      "{\"sites\": %zu, \"queries\": %zu, \"build\": %.6f, \"seconds\": %.6f, \"sum\": %llu}\n", n,
      q, built - start, done - built, static_cast<unsigned long long>(sum));
}
