// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces of a constrained triangulation whose sites and constraints come and go. It is to
// dynamic::Editor what dynamic::PlaceHull is without constraints; the proofs are in
// docs/theory/constrained.md.
//
// Solid faces are those of the constrained triangulation. Ghost faces are those of the hull of the
// places, on whose border only constraints along it are. Both together are a closed surface, on
// which an edge may occur twice, once between solid faces and once between ghost faces.
//
// in    places that come and go, arcs between them
// out   the mesh, and which of its edges are constrained, by which constraints
// index places, as dynamic::Places numbers them; faces; halfedges 3 * face + i; ids of constraints
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "constrained/arc_insertion.h"
#include "constrained/arc_removal.h"
#include "constrained/place_directions.h"
#include "dynamic/link_triangulation.h"
#include "dynamic/renumbering.h"
#include "kernel/walk.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"
#include "system/prefetch.h"
#include "topology/cavity.h"
#include "topology/mesh.h"

namespace rondel::constrained {

class ConstrainedHull {
 public:
  using Edge = std::array<Index, 2>;
  // The constraints that have each constrained edge as a piece, by its two places, the lower first.
  using Sources = std::map<Edge, std::vector<Index>>;

  // `first` are three places with a non-zero orientation.
  ConstrainedHull(PlaceDirections& sites, const std::array<Index, 3>& first);
  // The mesh of a build. Its constraints follow by adopt_constraints().
  ConstrainedHull(PlaceDirections& sites, topology::Mesh mesh);

  // --- places, as dynamic::Editor asks for them ---

  [[nodiscard]] const topology::Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const kernel::FaceKinds& kinds() const { return kinds_; }
  [[nodiscard]] std::size_t num_vertices() const { return mesh_.num_faces() / 2 + std::size_t{2}; }
  [[nodiscard]] bool is_vertex(Index place) const {
    return place < corner_of_.size() && corner_of_[place] != no_index;
  }
  void prefetch(Index place) const {
    if (place >= corner_of_.size()) return;
    sites_.prefetch(place);
    system::prefetch(&corner_of_[place]);
  }
  void prefetch_face(Index place) const {
    if (is_vertex(place)) system::prefetch(&mesh_[topology::face_of(corner_of_[place])]);
  }

  // Inserts a place that is no vertex. `close` is a place close to it, or no_index. An edge on
  // which it lies is divided, and constraints that end there follow, if it was removed just before.
  void insert(Index p, Index close);
  // Returns the neighbors of a vertex by edges of solid faces, counterclockwise; those of a vertex
  // of the border begin and end with its neighbors there.
  std::span<const Index> collect_star(Index v);
  // Removes a vertex. Precondition: collect_star(v) was the call before, and the others do not
  // lie in one plane with the center. If just two constrained edges meet there, which have the same
  // constraints and lie on one great circle, they become one. All others go until insert(v) is
  // called, which has to be the next change.
  void remove_vertex(Index v);
  // Returns the same neighbors.
  [[nodiscard]] std::vector<Index> neighbors(Index v) const;
  [[nodiscard]] bool is_on_border(Index v) const;
  // Takes new numbers of places.
  void renumber(const dynamic::Renumbering& places);

  // --- constraints ---

  // False until the constraints of the places were inserted or adopted.
  [[nodiscard]] bool has_constraints() const { return has_constraints_; }
  // Takes the constrained sides of a build, by face, and the sources of its edges.
  void adopt_constraints(std::span<const std::uint8_t> sides, Sources sources);
  // Says that all constraints were inserted.
  void adopt_constraints() { has_constraints_ = true; }
  [[nodiscard]] const Sources& sources() const { return sources_; }
  // By face, as in ConstrainedTriangulation.
  [[nodiscard]] std::span<const std::uint8_t> sides() const { return sides_; }

  // Returns a constrained edge that the arc between two vertices crosses, if there is one.
  [[nodiscard]] std::optional<Edge> find_crossed(Index a, Index b) {
    return insertion_.find_crossed(*this, a, b);
  }
  // Inserts a constraint between two vertices, which crosses no other one.
  void insert_constraint(Index a, Index b, Index constraint);
  // Removes it. Edges that no other constraint has become locally Delaunay.
  void remove_constraint(Index a, Index b, Index constraint);
  // Returns the vertices along the arc between two vertices that is a chain of edges, from a to b.
  [[nodiscard]] std::vector<Index> chain(Index a, Index b) const;
  // Returns two constraints that cross in a vertex, if no constraint ends there and several do.
  [[nodiscard]] std::optional<Edge> crossing_at(Index v);

  // --- what ArcInsertion asks for ---

  [[nodiscard]] const Triple& corners(Index f) const { return mesh_[f].vertex; }
  [[nodiscard]] Index neighbor(Index f, unsigned edge) const { return mesh_.neighbor(f, edge); }
  [[nodiscard]] Index opposite(Index h) const {
    return mesh_[topology::face_of(h)].opposite[topology::edge_of(h)];
  }
  [[nodiscard]] bool is_solid(Index f) const { return kinds_[f] == kernel::FaceKind::solid; }
  [[nodiscard]] Index solid_face_at(Index v) const { return topology::face_of(corner_of_[v]); }
  [[nodiscard]] bool is_constrained(Index h) const {
    return (static_cast<unsigned>(sides_[h / 3]) >> h % 3 & 1U) != 0;
  }
  [[nodiscard]] Sign side(Index a, Index b, Index v) const { return sites_.orientation(a, b, v); }
  [[nodiscard]] bool is_in_circle(Index a, Index b, Index c, Index v) const {
    return sites_.is_in_conflict({a, b, c}, v);
  }
  void put_in_cavity(Index f) { sides_[f] |= in_cavity; }
  [[nodiscard]] bool is_in_cavity(Index f) const { return (sides_[f] & in_cavity) != 0; }
  void replace(Index f, const Triple& corners);
  void link(Index h, Index g) { mesh_.link(h, g); }
  void constrain_side(Index h) { set_side(h, true); }
  void constrain(Index h) { set_sides(h, true); }

 private:
  // Beside the bits of constrained sides.
  static constexpr std::uint8_t in_cavity = 8;

  // A face at a vertex, with the edge that leads from the vertex to the face's next corner.
  struct StarSpoke {
    Index face;
    Index neighbor;            // the next corner
    topology::Halfedge outer;  // beyond the edge opposite to the vertex
    topology::Halfedge edge;   // the edge to the neighbor, seen from the face
  };
  // A vertex of a hole, and what is beyond the edge to the next vertex.
  struct HoleEdge {
    Index vertex;
    topology::Halfedge outer;
  };
  // A constrained edge that waits for one of its vertices.
  struct LiftedEdge {
    Index neighbor;
    std::vector<Index> constraints;
  };

  static Edge edge_between(Index a, Index b) { return a < b ? Edge{a, b} : Edge{b, a}; }
  [[nodiscard]] bool is_in_conflict(Index f, Index p) const {
    return sites_.is_in_conflict(mesh_[f].vertex, p);
  }
  [[nodiscard]] Edge ends_of(topology::Halfedge h) const;
  void set_side(topology::Halfedge h, bool is_constrained);
  void set_sides(topology::Halfedge h, bool is_constrained);
  void set_corners(Index f);
  // Takes a face that came, without constrained sides.
  void adopt(Index f);

  // Insertion.
  void surround(Index p, Index f);
  void reach_out(Index p, topology::Halfedge visible);
  [[nodiscard]] bool is_seen(Index p, topology::Halfedge h) const;
  [[nodiscard]] topology::Halfedge next_on_border(topology::Halfedge h) const;
  [[nodiscard]] topology::Halfedge previous_on_border(topology::Halfedge h) const;
  void list_seen_border(Index p, topology::Halfedge visible);
  void enter(const topology::HorizonEdge& edge);
  [[nodiscard]] bool is_crossed(Index p, topology::Halfedge outside) const;
  void spread(Index p);
  void make_star(Index p);
  void divide(Index p, const Edge& edge);
  void restore_lifted(Index p);

  // Removal.
  [[nodiscard]] topology::Halfedge first_corner_at(Index v) const;
  void list_spokes(Index v);
  [[nodiscard]] std::vector<Index> constrained_neighbors() const;
  [[nodiscard]] bool is_passed(Index v, const std::vector<Index>& neighbors) const;
  void lift(Index v, const std::vector<Index>& neighbors);
  void empty_star(Index v);
  void fill_around(const std::vector<Index>& passing);
  void fill_behind_border();
  void list_new_border();
  topology::Halfedge fill(bool is_closed);
  void close_up();

  void release(topology::Halfedge h);

  PlaceDirections& sites_;
  topology::Mesh mesh_;
  kernel::FaceKinds kinds_;
  std::vector<std::uint8_t> sides_;            // by face
  std::vector<topology::Halfedge> corner_of_;  // a corner of a solid face, as 3 * face + corner
  Index solid_face_ = no_index;                // some solid face
  Sources sources_;
  bool has_constraints_ = false;
  std::vector<LiftedEdge> lifted_;

  // The rest belongs to one change.
  ArcInsertion<ConstrainedHull> insertion_;
  ArcRemoval<ConstrainedHull> removal_;
  topology::Halfedge forced_ = no_index;  // the edge that has p, seen from beyond the first face
  std::vector<Index> region_;
  std::vector<topology::HorizonEdge> horizon_;
  std::vector<topology::HorizonEdge> stack_;
  std::vector<topology::Halfedge> border_;
  dynamic::LinkTriangulation triangulation_;
  std::vector<StarSpoke> spokes_;  // those of solid faces first
  std::size_t num_solid_ = 0;      // of the spokes
  std::vector<Index> link_;        // what collect_star() has returned
  std::vector<Index> free_faces_;
  std::vector<HoleEdge> hole_;
  std::vector<Index> corners_;  // of the hole
  std::vector<Index> slots_;    // of the faces that fill it
  std::vector<std::size_t> chain_;
};

}  // namespace rondel::constrained
