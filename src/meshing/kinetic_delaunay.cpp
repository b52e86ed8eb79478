// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "meshing/kinetic_delaunay.h"

#include <algorithm>
#include <array>

#include "rondel/delaunay.h"
#include "rondel/predicates.h"
#include "system/parallel.h"

namespace rondel::mesh {
namespace {

constexpr std::size_t faces_at_a_time = 4096;

// The error of det(B, C, D) of differences from a corner, where |D|^2 and the larger of |B|^2 and
// |C|^2 are at most m. A site is within 3u of its projection, so a difference within 6u of that of
// the projections; the rounding of differences, cross and dot product adds 10u of a product of
// three lengths, none above 2: (3 * 6 + 2 * 10) u m, and second-order terms.
constexpr double plane_error = 64 * 0x1p-53;
// The bound of the error of the height of a plane over the center times 2 |area|.
constexpr double turn_error = 64 * 0x1p-53;

double larger(double a, double b) { return a > b ? a : b; }

}  // namespace

bool KineticDelaunay::update(std::span<const Point> sites) {
  if (faces_.size() == 2 * sites.size() - 4 && mend(sites)) return true;
  if (build(sites)) return true;
  reset();
  return false;
}

bool KineticDelaunay::build(std::span<const Point> sites) {
  ++num_builds_;
  const Execution execution{.threads = threads_};
  const Triangulation made = delaunay(Sites::view(sites), {}, execution);
  if (made.dimension() != 2 || made.num_ghost_faces() != 0 || made.num_vertices() != sites.size()) {
    return false;
  }
  faces_.assign(made.faces().begin(), made.faces().end());
  neighbors_.assign(made.neighbors().begin(), made.neighbors().end());
  centers_.resize(faces_.size());
  first_face_.resize(sites.size());
  for (Index f = 0; f < faces_.size(); ++f) {
    begin_with_lowest(f);
    for (const Index v : faces_[f]) first_face_[v] = f;
  }
  std::vector<char> has_turned(system::num_pieces(faces_.size(), faces_at_a_time));
  system::parallel_for(threads_, faces_.size(), faces_at_a_time,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t f = begin; f < end; ++f) {
                           if (look_at(sites, static_cast<Index>(f)) == Look::turned) {
                             has_turned[begin / faces_at_a_time] = 1;
                           }
                         }
                       });
  return std::ranges::find(has_turned, 1) == has_turned.end();
}

// Computes the center of a face, and checks its edges to faces of higher numbers.
KineticDelaunay::Look KineticDelaunay::look_at(std::span<const Point> sites, Index face) {
  const Triple& corners = faces_[face];
  const Vector a = exact::to_vector(sites[corners[0]]);
  const Vector b = exact::to_vector(sites[corners[1]]) - a;
  const Vector c = exact::to_vector(sites[corners[2]]) - a;
  const Vector n = cross(b, c);
  const double length = norm(n);
  const double longest = larger(dot(b, b), dot(c, c));
  if (!(dot(n, a) > turn_error * longest)) return Look::turned;
  centers_[face] = exact::to_point(n / length);
  for (Index i = 0; i < 3; ++i) {
    const Index g = neighbors_[face][i];
    if (g < face) continue;
    const Triple& beyond = neighbors_[g];
    const Index j = beyond[0] == face ? 0 : (beyond[1] == face ? 1 : 2);
    const Vector d = exact::to_vector(sites[faces_[g][j]]) - a;
    if (!(dot(n, d) < -plane_error * larger(longest, dot(d, d)))) return Look::broken;
  }
  return Look::fine;
}

bool KineticDelaunay::mend(std::span<const Point> sites) {
  const std::size_t num_pieces = system::num_pieces(faces_.size(), faces_at_a_time);
  std::vector<std::vector<Index>> broken(num_pieces);
  std::vector<char> has_turned(num_pieces);
  system::parallel_for(threads_, faces_.size(), faces_at_a_time,
                       [&](std::size_t begin, std::size_t end) {
                         const std::size_t piece = begin / faces_at_a_time;
                         for (std::size_t f = begin; f < end; ++f) {
                           const Look look = look_at(sites, static_cast<Index>(f));
                           if (look == Look::turned) has_turned[piece] = 1;
                           if (look == Look::broken) broken[piece].push_back(static_cast<Index>(f));
                         }
                       });
  if (std::ranges::find(has_turned, 1) != has_turned.end()) return false;

  std::vector<Index> to_look_at;
  for (const auto& piece : broken) to_look_at.insert(to_look_at.end(), piece.begin(), piece.end());
  std::vector<Index> changed;
  while (!to_look_at.empty()) {
    const Index f = to_look_at.back();
    to_look_at.pop_back();
    for (Index i = 0; i < 3; ++i) {
      const Index g = neighbors_[f][i];
      if (!is_to_flip(sites, f, i)) continue;
      flip(f, i);
      for (const Index h : {f, g}) {
        if (look_at(sites, h) == Look::turned) return false;
        to_look_at.push_back(h);
      }
      // A build takes as long as about eight flips a face, so it is preferred from there on.
      if (++num_flips_; changed.size() > faces_.size() / 8) return false;
      changed.push_back(f);
      break;
    }
  }
  return true;
}

bool KineticDelaunay::is_to_flip(std::span<const Point> sites, Index face, Index corner) const {
  const Triple& corners = faces_[face];
  const Index g = neighbors_[face][corner];
  const Triple& beyond = neighbors_[g];
  const Index j = beyond[0] == face ? 0 : (beyond[1] == face ? 1 : 2);
  const Point& p = sites[faces_[g][j]];
  const Vector a = exact::to_vector(sites[corners[0]]);
  const Vector b = exact::to_vector(sites[corners[1]]) - a;
  const Vector c = exact::to_vector(sites[corners[2]]) - a;
  const Vector d = exact::to_vector(p) - a;
  const double height = det(b, c, d);
  const double error = plane_error * larger(larger(dot(b, b), dot(c, c)), dot(d, d));
  if (height < -error) return false;
  if (height > error) return true;
  return is_in_conflict(sites[corners[0]], sites[corners[1]], sites[corners[2]], p);
}

//       r                 r           The edge opposite to p goes from q to r. Face f keeps p and q,
//      / | \             / g \         face g keeps r; d is the vertex of g beyond the edge.
//     p f|g d    =>     p --- d
//      \ | /             \ f /
//        q                 q
void KineticDelaunay::flip(Index f, Index corner) {
  const Triple of_f = faces_[f];
  const Triple beyond_f = neighbors_[f];
  const Index g = beyond_f[corner];
  const Triple of_g = faces_[g];
  const Triple beyond_g = neighbors_[g];
  const Index j = beyond_g[0] == f ? 0 : (beyond_g[1] == f ? 1 : 2);
  const Index p = of_f[corner];
  const Index q = of_f[next_of(corner)];
  const Index r = of_f[previous_of(corner)];
  const Index d = of_g[j];
  const Index across_qd = beyond_g[next_of(j)];
  const Index across_dr = beyond_g[previous_of(j)];
  const Index across_rp = beyond_f[next_of(corner)];
  const Index across_pq = beyond_f[previous_of(corner)];
  faces_[f] = {p, q, d};
  neighbors_[f] = {across_qd, g, across_pq};
  faces_[g] = {p, d, r};
  neighbors_[g] = {across_dr, across_rp, f};
  replace_neighbor(across_qd, g, f);
  replace_neighbor(across_rp, f, g);
  first_face_[p] = first_face_[q] = first_face_[d] = f;
  first_face_[r] = g;
  begin_with_lowest(f);
  begin_with_lowest(g);
}

void KineticDelaunay::begin_with_lowest(Index face) {
  Triple& corners = faces_[face];
  const auto lowest = std::ranges::min_element(corners) - corners.begin();
  std::rotate(corners.begin(), corners.begin() + lowest, corners.end());
  Triple& beyond = neighbors_[face];
  std::rotate(beyond.begin(), beyond.begin() + lowest, beyond.end());
}

void KineticDelaunay::replace_neighbor(Index face, Index before, Index after) {
  *std::ranges::find(neighbors_[face], before) = after;
}

void KineticDelaunay::faces_around(Index vertex, std::vector<Index>& ring) const {
  ring.clear();
  const Index first = first_face_[vertex];
  Index f = first;
  Index lowest = no_index;
  std::size_t place = 0;
  do {
    const Index i = corner_of(f, vertex);
    const Index neighbor = faces_[f][next_of(i)];
    if (neighbor < lowest) {
      lowest = neighbor;
      place = ring.size();
    }
    ring.push_back(f);
    f = neighbors_[f][next_of(i)];
  } while (f != first);
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(place), ring.end());
}

}  // namespace rondel::mesh
