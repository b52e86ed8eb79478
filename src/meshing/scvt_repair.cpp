// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/scvt_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "exact/vector.h"
#include "meshing/kinetic_delaunay.h"
#include "system/parallel.h"

namespace rondel::mesh {
namespace {

constexpr std::size_t faces_of_a_piece = 4096;
// Values below the limit are moved to the aim.
constexpr double limit_of_edges = 0.0505;  // dual edge / edge, with 1 % for the curvature
constexpr double aim_of_edges = 0.055;
constexpr double limit_of_corners = 0.0005;  // cotangents
constexpr double aim_of_corners = 0.005;
// How far a site may move from where it was, in units of the length of an edge: farther if defects
// are left.
constexpr std::array<double, 3> reaches = {0.15, 0.3, 0.45};
constexpr int rounds_without_success = 12;
constexpr int passes_of_a_round = 8;

// Requires that the cotangents over the edge from a to b, at one or two corners, sum up to at least
// `aim`.
struct Bound {
  Index a;
  Index b;
  std::array<Index, 2> corners;
  double aim;
};

// A cotangent and its gradients by the sites.
struct Cotangent {
  double value;
  Vector by_a;  // its gradients; that by the corner is -by_a - by_b
  Vector by_b;
};

// Returns the cotangent d / s with d = u.v and s = |u x v|, and its gradients.
Cotangent cotangent(const Vector& u, const Vector& v) {
  const double d = dot(u, v);
  const double s = norm(cross(u, v));
  const double ratio = d / (s * s);
  return {d / s, (1 / s) * (v - ratio * (dot(v, v) * u - d * v)),
          (1 / s) * (u - ratio * (dot(u, u) * v - d * u))};
}

bool is_odd(int degree) { return degree < 5 || degree > 7; }

// Repairs a tessellation.
class Repair {
 public:
  Repair(std::vector<Point>& sites, std::span<const std::uint8_t> is_fixed, unsigned threads)
      : sites_(sites), start_(sites), is_fixed_(is_fixed), threads_(threads), surface_(threads) {}

  ScvtRepair run() {
    ScvtRepair done;
    if (!surface_.update(sites_)) return done;
    done.before = done.after = find();
    for (const double reach : reaches) {
      if (bounds_.empty()) break;
      improve(reach, done);
      if (!surface_.update(sites_)) break;
      done.after = find();
    }
    for (std::size_t i = 0; i < sites_.size(); ++i) done.moved += sites_[i] == start_[i] ? 0U : 1U;
    return done;
  }

 private:
  // Repeats rounds until no defect is left or they no longer help, and keeps the best sites.
  void improve(double reach, ScvtRepair& done) {
    std::vector<Point> best = sites_;
    for (int last = 0, round = 1; round <= last + rounds_without_success && !bounds_.empty();
         ++round) {
      for (int pass = 0; pass < passes_of_a_round; ++pass) {
        for (const Bound& bound : bounds_) meet(bound, reach);
      }
      if (!surface_.update(sites_)) break;
      ++rounds_;
      const ScvtDefects found = find();
      if (!is_better(found, done)) continue;
      done.after = found;
      done.rounds = rounds_;
      last = round;
      best = sites_;
    }
    sites_ = std::move(best);
  }

  struct FacesLookedAt {
    std::vector<Bound> bounds;
    std::size_t short_edges = 0;
    std::size_t obtuse = 0;
    double least = std::numeric_limits<double>::infinity();
  };

  static bool is_better(const ScvtDefects& found, const ScvtRepair& done) {
    const auto total = [](const ScvtDefects& d) {
      return d.odd_cells + d.short_edges + d.obtuse_triangles;
    };
    return found.odd_cells <= done.before.odd_cells &&
           found.short_edges <= done.before.short_edges &&
           found.obtuse_triangles <= done.before.obtuse_triangles &&
           found.min_edge_ratio >= done.before.min_edge_ratio && total(found) < total(done.after);
  }

  // Returns the cotangent of the angle at a corner, in the plane of the three sites.
  [[nodiscard]] double cotangent_at(Index corner, Index a, Index b) const {
    const Vector c = exact::to_vector(sites_[corner]);
    const Vector u = exact::to_vector(sites_[a]) - c;
    const Vector v = exact::to_vector(sites_[b]) - c;
    return dot(u, v) / norm(cross(u, v));
  }

  // Returns the corner, of the face across the edge opposite to this corner, that is not on the
  // edge.
  [[nodiscard]] Index beyond(Index face, Index corner) const {
    const Index g = surface_.neighbors()[face][corner];
    const Triple& back = surface_.neighbors()[g];
    return surface_.faces()[g][back[0] == face ? 0 : (back[1] == face ? 1 : 2)];
  }

  // Returns the length of the dual edge of ab, whose faces have the corners c and d, over that of
  // ab.
  [[nodiscard]] double ratio_of_edge(Index a, Index b, Index c, Index d) const {
    return 0.5 * (cotangent_at(c, a, b) + cotangent_at(d, a, b));
  }

  // Returns by how much the sum of (degree - 6)^2 grows if the edge ab is replaced by cd.
  [[nodiscard]] int growth(Index a, Index b, Index c, Index d) const {
    return 4 + 2 * (degrees_[c] + degrees_[d] - degrees_[a] - degrees_[b]);
  }

  // Counts the defects of a face, and adds their bounds. The face with the lower number has an
  // edge.
  void look_at(Index f, FacesLookedAt& piece) const {
    const Triple& face = surface_.faces()[f];
    for (Index i = 0; i < 3; ++i) {
      const Index a = face[next_of(i)];
      const Index b = face[previous_of(i)];
      const Index c = face[i];
      const double at_c = cotangent_at(c, a, b);
      piece.obtuse += at_c < 0 ? 1U : 0U;
      if (at_c < limit_of_corners) {
        piece.bounds.push_back({a, b, {c, no_index}, aim_of_corners});
      }
      if (surface_.neighbors()[f][i] < f) continue;
      const Index d = beyond(f, i);
      const double ratio = 0.5 * (at_c + cotangent_at(d, a, b));
      piece.least = std::min(piece.least, ratio);
      if (ratio >= limit_of_edges) continue;
      ++piece.short_edges;
      piece.bounds.push_back(growth(a, b, c, d) < 0 ? Bound{c, d, {a, b}, 2 * aim_of_edges}
                                                    : Bound{a, b, {c, d}, 2 * aim_of_edges});
    }
  }

  // Among the edges whose exchange gives this cell one side more, or fewer, adds the bound of the
  // one that needs the smallest change.
  void even_out(Index site) {
    surface_.faces_around(site, ring_);
    double least = std::numeric_limits<double>::infinity();
    Bound best{};
    const bool has_few = degrees_[site] < 6;
    for (const Index f : ring_) {
      const Index at = surface_.corner_of(f, site);
      const Index corner = has_few ? at : next_of(at);
      const Triple& face = surface_.faces()[f];
      const Index a = face[next_of(corner)];
      const Index b = face[previous_of(corner)];
      const Index c = face[corner];
      const Index d = beyond(f, corner);
      const double ratio = ratio_of_edge(a, b, c, d);
      const bool makes_odd =
          degrees_[a] == 5 || degrees_[d] == 7 || (has_few ? degrees_[b] == 5 : degrees_[c] == 7);
      if (ratio >= least || growth(a, b, c, d) > (makes_odd ? -1 : 0)) continue;
      least = ratio;
      best = {c, d, {a, b}, 2 * aim_of_edges};
    }
    if (least < std::numeric_limits<double>::infinity()) bounds_.push_back(best);
  }

  // Finds the defects, and the bounds that would remove them.
  ScvtDefects find() {
    degrees_.assign(sites_.size(), 0);
    for (const Triple& face : surface_.faces()) {
      for (const Index v : face) ++degrees_[v];
    }
    const std::size_t num_faces = surface_.faces().size();
    std::vector<FacesLookedAt> pieces(system::num_pieces(num_faces, faces_of_a_piece));
    system::parallel_for(threads_, num_faces, faces_of_a_piece,
                         [&](std::size_t begin, std::size_t end) {
                           FacesLookedAt& piece = pieces[begin / faces_of_a_piece];
                           for (std::size_t f = begin; f < end; ++f) {
                             look_at(static_cast<Index>(f), piece);
                           }
                         });
    ScvtDefects found{.min_edge_ratio = std::numeric_limits<double>::infinity()};
    bounds_.clear();
    for (const FacesLookedAt& piece : pieces) {
      bounds_.insert(bounds_.end(), piece.bounds.begin(), piece.bounds.end());
      found.short_edges += piece.short_edges;
      found.obtuse_triangles += piece.obtuse;
      found.min_edge_ratio = std::min(found.min_edge_ratio, piece.least);
    }
    for (Index v = 0; v < degrees_.size(); ++v) {
      if (!is_odd(degrees_[v])) continue;
      ++found.odd_cells;
      even_out(v);
    }
    return found;
  }

  [[nodiscard]] bool is_fixed(Index site) const {
    return !is_fixed_.empty() && is_fixed_[site] != 0;
  }

  // Moves the sites of a violated bound to where it is satisfied.
  void meet(const Bound& bound, double reach) {
    const Vector a = exact::to_vector(sites_[bound.a]);
    const Vector b = exact::to_vector(sites_[bound.b]);
    std::array<Index, 4> moved = {bound.a, bound.b, bound.corners[0], bound.corners[1]};
    std::array<Vector, 4> gradients{};
    const std::size_t num_moved = bound.corners[1] == no_index ? 3 : 4;
    double missing = bound.aim;
    for (std::size_t k = 2; k < num_moved; ++k) {
      const Vector c = exact::to_vector(sites_[moved[k]]);
      const Cotangent at_c = cotangent(a - c, b - c);
      missing -= at_c.value;
      gradients[0] = gradients[0] + at_c.by_a;
      gradients[1] = gradients[1] + at_c.by_b;
      gradients[k] = -1.0 * (at_c.by_a + at_c.by_b);
    }
    if (missing <= 0) return;
    double square = 0;
    for (std::size_t k = 0; k < num_moved; ++k) {
      const Vector z = exact::to_vector(sites_[moved[k]]);
      gradients[k] = gradients[k] - dot(gradients[k], z) * z;
      if (is_fixed(moved[k])) gradients[k] = {0, 0, 0};
      square += dot(gradients[k], gradients[k]);
    }
    if (!(square > 0)) return;
    const double farthest = reach * reach * dot(b - a, b - a);
    std::array<Point, 4> places{};
    for (std::size_t k = 0; k < num_moved; ++k) {
      places[k] = sites_[moved[k]];
      if (is_fixed(moved[k])) continue;
      const Vector z = exact::to_vector(sites_[moved[k]]) + (missing / square) * gradients[k];
      places[k] = exact::to_point(z / norm(z));
      const Vector by = z - exact::to_vector(start_[moved[k]]);
      if (!(dot(by, by) <= farthest)) return;
    }
    for (std::size_t k = 0; k < num_moved; ++k) sites_[moved[k]] = places[k];
  }

  std::vector<Point>& sites_;
  const std::vector<Point> start_;
  std::span<const std::uint8_t> is_fixed_;
  int rounds_ = 0;
  unsigned threads_;
  KineticDelaunay surface_;
  std::vector<int> degrees_;
  std::vector<Bound> bounds_;
  std::vector<Index> ring_;
};

}  // namespace

ScvtRepair repair(std::vector<Point>& sites, std::span<const std::uint8_t> is_fixed,
                  unsigned threads) {
  return Repair(sites, is_fixed, threads).run();
}

}  // namespace rondel::mesh
