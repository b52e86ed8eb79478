// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The same questions to CGAL and to Rondel, for the page that shows this file and what it prints.

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel_with_sqrt.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_on_sphere_traits_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <vector>

#include "rondel/rondel.h"

using Points = std::vector<rondel::Point>;
using Triangles =
    std::set<std::array<unsigned, 3>>;  // each from its lowest corner, counterclockwise

void add(Triangles& triangles, std::array<unsigned, 3> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  triangles.insert(corners);
}

// With CGAL
template <class Kernel>
struct By {
  using Traits = CGAL::Projection_on_sphere_traits_3<Kernel>;
  using Base = CGAL::Triangulation_on_sphere_vertex_base_2<Traits>;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<unsigned, Traits, Base>;
  using Face = CGAL::Triangulation_on_sphere_face_base_2<Traits>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
  using Sphere = CGAL::Delaunay_triangulation_on_sphere_2<Traits, Structure>;
  using Point = typename Kernel::Point_3;
};
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel_with_sqrt;

template <class Kernel>
Triangles by_cgal(const Points& points) {
  using Point = typename By<Kernel>::Point;
  typename By<Kernel>::Sphere dt(typename By<Kernel>::Traits(Point(0, 0, 0), 1));
  for (unsigned i = 0; i < points.size(); ++i) {
    const auto vertex = dt.insert(Point(points[i].x, points[i].y, points[i].z));
    if (vertex != nullptr) vertex->info() = i;
  }
  Triangles triangles;
  for (auto face : dt.all_face_handles()) {
    add(triangles, {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

// With Rondel
Triangles by_rondel(const Points& points) {
  const rondel::Triangulation triangulation = rondel::delaunay(points);
  Triangles triangles;
  for (const auto& face : triangulation.faces()) add(triangles, face);
  return triangles;
}
// The end

// With 1,000 random sites within an angle of one direction, in radians.
Points random_sites(double angle) {
  std::mt19937_64 random(1);
  const auto next = [&] { return angle * (static_cast<double>(random() >> 11) / 0x1p52 - 1); };
  Points points;
  for (int i = 0; i < 1000; ++i) {
    const double x = 1 + next();
    const double y = 2 + next();
    const double z = 3 + next();
    const double length = std::sqrt(x * x + y * y + z * z);
    points.push_back({x / length, y / length, z / length});
  }
  return points;
}

// How many sites are left with the traits for points on the sphere.
std::size_t kept_by_cgal(const Points& points) {
  using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Inexact>;
  CGAL::Delaunay_triangulation_on_sphere_2<Traits> dt(Traits(Inexact::Point_3(0, 0, 0), 1));
  for (const auto& p : points) dt.insert(Inexact::Point_3(p.x, p.y, p.z));
  return dt.number_of_vertices();
}

// Whether exact constructions give the same triangles.
bool compare(const char* where, double angle) {
  const Points points = random_sites(angle);
  const Triangles ours = by_rondel(points);
  const auto print = [&](const char* who, const Triangles& triangles) {
    const char* note = triangles == ours ? ", the same" : ", others";
    std::printf("  %s: %zu triangles%s\n", who, triangles.size(), note);
  };
  std::printf("%s:\n  Rondel: %zu triangles\n", where, ours.size());
  print("CGAL, inexact constructions", by_cgal<Inexact>(points));
  const Triangles exact = by_cgal<Exact>(points);
  print("CGAL, exact constructions with roots", exact);
  std::printf("  CGAL, traits for points on the sphere: %zu of 1000 sites\n", kept_by_cgal(points));
  return exact == ours;
}

// Sites that come and go, and what both know of a triangulation.
void change() {
  using Point = Inexact::Point_3;
  const Points points = random_sites(0.1);
  By<Inexact>::Sphere theirs(By<Inexact>::Traits(Point(0, 0, 0), 1));
  std::vector<By<Inexact>::Sphere::Vertex_handle> vertices;
  for (const auto& p : points) vertices.push_back(theirs.insert(Point(p.x, p.y, p.z)));
  rondel::DynamicTriangulation ours(points);
  for (unsigned i = 0; i < 500; ++i) {
    theirs.remove(vertices[i]);
    ours.remove(i);
  }
  const rondel::Triangulation left = ours.snapshot().triangulation;
  std::size_t ghosts = 0;
  for (auto face : theirs.all_face_handles()) ghosts += face->is_ghost() ? 1 : 0;
  std::printf("after 500 removals, CGAL and Rondel:\n");
  std::printf("  dimension %d and %d, vertices %zu and %zu, ghost faces %zu and %zu\n",
              theirs.dimension(), left.dimension(),
              static_cast<std::size_t>(theirs.number_of_vertices()), left.num_vertices(), ghosts,
              left.num_ghost_faces());
}

int main() {
  bool are_same = compare("all around the sphere", 100);
  are_same = compare("within a few degrees", 0.1) && are_same;
  are_same = compare("within a millimetre on the Earth", 1e-10) && are_same;
  change();
  return are_same ? 0 : 1;
}
