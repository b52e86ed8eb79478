// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/outlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "api/triangulation_impl.h"
#include "exact/vector.h"
#include "proximity/face_circles.h"
#include "rondel/error.h"
#include "rondel/query.h"
#include "system/job.h"

namespace rondel {
namespace {

// Throws InvalidInput for weighted sites, whose faces have no empty circles.
void require_no_weights(const Triangulation& triangulation) {
  if (triangulation.model() == Model::weighted) {
    throw InvalidInput("the circles of weighted faces are not empty");
  }
}

// Traces the border of a set of faces and returns it as polygons, one for each set of faces that
// are connected by edges. A ring has the set to its left.
class Tracer {
 public:
  Tracer(const Triangulation& triangulation, std::span<const std::uint8_t> is_in)
      : faces_(triangulation.faces()),
        neighbors_(triangulation.neighbors()),
        is_in_(is_in),
        is_done_(3 * faces_.size()),
        place_(triangulation.num_sites(), no_index) {}

  // Returns the outline of the set: its polygons are in the order of their lowest faces.
  Outline trace() {
    std::vector<std::uint8_t> is_found(faces_.size());
    std::vector<Index> part;
    for (Index first = 0; first < faces_.size(); ++first) {
      if (is_in_[first] == 0 || is_found[first] != 0) continue;
      part.assign(1, first);
      is_found[first] = 1;
      for (std::size_t next = 0; next < part.size(); ++next) {
        for (const Index g : neighbors_[part[next]]) {
          if (is_in_[g] == 0 || is_found[g] != 0) continue;
          is_found[g] = 1;
          part.push_back(g);
        }
      }
      std::ranges::sort(part);
      append_polygon(part);
    }
    return std::move(out_);
  }

 private:
  // A side of a face: the edge opposite to one of its corners (0, 1, 2).
  struct FaceSide {
    Index face;
    unsigned corner;
  };

  // Returns the face on the other side of a side.
  [[nodiscard]] Index across(const FaceSide& side) const {
    return neighbors_[side.face][side.corner];
  }
  [[nodiscard]] bool is_border(const FaceSide& side) const { return is_in_[across(side)] == 0; }
  [[nodiscard]] Index begin_of(const FaceSide& side) const {
    return faces_[side.face][(side.corner + 1) % 3];
  }

  // Returns the next side of the border: it turns around the end of this side through the faces of
  // the set.
  [[nodiscard]] FaceSide next(FaceSide side) const {
    const Index end = faces_[side.face][(side.corner + 2) % 3];
    side.corner = (side.corner + 1) % 3;
    while (!is_border(side)) {
      const Index g = across(side);
      const auto place =
          static_cast<unsigned>(std::ranges::find(faces_[g], end) - faces_[g].begin());
      side = {g, (place + 2) % 3};
    }
    return side;
  }

  // Appends the rings around `part`, which has the faces of one polygon in ascending order.
  void append_polygon(std::span<const Index> part) {
    for (const Index f : part) {
      for (unsigned i = 0; i < 3; ++i) {
        const FaceSide side{f, i};
        if (is_border(side) && is_done_[3 * std::size_t{f} + i] == 0) append_rings(side);
      }
    }
    out_.end_group();
  }

  // Appends the border that begins with a side. The closed line is split into simple rings wherever
  // it returns to a site.
  void append_rings(const FaceSide& first) {
    std::vector<Index> line;
    FaceSide side = first;
    do {
      is_done_[3 * std::size_t{side.face} + side.corner] = 1;
      const Index site = begin_of(side);
      if (place_[site] != no_index) {
        const auto begin = static_cast<std::ptrdiff_t>(place_[site]);
        append_ring(std::span(line).subspan(place_[site]));
        line.erase(line.begin() + begin, line.end());
      }
      place_[site] = static_cast<Index>(line.size());
      line.push_back(site);
      side = next(side);
    } while (side.face != first.face || side.corner != first.corner);
    append_ring(line);
  }

  // Appends a ring, and removes its sites from the current line.
  void append_ring(std::span<const Index> ring) {
    for (const Index site : ring) place_[site] = no_index;
    out_.rows.append(ring);
  }

  std::span<const Triple> faces_;
  std::span<const Triple> neighbors_;
  std::span<const std::uint8_t> is_in_;
  std::vector<std::uint8_t> is_done_;  // a flag for each side, 3 * face + corner
  std::vector<Index> place_;           // the place of each site in the current line, or no_index
  Outline out_;
};

}  // namespace

Outline hull_polygon(const Triangulation& triangulation) {
  std::vector<std::uint8_t> is_in(triangulation.num_faces(), 1);
  for (const Index f : triangulation.ghost_faces()) is_in[f] = 0;
  return Tracer(triangulation, is_in).trace();
}

Outline alpha_shape(const Triangulation& triangulation, double radius, const Execution& execution) {
  const system::Call call(execution);
  require_no_weights(triangulation);
  api::require_unchanged_faces(triangulation, execution);
  if (!(radius >= 0)) throw InvalidInput("the radius is negative or not a number");
  const proximity::FaceCircles circles = proximity::face_circles(triangulation, execution);
  std::vector<std::uint8_t> is_in(triangulation.num_faces());
  for (Index f = 0; f < is_in.size(); ++f) {
    const bool is_small = circles.radii[circles.first_face[f]] <= radius;
    is_in[f] = static_cast<std::uint8_t>(is_small && !triangulation.is_ghost(f));
  }
  return Tracer(triangulation, is_in).trace();
}

namespace {

// Returns the two circles of 90 degrees around the poles of the great circle that has all sites, or
// none if an open half of the great circle has no site. At most k circles are returned.
std::vector<EmptyCircle> polar_circles(const Triangulation& triangulation, std::size_t k) {
  const std::span<const Index> ring = triangulation.ring();
  if (ring.size() < 3) return {};
  const Point& origin = triangulation.sphere().center;
  std::vector<Point> places;
  for (const Index site : ring) {
    const Point place = triangulation.sites()[site] - origin;
    places.push_back(place / std::sqrt(dot(place, place)));
  }
  std::vector<Point> steps;
  Point normal;  // a normal of the great circle: the longest cross product of two neighbors
  for (std::size_t i = 0; i < places.size(); ++i) {
    steps.push_back(cross(places[i], places[i + 1 < places.size() ? i + 1 : 0]));
    if (dot(steps.back(), steps.back()) > dot(normal, normal)) normal = steps.back();
  }
  const bool has_half = std::ranges::any_of(
      steps, [&](const Point& step) { return dot(step, normal) < -0x1p-50 * dot(normal, normal); });
  if (has_half) return {};
  normal = normal / std::sqrt(dot(normal, normal));
  const std::array<Index, 3> on = {ring[0], ring[1], ring[2]};
  std::vector<EmptyCircle> found = {{normal, std::numbers::pi / 2, on},
                                    {-1.0 * normal, std::numbers::pi / 2, on}};
  found.resize(std::min(k, found.size()));
  return found;
}

}  // namespace

std::vector<EmptyCircle> largest_empty_circles(const Triangulation& triangulation, std::size_t k,
                                               CircleCenters centers, const Execution& execution) {
  const system::Call call(execution);
  require_no_weights(triangulation);
  api::require_unchanged_faces(triangulation, execution);
  std::vector<EmptyCircle> found;
  if (triangulation.dimension() < 2) {
    return centers == CircleCenters::anywhere ? polar_circles(triangulation, k) : found;
  }
  if (k == 0) return found;
  const proximity::FaceCircles circles = proximity::face_circles(triangulation, execution);
  const bool is_limited = centers == CircleCenters::inside && triangulation.num_ghost_faces() > 0;
  std::vector<Index> order;
  for (Index f = 0; f < triangulation.num_faces(); ++f) {
    if (circles.first_face[f] != f || (is_limited && triangulation.is_ghost(f))) continue;
    order.push_back(f);
  }
  std::ranges::sort(order, [&](Index f, Index g) {
    return circles.radii[f] != circles.radii[g] ? circles.radii[f] > circles.radii[g] : f < g;
  });
  const Locator locator(is_limited ? triangulation : Triangulation());
  const Point& origin = triangulation.sphere().center;
  for (const Index f : order) {
    const Point& u = circles.centers[f];
    if (is_limited &&
        locator.locate({origin.x + u.x, origin.y + u.y, origin.z + u.z}).where == Where::outside) {
      continue;
    }
    found.push_back({u, circles.radii[f], triangulation.faces()[f]});
    if (found.size() == k) break;
  }
  return found;
}

}  // namespace rondel
