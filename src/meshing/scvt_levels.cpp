// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/angles.h"
#include "exact/vector.h"
#include "meshing/seeded_random.h"
#include "rondel/delaunay.h"
#include "rondel/diagram.h"

namespace rondel::mesh {
namespace {

using exact::to_point;
using exact::to_vector;

}  // namespace

std::vector<std::size_t> counts_of_levels(std::size_t count, std::size_t fewest) {
  std::vector<std::size_t> counts = {count};
  while ((counts.back() + 6) / 4 >= fewest) counts.push_back((counts.back() + 6) / 4);
  std::ranges::reverse(counts);
  return counts;
}

std::vector<Point> icosahedron() {
  std::vector<Point> sites = {{0, 0, 1}};
  const double z = std::sqrt(0.2);
  for (int k = 0; k < 10; ++k) {
    const auto turn = exact::sine_cosine_of_degrees(36.0 * k);
    sites.push_back({2 * z * turn.cosine, 2 * z * turn.sine, k % 2 == 0 ? z : -z});
  }
  sites.push_back({0, 0, -1});
  for (Point& p : sites) p = to_point(normalized(to_vector(p)));
  return sites;
}

// Goes through a spiral of many points from pole to pole, in which successive points are far apart
// in longitude. Each point has its share of the density; where the sum of the shares passes an
// integer there is a site, moved by a random part of the distance between points.
std::vector<Point> sampled_sites(std::size_t count, const SizeFunction* size, std::uint64_t seed) {
  SeededRandom random(seed);
  const double golden = 180 * (3 - std::sqrt(5.0));
  const std::size_t most = 1 << 20;
  const std::size_t num_points = size == nullptr ? count : std::max(most, 8 * count);
  const auto point = [&](std::size_t k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(num_points);
    const double r = std::sqrt(1 - z * z);
    const auto turn = exact::sine_cosine_of_degrees(
        golden * static_cast<double>(k) - 360 * std::floor(golden * static_cast<double>(k) / 360));
    return Point{r * turn.cosine, r * turn.sine, z};
  };
  std::vector<double> shares(num_points, 1.0);
  for (std::size_t k = 0; k < num_points && size != nullptr; ++k) {
    shares[k] = std::sqrt(size->density(point(k)));
  }
  double total = 0;
  for (const double share : shares) total += share;
  const double spread = 0.5 * std::sqrt(4 * std::numbers::pi / static_cast<double>(num_points));
  std::vector<Point> sites;
  double sum = 0;
  for (std::size_t k = 0; k < num_points && sites.size() < count; ++k) {
    sum += shares[k] / total * static_cast<double>(count);
    if (sum < static_cast<double>(sites.size()) + 0.5 && num_points - k > count - sites.size()) {
      continue;
    }
    const exact::Vector3<double> shift = {random() - 0.5, random() - 0.5, random() - 0.5};
    sites.push_back(to_point(normalized(to_vector(point(k)) + 2 * spread * shift)));
  }
  return sites;
}

std::vector<Point> in_spatial_order(std::vector<Point> sites, unsigned threads) {
  const Triangulation triangulation =
      delaunay(Sites::view(sites), {}, Execution{.threads = threads});
  std::vector<bool> is_taken(sites.size());
  std::vector<Point> ordered;
  ordered.reserve(sites.size());
  for (const Triple& face : triangulation.faces()) {
    for (const Index v : face) {
      if (is_taken[v]) continue;
      is_taken[v] = true;
      ordered.push_back(sites[v]);
    }
  }
  return ordered;
}

std::vector<Point> refined_sites(const std::vector<Point>& sites, std::size_t count,
                                 const SizeFunction* size, unsigned threads) {
  const Triangulation triangulation =
      delaunay(Sites::view(sites), {}, Execution{.threads = threads});
  std::vector<Point> result = sites;
  result.reserve(count);
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  for (Index f = 0; f < faces.size(); ++f) {
    for (Index i = 0; i < 3; ++i) {
      if (neighbors[f][i] < f) continue;
      const Point& a = sites[faces[f][(i + 1) % 3]];
      const Point& b = sites[faces[f][(i + 2) % 3]];
      result.push_back(to_point(normalized(to_vector(a) + to_vector(b))));
    }
  }
  // The largest faces of the old sites get a site in their middle, so that the new sites stay
  // apart.
  struct Large {
    double size;
    Index face;
  };
  std::vector<Large> largest;
  for (Index f = 0; f < faces.size() && result.size() < count; ++f) {
    const auto a = to_vector(sites[faces[f][0]]);
    const auto b = to_vector(sites[faces[f][1]]) - a;
    const auto c = to_vector(sites[faces[f][2]]) - a;
    const auto middle = a + (b + c) / 3;
    const double density = size == nullptr ? 1 : size->density(to_point(middle));
    largest.push_back({norm(cross(b, c)) * std::sqrt(density), f});
  }
  std::ranges::stable_sort(largest, std::greater(), &Large::size);
  for (std::size_t k = 0; k < largest.size() && result.size() < count; ++k) {
    const Triple& face = faces[largest[k].face];
    result.push_back(to_point(normalized(to_vector(sites[face[0]]) + to_vector(sites[face[1]]) +
                                         to_vector(sites[face[2]]))));
  }
  return in_spatial_order(std::move(result), threads);
}

}  // namespace rondel::mesh
