// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Steps: divide segments that are too long; improve triangles that are too large, and, when there
// are none, those with a small angle, until all are good; list those that are asked for.
//
// A triangle is improved by a vertex near its circumcenter (an off-center), or, if a segment is in
// between, by a division of that (Chew).

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "exact/angles.h"
#include "exact/unit_vector.h"
#include "meshing/coarse_refine.h"
#include "meshing/refined_faces.h"
#include "rondel/error.h"
#include "rondel/mesh_refine.h"
#include "system/job.h"
#include "system/message_text.h"

namespace rondel::mesh {
namespace {

using predicates::Vector;
using topology::edge_of;
using topology::face_of;
using topology::halfedge;
using VertexKind = RefinedFaces::VertexKind;
using SmallLength = std::function<double(const Point&)>;  // at a place; none: nothing is small

// Circumradii are at most this part of the spacing, so that edges are at most twice as long.
constexpr double largest_radius = 0.75;
// Segments are divided until they are at most this part of the spacing.
constexpr double longest_segment = 4.0 / 3;
// The longest edge, in spacings, beside which a vertex is placed at the distance of the spacing.
constexpr double longest_front = 1.2;
// No vertex is added within this distance of another one.
constexpr double closest = 0x1p-46;

double square(double x) { return x * x; }

// Returns the chord from one unit vector to another one. Where that is short, the radial part of the
// difference is mostly rounding, which would turn planes of small triangles: what the sphere has
// there is taken for it.
Vector chord(const Vector& from, const Vector& to) {
  const Vector difference = to - from;
  const double length2 = dot(difference, difference);
  if (length2 > 0.01) return difference;
  const Vector tangent = difference - dot(difference, from) * from;
  const double sine2 = dot(tangent, tangent);
  return tangent - sine2 / (1 + std::sqrt(1 - sine2)) * from;
}
double square_of_distance(const Vector& a, const Vector& b) { return dot(a - b, a - b); }

// First in, first out.
class FaceQueue {
 public:
  [[nodiscard]] std::size_t size() const { return faces_.size() - first_; }
  [[nodiscard]] bool is_empty() const { return size() == 0; }
  void push(Index f) {
    if (f >= is_waiting_.size()) is_waiting_.resize(f + std::size_t{1} + f / 2);
    if (std::exchange(is_waiting_[f], 1) != 0) return;
    faces_.push_back(f);
  }
  Index pop() {
    const Index f = faces_[first_++];
    is_waiting_[f] = 0;
    if (first_ * 2 > faces_.size() && first_ > 4096) {
      faces_.erase(faces_.begin(), faces_.begin() + static_cast<std::ptrdiff_t>(first_));
      first_ = 0;
    }
    return f;
  }

 private:
  std::vector<Index> faces_;
  std::size_t first_ = 0;
  std::vector<std::uint8_t> is_waiting_;
};

class Refinement {
 public:
  Refinement(const ConstrainedTriangulation& given, std::span<const Index> regions,
             const RefineOptions& options, const SmallLength& small, const Execution& execution)
      : options_(options), small_(small), execution_(execution), faces_(given, regions) {
    const double sine = exact::sine_cosine_of_degrees(options.smallest_angle_deg).sine;
    const double half_sine = exact::sine_cosine_of_degrees(options.smallest_angle_deg / 2).sine;
    const double half_cosine = exact::sine_cosine_of_degrees(options.smallest_angle_deg / 2).cosine;
    largest_ratio_ = 1 / (4 * sine * sine);
    height_of_angle_ = half_cosine / (2 * half_sine);
    for (Index v = 0; v < faces_.num_vertices(); ++v) {
      wishes_.push_back(wish_at(faces_.point(v)));
    }
    mark_small_angles();
    for (Index f = 0; f < faces_.faces().size(); ++f) {
      for (unsigned i = 0; i < 3; ++i) {
        if (is_asked_for(f)) long_segments_.push_back(halfedge(f, i));
      }
    }
  }

  RefinedMesh run() {
    divide_long_segments();
    for (Index f = 0; f < faces_.faces().size(); ++f) await(f);
    std::size_t done = 0;
    while (!large_.is_empty() || !narrow_.is_empty()) {
      constexpr std::size_t pause = 4096;
      if (done++ % pause == 0) {
        system::obey_stop();
        system::announce(execution_, "refine", done, done + large_.size() + narrow_.size());
      }
      if (!large_.is_empty()) {
        improve_large(large_.pop());
      } else {
        improve_narrow(narrow_.pop());
      }
    }
    count_unwanted();
    return result();
  }

 private:
  // What is known of a triangle.
  struct FaceShape {
    std::array<double, 3> squares;  // of its edges
    unsigned shortest;              // edge
    Vector normal;                  // to its plane, twice as long as its area
    double square_of_radius;        // of its circumcircle
    double wish;                    // the smallest spacing at its corners
  };

  [[nodiscard]] bool is_asked_for(Index f) const {
    return faces_.is_alive(f) && faces_.face(f).region != no_index;
  }

  // Returns the wanted spacing as the length of a chord.
  [[nodiscard]] double wish_at(const Point& place) const {
    if (!options_.spacing) return std::numeric_limits<double>::infinity();
    return 2 * exact::sine_cosine_of_degrees(options_.spacing->spacing(place) *
                                             (exact::degrees_per_radian / 2))
                   .sine;
  }

  void await(Index f) {
    if (is_asked_for(f)) large_.push(f);
  }
  void await_changed() {
    for (const Index f : faces_.changed()) await(f);
  }

  // Marks the given vertices at which two segments meet at less than 60 degrees.
  void mark_small_angles() {
    has_small_angle_.assign(faces_.num_vertices(), false);
    std::vector<std::array<Index, 2>> ends;
    for (Index f = 0; f < faces_.faces().size(); ++f) {
      for (unsigned i = 0; i < 3; ++i) {
        if (faces_.face(f).segment[i] == no_index) continue;
        const Index h = halfedge(f, i);
        ends.push_back({faces_.from(h), faces_.to(h)});
        if (faces_.face(f).opposite[i] == no_index) ends.push_back({faces_.to(h), faces_.from(h)});
      }
    }
    std::ranges::sort(ends);
    constexpr std::size_t full_turn = 6;
    for (std::size_t begin = 0; begin < ends.size();) {
      const Index v = ends[begin][0];
      std::size_t end = begin;
      while (end < ends.size() && ends[end][0] == v) ++end;
      bool is_small = end - begin > full_turn;
      const Vector& center = faces_.direction(v);
      const auto tangent = [&](Index w) {
        const Vector away = faces_.direction(w) - center;
        return normalized(away - dot(away, center) * center);
      };
      for (std::size_t i = begin; i < end && !is_small; ++i) {
        for (std::size_t j = begin; j < i; ++j) {
          is_small = is_small || dot(tangent(ends[i][1]), tangent(ends[j][1])) > 0.5;
        }
      }
      has_small_angle_[v] = is_small;
      begin = end;
    }
  }

  [[nodiscard]] FaceShape shape_of(Index f) const {
    const auto& [a, b, c] = faces_.face(f).vertex;
    const Vector& p = faces_.direction(a);
    const Vector& q = faces_.direction(b);
    const Vector& r = faces_.direction(c);
    FaceShape shape{};
    shape.squares = {square_of_distance(q, r), square_of_distance(r, p), square_of_distance(p, q)};
    for (unsigned i = 1; i < 3; ++i) {
      if (shape.squares[i] < shape.squares[shape.shortest]) shape.shortest = i;
    }
    shape.normal = cross(chord(p, q), chord(p, r));
    shape.square_of_radius = shape.squares[0] * shape.squares[1] * shape.squares[2] /
                             (4 * dot(shape.normal, shape.normal));
    shape.wish = std::min({wishes_[a], wishes_[b], wishes_[c]});
    return shape;
  }

  [[nodiscard]] static bool is_large(const FaceShape& shape) {
    return shape.square_of_radius > square(largest_radius * shape.wish);
  }
  [[nodiscard]] bool is_narrow(const FaceShape& shape) const {
    return shape.square_of_radius > largest_ratio_ * shape.squares[shape.shortest];
  }

  void improve_large(Index f) {
    if (!is_asked_for(f)) return;
    const FaceShape shape = shape_of(f);
    if (is_large(shape)) {
      improve(f, shape);
    } else if (is_narrow(shape)) {
      narrow_.push(f);
    }
  }

  void improve_narrow(Index f) {
    if (!is_asked_for(f)) return;
    const FaceShape shape = shape_of(f);
    if (is_narrow(shape) && !is_between_shells(f, shape) && !is_small(f, shape)) improve(f, shape);
  }

  // True if all edges are shorter than the length from which on triangles are refined.
  [[nodiscard]] bool is_small(Index f, const FaceShape& shape) const {
    return small_ && std::ranges::max(shape.squares) <
                         square(small_(faces_.point(faces_.face(f).vertex[shape.shortest])));
  }

  // Returns the place of a vertex that improves a triangle: on the way from the middle of the
  // shortest edge to the circumcenter, along the great circle, not farther than is of use.
  [[nodiscard]] Vector better_vertex(Index f, const FaceShape& shape) const {
    const Triple& corners = faces_.face(f).vertex;
    const Vector& p = faces_.direction(corners[topology::next_corner[shape.shortest]]);
    const Vector& q = faces_.direction(corners[topology::previous_corner[shape.shortest]]);
    const double edge2 = shape.squares[shape.shortest];
    // The height is the chord from the middle of the arc.
    double height = std::sqrt(edge2) * height_of_angle_;
    if (edge2 < square(longest_front * shape.wish) && is_large(shape)) {
      height = std::min(height, std::sqrt(square(shape.wish) - edge2 / 4));
    }
    const double height2 = square(height);
    const double sine2 = height2 * (1 - height2 / 4);
    const double sine2_of_center = (shape.square_of_radius - edge2 / 4) / (1 - edge2 / 4);
    if (height2 >= 2 || sine2 >= sine2_of_center) return normalized(shape.normal);
    const Vector inwards = cross(p + q, q - p);
    return normalized((1 - height2 / 2) * normalized(p + q) +
                      std::sqrt(sine2) * normalized(inwards));
  }

  // Leaves the triangle as it is if doubles have no place for a vertex.
  void improve(Index f, const FaceShape& shape) {
    const Vector place = better_vertex(f, shape);
    const auto found = faces_.locate(f, place);
    if (!found) return;
    if (found->blocked != no_index) {
      if (divide(found->blocked)) await(f);
      return;
    }
    for (const Index v : faces_.face(found->face).vertex) {
      if (square_of_distance(faces_.direction(v), place) < square(closest)) return;
    }
    const auto added = faces_.insert(found->face, place);
    if (!added) return;
    ++report_.num_inserted;
    finish(*added);
  }

  void finish(Index vertex) {
    if (faces_.num_vertices() - report_.num_removed > options_.most_vertices) {
      throw InvalidInput("a mesh with these spacings and angles has more than " +
                         std::to_string(options_.most_vertices) + " vertices");
    }
    wishes_.push_back(wish_at(faces_.point(vertex)));
    await_changed();
  }

  // Returns the halfedge of a segment in a face.
  [[nodiscard]] std::optional<Index> halfedge_of(Index segment, Index f) const {
    if (!faces_.is_alive(f)) return {};
    for (unsigned i = 0; i < 3; ++i) {
      if (faces_.face(f).segment[i] == segment) return halfedge(f, i);
    }
    return {};
  }

  // Returns a free vertex in the cap around a segment that can be seen from it, and its face.
  [[nodiscard]] std::optional<std::array<Index, 2>> vertex_in_cap(Index h) {
    const Vector middle = 0.5 * (faces_.direction(faces_.from(h)) + faces_.direction(faces_.to(h)));
    const double radius2 = square_of_distance(middle, faces_.direction(faces_.from(h)));
    way_.assign(1, h);
    const Index beyond = faces_.face(face_of(h)).opposite[edge_of(h)];
    if (beyond != no_index) way_.push_back(beyond);
    for (std::size_t k = 0; k < way_.size(); ++k) {
      const Index f = face_of(way_[k]);
      if (!is_asked_for(f)) continue;
      const Index apex = faces_.apex(way_[k]);
      const bool is_inside = square_of_distance(faces_.direction(apex), middle) < radius2;
      if (is_inside && faces_.kind(apex) == VertexKind::free) return {{apex, f}};
      for (const unsigned i :
           {topology::next_corner[edge_of(way_[k])], topology::previous_corner[edge_of(way_[k])]}) {
        const Index next = faces_.face(f).opposite[i];
        if (faces_.face(f).segment[i] != no_index || !is_near(halfedge(f, i), middle, radius2)) {
          continue;
        }
        const bool is_known =
            std::ranges::any_of(way_, [&](Index other) { return face_of(other) == face_of(next); });
        if (!is_known) way_.push_back(next);
      }
    }
    return {};
  }

  // True if an arc has a point within the distance of a place. Its chord may pass far below.
  [[nodiscard]] bool is_near(Index h, const Vector& place, double square_of_distance_) const {
    const Vector& a = faces_.direction(faces_.from(h));
    const Vector& b = faces_.direction(faces_.to(h));
    const Vector normal = cross(a, b - a);
    const Vector foot = place - (dot(place - a, normal) / dot(normal, normal)) * normal;
    const bool is_beside = dot(cross(normal, a), foot) > 0 && dot(cross(b, normal), foot) > 0;
    return std::min(square_of_distance(a, place), square_of_distance(b, place)) <
               square_of_distance_ ||
           (is_beside && square_of_distance(normalized(foot), place) < square_of_distance_);
  }

  // Divides a segment, after the free vertices in its cap are removed. Returns false if it cannot
  // be divided.
  bool divide(Index h) {
    const Index segment = faces_.face(face_of(h)).segment[edge_of(h)];
    if (segment < is_stuck_.size() && is_stuck_[segment]) return false;
    const Vector& p = faces_.direction(faces_.from(h));
    const Vector& q = faces_.direction(faces_.to(h));
    if (square_of_distance(p, q) < square(2 * closest)) return false;
    while (const auto found = vertex_in_cap(h)) {
      const auto& [vertex, face] = *found;
      faces_.remove(vertex, face);
      ++report_.num_removed;
      await_changed();
      if (halfedge_of(segment, face_of(h)) == h) continue;
      for (const Index f : faces_.changed()) {
        if (const auto now = halfedge_of(segment, f)) h = *now;
      }
    }
    std::array<Index, 2> shells{};
    const Vector place =
        dividing_point(faces_.from(h), faces_.to(h), faces_.segment(segment).shell, shells);
    const auto added = faces_.divide(h, place, shells);
    if (!added) {
      // It is not tried again, because free vertices would come and go for ever.
      if (segment >= is_stuck_.size()) is_stuck_.resize(segment + std::size_t{1});
      is_stuck_[segment] = true;
      return false;
    }
    ++report_.num_divisions;
    shell_of_vertex_.resize(faces_.num_vertices(), no_index);
    shell_of_vertex_[*added] = shells[0];
    finish(*added);
    return true;
  }

  // Returns where the segment from p to q is divided, and the shells of its halves.
  [[nodiscard]] Vector dividing_point(Index p, Index q, Index shell,
                                      std::array<Index, 2>& shells) const {
    shells = {shell, shell};
    if (shell == no_index) {
      const auto is_small = [&](Index v) {
        return faces_.kind(v) == VertexKind::given && has_small_angle_[v];
      };
      const auto before = [&](Index v, Index w) {
        const Point& a = faces_.point(v);
        const Point& b = faces_.point(w);
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
      };
      if (is_small(p) && is_small(q)) {
        shells = {p, q};
        shell = before(p, q) ? p : q;
      } else if (is_small(p) || is_small(q)) {
        shell = is_small(p) ? p : q;
        shells = {shell, shell};
      }
    }
    const Vector& a = faces_.direction(p);
    const Vector& b = faces_.direction(q);
    if (shell == no_index) {
      const double sum = norm(a + b);
      if (sum > 0x1p-10) return normalized(a + b);
      return normalized(sum / 2 * a + tangent(p, q));
    }
    const double to_a = norm(a - faces_.direction(shell));
    const double to_b = norm(b - faces_.direction(shell));
    return on_shell(shell, to_a < to_b ? q : p,
                    round_number(std::min(to_a, to_b), std::max(to_a, to_b)));
  }

  // Returns a multiple of the largest power of two in the middle third of a range.
  [[nodiscard]] static double round_number(double low, double high) {
    const double first = low + (high - low) / 3;
    const double last = high - (high - low) / 3;
    double step = std::ldexp(1.0, std::ilogb(high));
    while (std::ceil(first / step) * step > last) step /= 2;
    return std::ceil(first / step) * step;
  }

  // Returns the direction of the arc from one vertex to another one, a unit vector. It is as exact
  // for vertices that are nearly in one place, or nearly opposite to each other.
  [[nodiscard]] Vector tangent(Index from, Index to) const {
    const exact::SplitPoint u = exact::unit_vector(faces_.point(from), {});
    const exact::SplitPoint w = exact::unit_vector(faces_.point(to), {});
    const Vector start = exact::to_vector(u.hi);
    const double sign = dot(start, exact::to_vector(w.hi)) < 0 ? 1 : -1;
    const Vector way = exact::to_vector(w.hi) + sign * start +
                       (exact::to_vector(w.lo) + sign * exact::to_vector(u.lo));
    return normalized(way - dot(way, start) * start);
  }

  // Returns the point at a distance, by the chord, from a vertex on the arc to another one.
  [[nodiscard]] Vector on_shell(Index from, Index to, double distance) const {
    const double cosine = 1 - square(distance) / 2;
    const double sine = distance * std::sqrt(1 - square(distance) / 4);
    return normalized(cosine * faces_.direction(from) + sine * tangent(from, to));
  }

  // True if the shortest edge joins two segments that meet at a small angle, at the same distance
  // from their common end.
  [[nodiscard]] bool is_between_shells(Index f, const FaceShape& shape) const {
    const Triple& corners = faces_.face(f).vertex;
    const Index p = corners[topology::next_corner[shape.shortest]];
    const Index q = corners[topology::previous_corner[shape.shortest]];
    const auto shell = [&](Index v) {
      return v < shell_of_vertex_.size() ? shell_of_vertex_[v] : no_index;
    };
    if (shell(p) == no_index || shell(p) != shell(q)) return false;
    const Vector& center = faces_.direction(shell(p));
    const double to_p = square_of_distance(faces_.direction(p), center);
    const double to_q = square_of_distance(faces_.direction(q), center);
    return std::abs(to_p - to_q) <= 0x1p-10 * to_p && shape.squares[shape.shortest] < to_p;
  }

  // Counts the triangles that are not as wanted.
  void count_unwanted() {
    for (Index f = 0; f < faces_.faces().size(); ++f) {
      if (!is_asked_for(f)) continue;
      const FaceShape shape = shape_of(f);
      if (!is_large(shape) && !is_narrow(shape)) continue;
      const bool is_known = !is_large(shape) && is_between_shells(f, shape);
      ++(is_known ? report_.num_near_small_angles : report_.num_too_small);
    }
  }

  void divide_long_segments() {
    while (!long_segments_.empty()) {
      const Index h = long_segments_.back();
      long_segments_.pop_back();
      if (!is_asked_for(face_of(h)) || faces_.face(face_of(h)).segment[edge_of(h)] == no_index) {
        continue;
      }
      const Index p = faces_.from(h);
      const Index q = faces_.to(h);
      const double wish = std::min(wishes_[p], wishes_[q]);
      const double length2 = square_of_distance(faces_.direction(p), faces_.direction(q));
      if (!(length2 > square(longest_segment * wish)) || !divide(h)) continue;
      for (const Index f : faces_.changed()) {
        for (unsigned i = 0; i < 3; ++i) long_segments_.push_back(halfedge(f, i));
      }
    }
  }

  [[nodiscard]] RefinedMesh result() const;

  const RefineOptions& options_;
  const SmallLength& small_;
  const Execution& execution_;
  RefinedFaces faces_;
  double largest_ratio_ = 0;    // of the circumradius and the shortest edge, squared
  double height_of_angle_ = 0;  // of a triangle over its shortest edge, opposite to that angle
  std::vector<double> wishes_;  // by vertex: the spacing as a chord
  std::vector<bool> has_small_angle_;
  std::vector<bool> is_stuck_;  // by segment: doubles have no place for a vertex that divides it
  std::vector<Index> shell_of_vertex_;
  std::vector<Index> long_segments_;
  std::vector<Index> way_;
  FaceQueue large_;
  FaceQueue narrow_;
  RefineReport report_;
};

RefinedMesh Refinement::result() const {
  RefinedMesh mesh;
  mesh.report = report_;
  std::vector<Index> node(faces_.num_vertices(), no_index);
  const auto asked = [&](Index f) { return is_asked_for(f); };
  for (Index f = 0; f < faces_.faces().size(); ++f) {
    if (!asked(f)) continue;
    for (const Index v : faces_.face(f).vertex) node[v] = 0;
  }
  for (Index v = 0; v < node.size(); ++v) {
    if (node[v] == no_index) continue;
    node[v] = static_cast<Index>(mesh.nodes.size());
    mesh.nodes.push_back(faces_.point(v));
    mesh.sites.push_back(faces_.kind(v) == VertexKind::given ? v : no_index);
  }
  std::vector<std::array<Index, 3>> edges;
  for (Index f = 0; f < faces_.faces().size(); ++f) {
    if (!asked(f)) continue;
    const RefinedFace& face = faces_.face(f);
    mesh.triangles.push_back({node[face.vertex[0]], node[face.vertex[1]], node[face.vertex[2]]});
    mesh.regions.push_back(face.region);
    for (unsigned i = 0; i < 3; ++i) {
      if (face.segment[i] == no_index) continue;
      const Index h = halfedge(f, i);
      const auto [low, high] = std::minmax({node[faces_.from(h)], node[faces_.to(h)]});
      edges.push_back({low, high, faces_.segment(face.segment[i]).source});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [low, high, source] : edges) {
    mesh.edges.push_back({low, high});
    mesh.sources.push_back(source);
  }
  return mesh;
}

}  // namespace

RefinedMesh refine(const ConstrainedTriangulation& given, std::span<const Index> regions,
                   const RefineOptions& options, const Execution& execution) {
  return meshing::refine_coarsely(given, regions, options, nullptr, execution);
}

}  // namespace rondel::mesh

namespace rondel::meshing {

mesh::RefinedMesh refine_coarsely(const ConstrainedTriangulation& given,
                                  std::span<const Index> regions,
                                  const mesh::RefineOptions& options,
                                  const std::function<double(const Point&)>& small,
                                  const Execution& execution) {
  const system::Call call(execution);
  if (regions.size() != given.triangulation.num_faces()) {
    throw InvalidInput("there is one region for each face, not " + std::to_string(regions.size()) +
                       " for " + std::to_string(given.triangulation.num_faces()) + " faces");
  }
  if (!(given.triangulation.sphere().center == Point{})) {
    throw InvalidInput("triangles are refined around the origin only");
  }
  if (!(options.smallest_angle_deg >= 0 && options.smallest_angle_deg <= 33)) {
    throw InvalidInput("the smallest angle is from 0 to 33 degrees, not " +
                       system::shortest_text(options.smallest_angle_deg));
  }
  return mesh::Refinement(given, regions, options, small, execution).run();
}

}  // namespace rondel::meshing
