// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The lines and points of set operations: edges and nodes that belong to a region, and are not in
// or around a face that does.
//
// in    an arrangement of sides, lines and points, and the owners of each face
// out   for each region lines of nodes, which meet in their ends alone
// index nodes, edges and halfedges as in halfedges.h; owners are polygons, and features of lines,
//       which have the numbers of their polygons
//
// An edge belongs to a polygon if a face beside it does, and a node if an edge at it does: polygons
// are closed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/coverage.h"
#include "arrangement/halfedges.h"
#include "arrangement/region_rule.h"
#include "rondel/arrangement.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::arrangement {

struct Sides;

// A line of a region; one node is a point.
struct KeyedLine {
  RegionKey key;
  std::vector<Index> nodes;
};

class LowerParts {
 public:
  LowerParts(const Arrangement& arranged, const Halfedges& halfedges,
             const CompressedRows<EdgeOfPolygon>& polygons, const Sides& sides,
             const RegionRule& rule, unsigned threads);

  // Takes the owners of the face of a halfedge; once for each halfedge.
  void see(Index h, const Owners& owners);
  // Takes the owners of the only face if there are no edges.
  void see_only_face(const Owners& owners);
  // Returns the lines and points, sorted by their regions. A line goes on through nodes where just
  // two edges of its region meet. It has the direction of more of the edges of A's lines, or of B's
  // if these do not tell, and begins at its lower end otherwise.
  [[nodiscard]] std::vector<KeyedLine> lines();

 private:
  using OwnerRow = std::array<std::span<const Index>, 2>;
  // Rows of owners for each operand, in the order in which they were seen.
  struct OwnerRows {
    std::array<CompressedRows<Index>, 2> rows;
    std::vector<Index> places;  // of each item

    void set(std::size_t item, const Owners& owners);
    [[nodiscard]] OwnerRow operator[](std::size_t item) const {
      return {rows[0][places[item]], rows[1][places[item]]};
    }
  };
  // A line along an edge, or a point at a node.
  struct LineOfItem {
    Index item;
    Index feature;
    int sum;  // how many lines of the feature run from the lower node to the higher one, less others
    friend auto operator<=>(const LineOfItem&, const LineOfItem&) = default;
  };
  // A node without edges that has a point, and the way to it from a node with edges.
  struct LonePoint {
    Index sector;
    Index node;
    std::vector<Index> crossings;  // edges
  };
  struct KeyedEdge {
    RegionKey key;
    Index edge;
    friend auto operator<=>(const KeyedEdge&, const KeyedEdge&) = default;
  };

  void collect_lines();
  void collect_points();
  void find_ways(unsigned threads);
  void append(const LineOfItem& line, Owners& owners) const;
  void join(const OwnerRow& row, Owners& owners) const;
  void keys_of_face(Index h, std::vector<RegionKey>& keys) const;
  void find_edges();
  void find_points(std::vector<KeyedLine>& found);
  void join_edges(std::span<const KeyedEdge> edges, std::vector<KeyedLine>& found) const;
  [[nodiscard]] bool is_backwards(const RegionKey& key, std::span<const Index> chain) const;
  [[nodiscard]] static std::span<const LineOfItem> rows_at(std::span<const LineOfItem> all,
                                                           Index item);

  const Arrangement& arranged_;
  const Halfedges& halfedges_;
  const CompressedRows<EdgeOfPolygon>& polygons_;
  const Sides& sides_;
  const RegionRule& rule_;
  std::vector<LineOfItem> lines_;      // along edges, sorted
  std::vector<LineOfItem> points_;     // at nodes, sorted
  std::vector<LonePoint> lone_;        // sorted by sector
  OwnerRows faces_;                    // of each halfedge
  OwnerRows lone_faces_;               // of each of lone_
  std::vector<KeyedEdge> edges_;       // of the result
  CompressedRows<RegionKey> present_;  // of each edge: the regions that it or a face beside it has
};

}  // namespace rondel::arrangement
