// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// convex_hull (both forms): the validator accepts the hull around its center, every site is
// accounted for, input order changes nothing, and the hull of the vertices has them all.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "fuzz/fuzz_input.h"
#include "rondel/check.h"
#include "rondel/error.h"
#include "rondel/hull.h"

namespace rondel::fuzz {
namespace {

auto key(const Point& p) { return std::tuple(p.x + 0.0, p.y + 0.0, p.z + 0.0); }

std::vector<Point> vertices(const Triangulation& hull, const std::vector<Point>& points) {
  std::vector<Point> result;
  for (const Triple& face : hull.faces()) {
    for (const Index corner : face) result.push_back(points[corner]);
  }
  for (const Index corner : hull.ring()) result.push_back(points[corner]);
  std::ranges::sort(result, {}, key);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Triangulation hull_of(const std::vector<Point>& points) {
  return convex_hull(points, {.threads = 1});
}

void test(const std::vector<Point>& points) {
  const Triangulation hull = hull_of(points);
  const Point& center = hull.sphere().center;
  if (hull.dimension() == 2) {
    const CheckReport report =
        check(points, hull.faces(), {.model = Model::weighted, .sphere = hull.sphere()});
    require(report.is_valid, "the validator accepts the hull: " + report.reason);
  }
  if (!points.empty() && (hull.dimension() < 2 || hull.num_ghost_faces() > 0)) {
    require(key(center) == key(std::ranges::min(points, {}, key)),
            "a center that is not inside is the smallest site");
  }
  const std::vector<Point> corners = vertices(hull, points);
  require(corners.size() == hull.num_vertices(), "every site is accounted for");
  require(hull_of(corners).num_vertices() == corners.size(), "vertices are extreme");

  const HullSize size = size_of_hull(hull);
  require(size.volume >= 0 && size.area >= 0, "volume and area are not negative");
}

void test_order(std::vector<Point> points) {
  const Triangulation hull = hull_of(points);
  const std::vector<Point> corners = vertices(hull, points);
  std::ranges::reverse(points);
  const Triangulation reversed = hull_of(points);
  require(vertices(reversed, points) == corners, "input order changes no vertex");
  require(reversed.sphere().center == hull.sphere().center,
          "input order does not change the center");
  require(std::ranges::equal(reversed.neighbors(), hull.neighbors()),
          "input order changes no face");
}

// Any bytes as coordinates.
void test_validation(ByteSource source) {
  std::vector<double> xyz;
  while (!source.is_empty() && xyz.size() < 24) xyz.push_back(source.any_double());
  xyz.resize(xyz.size() - xyz.size() % 3);
  const auto bad = std::ranges::find_if(xyz, [](double x) { return !std::isfinite(x); });
  try {
    const Triangulation hull = convex_hull(std::span<const double>(xyz));
    require(bad == xyz.end(), "invalid points are refused");
    require(3 * hull.num_sites() == xyz.size(), "a point is three numbers");
  } catch (const InvalidInput& error) {
    require(error.index() == static_cast<std::size_t>(bad - xyz.begin()) / 3,
            "the first bad index is named");
  }
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel;
  fuzz::ByteSource source(data, size);
  const std::uint8_t what = source.byte();
  const fuzz::Scales scales = fuzz::next_scales(source);
  const std::size_t limit = fuzz::next_limit(source, 40);
  if (scales == fuzz::Scales::all) fuzz::test_validation(source);
  const std::vector<Point> points = fuzz::all_sites(source, limit, scales);
  if (what % 2 == 0) {
    fuzz::test(points);
  } else {
    fuzz::test_order(points);
  }
  return 0;
}
