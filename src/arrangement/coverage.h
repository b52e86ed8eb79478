// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Finds which polygons have the faces of an arrangement of their sides.
//
// in    halfedges, and which of them the rings of each polygon run along
// out   for each halfedge the polygons that have its face, one halfedge after the other
// index halfedges; polygons
//
// A traversal of all faces knows which polygons have the current face: to cross an edge changes
// that for the polygons that have the edge. Where edges form several components, a path leads from
// a node of each to a node of the next one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "arrangement/halfedges.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

// A polygon of which an odd number of rings runs along an edge. `sum` has how many more of them
// run from the lower node to the higher one than back.
struct EdgeOfPolygon {
  Index polygon;
  int sum;
};

// The polygons of each of two operands that have a place, in any order.
using Owners = std::array<std::vector<Index>, 2>;

// A place of which it is known whether it is inside of a polygon. Where it is a corner of the
// polygon, the places beside it are meant, to the right of the way towards another point.
struct KnownPlace {
  Point place;
  Point towards;
  bool is_inside;
};

class Coverage {
 public:
  // `operands` has 0 or 1 for each polygon; `sides` has the polygons of each edge; `whole` lists
  // those that are the whole sphere, which have no sides; `known` has a place for each polygon, or
  // is empty. Where nothing is known, the direction of the sides says what is inside.
  Coverage(const Halfedges& halfedges, const CompressedRows<EdgeOfPolygon>& sides,
           const std::vector<std::uint8_t>& operands, Owners whole,
           std::span<const std::optional<KnownPlace>> known, unsigned threads);

  // Returns the polygons whose rings contradict each other on what is inside. What was decided for
  // them depends on how other polygons divide their sides.
  [[nodiscard]] const std::vector<Index>& contradictory() const { return contradictory_; }

  // Calls visit(h, owners) for each halfedge with the polygons that have its face.
  void visit(const std::function<void(Index, const Owners&)>& visit);

 private:
  // A path from a component of the edges to the next one.
  struct ComponentLink {
    Index node;                    // a node of this component
    Index start;                   // the sector of this node at which the path before ends
    Index first;                   // the sector of this node at which the path to the next begins
    std::vector<Index> crossings;  // the edges that it crosses
  };

  void link_components(unsigned threads);
  // The sector in which the way to a known place begins, and whether the polygon has the sector.
  struct KnownSector {
    Index sector;
    Index polygon;
    bool is_inside;
  };

  void find_insides(std::span<const std::optional<KnownPlace>> known);
  [[nodiscard]] std::vector<Index> decide_by_sides();
  [[nodiscard]] std::vector<std::vector<Index>> edges_of(const std::vector<Index>& polygons) const;
  [[nodiscard]] std::vector<KnownSector> outsides_of(const std::vector<Index>& polygons) const;
  [[nodiscard]] KnownSector sector_at(Index polygon, std::span<const Index> edges,
                                      const KnownPlace& known) const;
  void decide_by_sectors(std::vector<KnownSector> known);
  void begin();
  [[nodiscard]] bool is_inside(Index polygon) const { return places_[polygon] != no_index; }
  void toggle(Index polygon);
  void cross(Index edge);
  void turn(Index node, Index from, Index to);
  template <class Visit>
  void traverse(const Visit& visit);
  template <class Visit>
  void traverse_component(Index start, const Visit& visit);

  const Halfedges& halfedges_;
  const CompressedRows<EdgeOfPolygon>& sides_;
  const std::vector<std::uint8_t>& operands_;
  Owners whole_;
  std::vector<ComponentLink> links_;
  std::vector<std::uint8_t> is_visited_;  // each halfedge, in a traversal
  std::vector<Index> places_;  // of each polygon among the owners; no_index if it is none of them
  std::vector<Index> contradictory_;
  std::vector<std::uint8_t> is_inside_first_;  // each polygon: the same where a traversal begins
  Owners owners_;                              // of the current face
};

}  // namespace rondel::arrangement
