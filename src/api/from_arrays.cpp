// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Arrays that come from elsewhere are looked at before anything walks through them. What is proved:
//
// 1. Indices are in range, and every site is a vertex, a duplicate of a vertex or of a hidden site
//    in its place, or hidden: one of these.
// 2. Neighbors agree: across edge i of face f lies the face that has the same two corners in the
//    other order, and it names f.
// 3. The faces at a corner make one turn around it. So the surface is closed and without pinches.
// 4. It is connected and has 2V - 4 faces, so that it is a sphere.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/triangulation_impl.h"
#include "api/validation.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/arithmetic.h"

namespace rondel {
namespace {

// Throws InvalidInput with the position in the array that `what` names.
[[noreturn]] void refuse(const std::string& what, std::size_t index) {
  throw InvalidInput("the arrays are those of no triangulation: " + what, index);
}

// Returns "faces[3]", as messages name an element.
std::string name_of(const char* array, std::size_t index) {
  return std::string(array) + '[' + std::to_string(index) + ']';
}

// Looks at the arrays once, in O(n): first duplicates and hidden sites, then the surface or the
// ring. The steps are in an order in which no index is used before its range is known.
class Inspection {
 public:
  Inspection(std::span<const Point> sites, const TriangulationParts& parts, const Options& options)
      : sites_(sites),
        parts_(parts),
        options_(options),
        num_sites_(sites.size()),
        is_vertex_(sites.size(), true) {}

  // Throws InvalidInput with the position of the first flaw that is found.
  void run() {
    look_at_duplicates();
    look_at_hidden();
    num_vertices_ = num_sites_ - parts_.duplicates.size() - parts_.hidden.size();
    for (std::size_t i = 0; i < parts_.ghost_faces.size(); ++i) {
      const bool is_next = i == 0 || parts_.ghost_faces[i - 1] < parts_.ghost_faces[i];
      if (!is_next || parts_.ghost_faces[i] >= parts_.faces.size()) {
        refuse(name_of("ghost_faces", i) + " is not the next face", i);
      }
    }
    if (parts_.neighbors.size() != parts_.faces.size()) {
      refuse("there is not one row of neighbors for each face",
             std::min(parts_.neighbors.size(), parts_.faces.size()));
    }
    if (parts_.dimension == 2) {
      look_at_surface();
    } else {
      look_at_ring();
    }
  }

 private:
  // Every duplicate names a site of lower index in its place that is not a duplicate itself; the
  // list is in increasing order of the site.
  void look_at_duplicates() {
    for (std::size_t i = 0; i < parts_.duplicates.size(); ++i) {
      const auto [site, lowest] = parts_.duplicates[i];
      const bool is_next = i == 0 || parts_.duplicates[i - 1].site < site;
      if (!is_next || site >= num_sites_ || lowest >= site || !is_vertex_[lowest] ||
          !is_same_site(sites_[site], sites_[lowest], options_.model, options_.sphere)) {
        refuse(name_of("duplicates", i) + " is no site with the lowest one in its place", i);
      }
      is_vertex_[site] = false;
    }
  }

  // Every hidden site names a face in dimension 2, and no_index below. Whether it lies below that
  // face is a question of geometry, which prove_delaunay() answers.
  void look_at_hidden() {
    for (std::size_t i = 0; i < parts_.hidden.size(); ++i) {
      const auto [site, face] = parts_.hidden[i];
      const bool is_next = i == 0 || parts_.hidden[i - 1].site < site;
      const bool has_face = parts_.dimension == 2 ? face < parts_.faces.size() : face == no_index;
      if (!is_next || !has_face || site >= num_sites_ || !is_vertex_[site]) {
        refuse(name_of("hidden", i) + " is no site with a face above it", i);
      }
      is_vertex_[site] = false;
    }
  }

  // Below dimension 2 the number of vertices tells the dimension: -1, 0, or 1 from two on.
  void look_at_ring() {
    const int dimension = num_vertices_ < 2 ? static_cast<int>(num_vertices_) - 1 : 1;
    if (parts_.dimension != dimension) {
      refuse("dimension " + std::to_string(parts_.dimension) + " with " +
                 std::to_string(num_vertices_) + " vertices",
             0);
    }
    if (!parts_.faces.empty()) refuse("there are faces below dimension 2", 0);
    for (std::size_t i = 0; i < parts_.ring.size(); ++i) take_vertex(parts_.ring[i], "ring", i);
    if (parts_.ring.size() != num_vertices_) refuse("the ring leaves vertices out", 0);
  }

  // Every vertex is met once.
  void take_vertex(Index vertex, const char* array, std::size_t i) {
    if (vertex >= num_sites_ || !is_vertex_[vertex]) {
      refuse(
          name_of(array, i) + " names " + std::to_string(vertex) + ", which is no vertex, or twice",
          i);
    }
    is_vertex_[vertex] = false;
  }

  // Euler's formula gives a closed surface like a sphere 2V - 4 faces; other numbers are refused
  // before any face is looked at.
  void look_at_surface() {
    if (!parts_.ring.empty()) refuse("there is a ring in dimension 2", 0);
    if (num_vertices_ < 3 || parts_.faces.size() != 2 * num_vertices_ - 4) {
      refuse(std::to_string(parts_.faces.size()) + " faces with " + std::to_string(num_vertices_) +
                 " vertices",
             0);
    }
    for (std::size_t f = 0; f < parts_.faces.size(); ++f) look_at_face(f);
    for (std::size_t f = 0; f < parts_.faces.size(); ++f) look_across(f);
    turn_around_vertices();
    require_connected();
  }

  // A face has three different vertices, and its neighbors are faces.
  void look_at_face(std::size_t f) const {
    const auto& [a, b, c] = parts_.faces[f];
    for (const Index v : {a, b, c}) {
      if (v >= num_sites_ || !is_vertex_[v]) {
        refuse(name_of("faces", f) + " names " + std::to_string(v) + ", which is no vertex", f);
      }
    }
    if (a == b || b == c || c == a) refuse(name_of("faces", f) + " names a vertex twice", f);
    for (const Index g : parts_.neighbors[f]) {
      if (g >= parts_.faces.size()) {
        refuse(
            name_of("neighbors", f) + " names face " + std::to_string(g) + ", which is not there",
            f);
      }
    }
  }

  // Each edge is named by both of its faces. In a pair of faces back to back each has three edges
  // with the other: the corners tell which.
  void look_across(std::size_t f) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = parts_.faces[f][(i + 1) % 3];
      const Index to = parts_.faces[f][(i + 2) % 3];
      const Index g = parts_.neighbors[f][i];
      bool is_mutual = false;
      for (std::size_t j = 0; j < 3; ++j) {
        is_mutual |= parts_.faces[g][(j + 1) % 3] == to && parts_.faces[g][(j + 2) % 3] == from &&
                     parts_.neighbors[g][j] == f;
      }
      if (!is_mutual) {
        refuse(name_of("neighbors", f) + " names face " + std::to_string(g) +
                   ", which does not share that edge",
               f);
      }
    }
  }

  // A turn begins at the first face that names a vertex, and must meet all corners there are.
  void turn_around_vertices() {
    std::vector<bool> is_met(3 * parts_.faces.size());
    for (std::size_t f = 0; f < parts_.faces.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (is_met[3 * f + i]) continue;
        take_vertex(parts_.faces[f][i], "faces", f);
        turn(f, i, is_met);
      }
    }
  }
  // Marks the corners that the faces around a vertex have there, counterclockwise from the first
  // one. The turn ends, since neighbors agree: each step can be undone.
  void turn(std::size_t first, std::size_t corner, std::vector<bool>& is_met) const {
    const Index vertex = parts_.faces[first][corner];
    std::size_t f = first;
    std::size_t i = corner;
    do {
      is_met[3 * f + i] = true;
      f = parts_.neighbors[f][(i + 1) % 3];
      i = 0;
      while (parts_.faces[f][i] != vertex) ++i;
    } while (f != first);
  }

  // Walks from face 0 across all edges and counts the faces that it meets.
  void require_connected() const {
    std::vector<bool> is_met(parts_.faces.size());
    std::vector<Index> to_visit = {0};
    is_met[0] = true;
    std::size_t num_met = 1;
    while (!to_visit.empty()) {
      const Index f = to_visit.back();
      to_visit.pop_back();
      for (const Index g : parts_.neighbors[f]) {
        if (is_met[g]) continue;
        is_met[g] = true;
        ++num_met;
        to_visit.push_back(g);
      }
    }
    if (num_met != parts_.faces.size()) refuse("the surface has several parts", 0);
  }

  std::span<const Point> sites_;
  const TriangulationParts& parts_;
  const Options& options_;
  std::size_t num_sites_;
  std::size_t num_vertices_ = 0;
  std::vector<bool> is_vertex_;  // and not met yet
};

}  // namespace

Triangulation Triangulation::from_arrays(Sites sites, const TriangulationParts& parts,
                                         const Options& options) {
  const system::ArithmeticScope arithmetic;
  api::validate(sites.points(), options);
  Inspection(sites.points(), parts, options).run();
  const auto copy = [](const auto& values, auto& copies) {
    copies.assign(values.begin(), values.end());
  };
  TriangulationArrays arrays;
  arrays.num_sites = sites.size();
  arrays.dimension = parts.dimension;
  copy(parts.faces, arrays.faces);
  copy(parts.neighbors, arrays.neighbors);
  copy(parts.ghost_faces, arrays.ghost_faces);
  copy(parts.ring, arrays.ring);
  copy(parts.duplicates, arrays.duplicates);
  copy(parts.hidden, arrays.hidden);
  // That the faces are Delaunay costs more to prove, so it is proved only for who walks through
  // them.
  auto impl = std::make_shared<Impl>(std::move(sites), std::move(arrays), options, BuildReport{});
  impl->proof = &api::prove_delaunay;
  return Triangulation(std::move(impl));
}

}  // namespace rondel
