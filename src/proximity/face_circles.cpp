// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "proximity/face_circles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exact/angles.h"
#include "exact/eft.h"
#include "exact/unit_vector.h"
#include "exact/vector.h"
#include "rondel/diagram.h"
#include "rondel/predicates.h"
#include "system/disjoint_sets.h"
#include "system/parallel.h"

namespace rondel::proximity {
namespace {

using exact::DoubleDouble;
using WideVector = exact::Vector3<DoubleDouble>;

constexpr std::size_t faces_per_piece = 1024;

// Returns a unit vector in twice a double's precision.
WideVector wide(const exact::SplitPoint& p) {
  return {{p.hi.x, p.lo.x}, {p.hi.y, p.lo.y}, {p.hi.z, p.lo.z}};
}

// Returns the radius of a face's circle in radians. With the normal n = (b-a) x (c-a), the circle
// has the sine |b-a||c-b||a-c| / 2|n| and the cosine n.a / |n|. Unit vectors that are off by e put
// n off by less than 8e times the longest side. Here e = 2^-100, so a height of 2^-45 leaves a
// relative error of 2^-52. For lower faces the radius is the angle between `middle` and a corner,
// which is off by some ulp.
double radius_of(const Triangulation& triangulation, const Triple& face, const Point& middle) {
  const Point& center = triangulation.sphere().center;
  const WideVector a = wide(exact::unit_vector(triangulation.sites()[face[0]], center));
  const WideVector b = wide(exact::unit_vector(triangulation.sites()[face[1]], center));
  const WideVector c = wide(exact::unit_vector(triangulation.sites()[face[2]], center));
  const auto length = [](const WideVector& v) { return std::sqrt(dot(v, v).hi); };
  const double ab = length(b - a);
  const double bc = length(c - b);
  const double ca = length(a - c);
  const WideVector normal = cross(b - a, c - a);
  if (length(normal) > 0x1p-45 * std::max({ab, bc, ca})) {
    return exact::argument(ab * bc * ca / 2, dot(normal, a).hi);
  }
  const exact::Vector3<double> u = {middle.x, middle.y, middle.z};
  const exact::Vector3<double> corner = {a.x.hi, a.y.hi, a.z.hi};
  const auto sine = cross(u, corner);
  return exact::argument(std::sqrt(dot(sine, sine)), dot(u, corner));
}

}  // namespace

FaceCircles face_circles(const Triangulation& triangulation, const Execution& execution) {
  const auto faces = triangulation.faces();
  const auto neighbors = triangulation.neighbors();
  const Sites& sites = triangulation.sites();
  // Bit i of is_same[f] is set if the face across edge i of f has the same circle as f. Only the
  // face with the lower index keeps the bit. Two faces with their sites on one circle have the same
  // one if they are seen from the same side; if the hull is flat, those of its other side have the
  // circle around the opposite center.
  std::vector<std::uint8_t> is_same(faces.size());
  FaceCircles circles;
  circles.centers = circumcenters(triangulation, execution);
  circles.radii.resize(faces.size());
  system::parallel_for(
      execution.threads, faces.size(), faces_per_piece, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
          const Triple& face = faces[f];
          circles.radii[f] = radius_of(triangulation, face, circles.centers[f]);
          const bool is_ghost = triangulation.is_ghost(static_cast<Index>(f));
          for (unsigned i = 0; i < 3; ++i) {
            const Index g = neighbors[f][i];
            if (g < f || triangulation.is_ghost(g) != is_ghost) continue;
            for (const Index p : faces[g]) {
              if (p == face[(i + 1) % 3] || p == face[(i + 2) % 3]) continue;
              const Sign side = side_of_circle(sites[face[0]], sites[face[1]], sites[face[2]],
                                               sites[p], Model::projected, triangulation.sphere());
              if (side == Sign::zero) is_same[f] = static_cast<std::uint8_t>(is_same[f] | 1U << i);
            }
          }
        }
      });
  system::DisjointSets same(faces.size());
  for (Index f = 0; f < faces.size(); ++f) {
    for (unsigned i = 0; i < 3; ++i) {
      if ((is_same[f] >> i & 1U) == 0) continue;
      same.join(f, neighbors[f][i]);
    }
  }
  circles.first_face.reserve(faces.size());
  for (Index f = 0; f < faces.size(); ++f) circles.first_face.push_back(same[f]);
  return circles;
}

}  // namespace rondel::proximity
