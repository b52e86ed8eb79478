// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Pictures of meshes of triangles: what they have of the triangles, and that they stay small.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "rondel/triangle_mesh.h"
#include "support/random.h"
#include "unit/meshing/triangle_meshes.h"

namespace rondel::test {
namespace {

using mesh::TriangleMesh;

std::size_t number_of(std::string_view text, const std::string& picture) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = picture.find(text, at)) != std::string::npos; ++at) ++count;
  return count;
}

TriangleMesh mesh_of_sphere(std::size_t count) {
  const std::vector<LonLat> positions = positions_with_poles(count, 3);
  const auto all = [](const Point&, std::size_t) { return true; };
  return mesh_of(positions, all, [](const Point&) { return true; });
}

TEST(triangle_pictures, color_angles) {
  const std::vector<LonLat> positions = {{0, 0}, {0.1, 0}, {0, 0.1}, {0.1, -0.02}};
  const TriangleMesh mesh = mesh::triangle_mesh(unit_vectors(positions), positions,
                                                std::vector<Triple>{{0, 1, 2}, {0, 3, 1}});
  const std::string picture = mesh::quality_picture(mesh, 1);
  EXPECT_EQ(number_of("<circle", picture), 1U);
  EXPECT_EQ(number_of("<title>triangle 1: 11.31 degrees, at longitude 0.07, latitude -0.01</title>",
                      picture),
            1U);
  EXPECT_EQ(number_of("10 to 20: 1<", picture), 1U);
  EXPECT_EQ(number_of("40 to 50: 1<", picture), 1U);
  EXPECT_EQ(number_of("z\"/>", picture), 2U);  // the ends of paths of outlines
  EXPECT_EQ(mesh::quality_picture(mesh), mesh::quality_picture(mesh, 2));
}

using Outline = std::vector<std::array<double, 2>>;

// Returns the outlines, which begin with M and end with z.
std::vector<Outline> outlines_of(const std::string& picture) {
  std::vector<Outline> outlines;
  for (std::size_t at = 0; (at = picture.find('M', at)) != std::string::npos;) {
    const std::size_t end = picture.find_first_of("zML\"", ++at);
    if (end == std::string::npos || picture[end] != 'z') continue;
    std::istringstream numbers(picture.substr(at, end - at));
    Outline outline;
    for (std::array<double, 2> p{}; numbers >> p[0] >> p[1];) outline.push_back(p);
    outlines.push_back(outline);
  }
  return outlines;
}

// A place is inside of an outline with an odd number of sides to its right.
bool has(const Outline& outline, const std::array<double, 2>& p) {
  bool is_inside = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const auto& a = outline[k];
    const auto& b = outline[(k + 1) % outline.size()];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    const double x = a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]);
    if (p[0] < x) is_inside = !is_inside;
  }
  return is_inside;
}

// At the poles and across the antimeridian, too, each place of the map is in one triangle.
TEST(triangle_pictures, of_the_sphere_cover_the_map_once) {
  const std::string picture = mesh::quality_picture(mesh_of_sphere(300));
  const std::vector<Outline> outlines = outlines_of(picture);
  EXPECT_GT(outlines.size(), 596U);
  Random random(4);
  for (int k = 0; k < 2000; ++k) {
    const std::array<double, 2> p = {20 + 920 * random.unit(), 304 + 460 * random.unit()};
    const auto in = std::ranges::count_if(outlines, [&](const Outline& o) { return has(o, p); });
    EXPECT_EQ(in, 1) << p[0] << ' ' << p[1];
  }
}

TEST(triangle_pictures, of_many_triangles_are_small) {
  for (const std::size_t count : {std::size_t{3900}, std::size_t{4100}, std::size_t{100'000}}) {
    const TriangleMesh mesh = mesh_of_sphere(count);
    const std::string picture = mesh::quality_picture(mesh);
    EXPECT_LT(picture.size(), 1'000'000U) << count;
    EXPECT_GT(picture.size(), 50'000U) << count;
    EXPECT_EQ(number_of("<circle", picture), 20U);
    EXPECT_EQ(number_of("scale(3.00)", picture), mesh.triangles.size() > 8000 ? 1U : 0U);
  }
}

TEST(triangle_pictures, of_nothing_are_refused) {
  EXPECT_THROW(mesh::quality_picture(TriangleMesh{}), InvalidInput);
}

}  // namespace
}  // namespace rondel::test
