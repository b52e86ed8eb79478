// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// delaunay (both forms): the validator accepts the result, which depends on nothing but the
// set of sites; invalid input is refused with its first bad index.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

#include "fuzz/fuzz_input.h"
#include "rondel/check.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"

namespace rondel::fuzz {
namespace {

// The place of every site by coordinates: those of its lexicographically smallest duplicate.
std::vector<Point> places(const Triangulation& triangulation, const std::vector<Point>& sites) {
  const auto key = [](const Point& p) { return std::tie(p.x, p.y, p.z); };
  std::vector<Point> place = sites;
  for (const Duplicate& d : triangulation.duplicates()) {
    Point& least = place[d.representative];
    if (key(sites[d.site]) < key(least)) least = sites[d.site];
  }
  for (const Duplicate& d : triangulation.duplicates()) place[d.site] = place[d.representative];
  return place;
}

// Faces, ring and hidden sites, told by coordinates.
struct Shape {
  std::vector<Point> corners;
  std::vector<Point> ring;
  std::vector<Triple> neighbors;
  std::vector<Index> ghosts;
  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape(const Triangulation& triangulation, const std::vector<Point>& sites) {
  const std::vector<Point> place = places(triangulation, sites);
  Shape result;
  for (const Triple& face : triangulation.faces()) {
    for (const Index site : face) result.corners.push_back(place[site]);
  }
  for (const Index site : triangulation.ring()) result.ring.push_back(place[site]);
  result.neighbors.assign(triangulation.neighbors().begin(), triangulation.neighbors().end());
  result.ghosts.assign(triangulation.ghost_faces().begin(), triangulation.ghost_faces().end());
  return result;
}

void test_valid(const std::vector<Point>& sites, const Options& options) {
  const Triangulation built = delaunay(sites, options);
  const CheckReport report = check(sites, built.faces(), options);
  require(report.is_valid, "the validator accepts what delaunay builds: " + report.reason);
  const Builder builder = built.report().builder;
  require((builder == Builder::ring) == (built.dimension() < 2),
          std::string("not built by ") + name_of(builder));
  require(report.num_duplicates == built.duplicates().size(), "as many duplicates");
  if (built.dimension() == 2) {
    require(report.num_vertices == built.num_vertices(), "as many vertices");
    require(report.num_hidden == built.hidden().size(), "as many hidden sites");
  }
}

void test_order(std::vector<Point> sites, const Options& options) {
  const Shape before = shape(delaunay(sites, options), sites);
  if (sites.size() % 2 == 0) {
    std::ranges::reverse(sites);
  } else {
    std::ranges::sort(sites, {}, [](const Point& p) { return std::tuple(p.z, p.x, p.y); });
  }
  require(shape(delaunay(Sites::view(sites), options), sites) == before,
          "input order changes nothing");
}

// A build that somebody wants to end either ends or is done, and the next one is not concerned.
void test_interrupted(const std::vector<Point>& sites, const Options& options) {
  const std::atomic<bool> stop = true;
  Triangulation built;
  bool is_done = true;
  try {
    built = delaunay(sites, options, {.stop = &stop});
  } catch (const Interrupted& interrupted) {
    is_done = false;
    require(std::string(interrupted.what()) == "interrupted", "it says so");
  }
  const Triangulation again = delaunay(sites, options);
  require(!is_done || shape(built, sites) == shape(again, sites), "what is done is right");
}

std::size_t first_bad(const std::vector<Point>& sites, const Options& options) {
  const auto bad = std::ranges::find_if(sites, [&](const Point& p) {
    return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) ||
           (options.model == Model::projected && p == options.sphere.center);
  });
  return static_cast<std::size_t>(bad - sites.begin());
}

// Any bytes as coordinates.
void test_validation(ByteSource source, const Options& options) {
  std::vector<Point> sites;
  std::vector<double> flat;
  while (!source.is_empty() && sites.size() < 8) {
    const double x = source.any_double();
    const double y = source.any_double();
    const double z = source.any_double();
    sites.push_back({x, y, z});
    flat.insert(flat.end(), {x, y, z});
  }
  const std::size_t bad = first_bad(sites, options);
  try {
    const Triangulation built = delaunay(std::span<const double>(flat), options);
    require(bad == sites.size(), "invalid sites are refused");
    require(built.num_sites() == sites.size(), "a site is three numbers");
  } catch (const InvalidInput& error) {
    require(error.index() == bad, "the first bad index is named");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  Options options;
  const std::uint8_t what = source.byte();
  options.model = what % 2 == 0 ? Model::weighted : Model::projected;
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 40);
  options.sphere = fuzz::next_sphere(source, scales);
  if (scales == fuzz::Scales::all) fuzz::test_validation(source, options);
  const std::vector<Point> sites = fuzz::all_sites(source, limit, scales, options);
  if (what % 16 < 2) {
    fuzz::test_interrupted(sites, options);
  } else if (what / 2 % 2 == 0) {
    fuzz::test_valid(sites, options);
  } else {
    fuzz::test_order(sites, options);
  }
  return 0;
}
