// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>

#include "dual/face_batch.h"
#include "dual/parts.h"
#include "dual/ring_walk.h"

namespace rondel::dual {
namespace {

// A little more than cos(120 degrees), for the rounding of the circumcenters.
constexpr double longest_arc_cosine = -0.499;

// The middle of the arc from n_f to n_g across the edge e from a to b, f on its left. The
// arc turns about e from n_f towards the outward side m = e x n_f: n_g = cos(t) n_f + sin(t) m for
// a unit vector e, so e x (n_f - n_g) = 2 sin(t/2) (sin(t/2) m + cos(t/2) n_f), which is the middle
// and has length above sqrt(3) here.
Point middle_of_arc(const Vec& e, const Point& nf, const Point& ng) {
  return to_point(normalized(cross(e, to_vector(nf) - to_vector(ng))));
}

// Whether the circumcenter is within 60 degrees of the corners, with room for rounding. Two such
// faces with a common corner are less than 120 degrees apart. (A weighted corner may lie anywhere.)
bool is_near_corners(const SplitSites& sites, Index face, const Point& center) {
  return sites.is_projected() &&
         dot(to_vector(center), to_vector(sites[sites.corners(face)[0]].hi)) > near_cosine;
}

}  // namespace

std::vector<ArcPoint> add_arc_points(const Triangulation& triangulation, const SplitSites& sites,
                                     std::vector<Point>& points) {
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  std::vector<ArcPoint> result;
  for (Index f = 0; f < faces.size(); ++f) {
    if (is_near_corners(sites, f, points[f])) continue;
    for (Index i = 0; i < 3; ++i) {
      const Index g = neighbors[f][i];
      if (dot(to_vector(points[f]), to_vector(points[g])) > longest_arc_cosine) continue;
      // The other face would come to the same edge.
      if (g < f && !is_near_corners(sites, g, points[g])) continue;
      const Triple& corners = sites.corners(f);
      const Vec e = sites.direction(corners[next_corner(i)], corners[previous_corner(i)]);
      const auto position = static_cast<Index>(points.size());
      result.push_back({3 * f + i, position});
      result.push_back({3 * g + mirror_corner(faces[f], i, faces[g]), position});
      points.push_back(middle_of_arc(e, points[f], points[g]));
    }
  }
  std::ranges::sort(result, {}, &ArcPoint::halfedge);
  return result;
}

}  // namespace rondel::dual
