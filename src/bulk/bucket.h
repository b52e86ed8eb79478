// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A triangulation in buckets: large squares of the curve, which need not be in memory at once. Each one
// is triangulated as far as its faces are final; what is open is joined at last
// (docs/theory/blocks.md, "A tree of seams").
//
// in    the sites of one bucket after the other, then what all of them left open
// out   the faces of each bucket, then those between the buckets
// index ranks and faces of one bucket; open sites and open edges of all buckets, counted through
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bulk/blocks.h"
#include "bulk/input.h"
#include "order/spatial_order.h"
#include "rondel/export.h"

namespace rondel::bulk {

// What must be known of all sites before any bucket is triangulated.
//
// in    the sites, some after the other
// out   how far from the center they are, and on which sides of it; some of them that stand for all
class RONDEL_API AllSites {
 public:
  AllSites() = default;
  explicit AllSites(const system::Job& options);

  void add(std::span<const Point> sites);
  // Adds the sites that `others` has seen.
  void add(const AllSites& others);

  [[nodiscard]] const Extent& extent() const { return extent_; }
  // Before the sites of a piece of the triangulation, they make the piece's circumcenters those of the
  // whole. The scale of weighted sites asks for the one with the largest coordinate (or one of them).
  // The normal of corners in line asks for the first site that is not on some line or plane through the
  // center, so the first three that span space with it come first: the sites before the second one are
  // in line with the first one, those before the third one in a plane with both.
  [[nodiscard]] std::vector<Point> landmarks() const;
  // Whether the center is inside the hull of the sites, told by the octants in which they are: all.
  // What is hidden in a bucket is hidden then.
  [[nodiscard]] bool surround_center() const;

 private:
  void take_larger(const Point& p);
  void take_spanning(const Point& p);

  Model model_ = Model::projected;
  Point center_ = {0, 0, 0};
  Extent extent_;
  Point largest_ = {0, 0, 0};
  std::array<Point, 3> spanning_ = {};  // the first ones, of weighted sites
  std::size_t num_spanning_ = 0;
  unsigned octants_ = 0;
};

// Enough of a bucket to go around its open sites, when its faces are elsewhere.
struct BucketBorder {
  std::vector<SeamSite> open_sites;  // with an open face, or hidden; in increasing order of rank
  std::vector<SeamEdge> open_edges;  // between positions in open_sites: a face of the bucket is on
                                     // the left, opposite to one of its corners
  std::vector<Index> hidden;        // positions in open_sites, increasing: those that may be hidden
  Index num_faces = 0;              // of the bucket
  std::vector<Index> rim;           // the faces at open sites, increasing
  std::vector<Triple> rim_corners;  // theirs
  std::vector<Triple> rim_neighbors;
};

struct Bucket {
  order::SpatialOrder order;
  // The faces. Those of one site are together, and the sites are in their order. The faces of open
  // sites are in no particular order, all others in the canonical one. Corners are ranks; neighbors
  // are faces of the bucket, or across open edge i the number of faces + i.
  LargeVector<Triple> faces;
  LargeVector<Triple> neighbors;
  BucketBorder border;
  std::vector<Index> hidden;  // ranks, increasing: those that are hidden whatever others have
  Tally tally{};
};

// The sites of a square, at least one; `all` is of all sites, in all squares.
RONDEL_API Bucket triangulate_bucket(std::span<const Point> sites, const Square& square,
                                     const AllSites& all, const system::Job& options,
                                     std::size_t max_block_sites = default_max_block_sites,
                                     const SeamRule& rule = {});

// What a bucket leaves to others, with all of its sites counted.
struct OpenBucket {
  Square square;
  double num_sites = 0;
  std::vector<Point> points;         // of the open sites
  std::vector<SeamEdge> open_edges;  // as above
  std::vector<Index> hidden;
};

// The faces between buckets: all that no bucket has.
struct JoinedFaces {
  // Corners are open sites, the lowest one first. The faces that site s owns are
  // owned_begin[s] ... owned_begin[s + 1] - 1, in no particular order.
  std::vector<Triple> faces;
  std::vector<Index> owned_begin;
  // Face f is num_edges + f here, and what is less is the open edge on the other side.
  std::vector<Triple> neighbors;
  Index num_edges = 0;
  std::vector<Index> across;       // by open edge: the face on its right
  std::vector<Index> ghost_faces;  // increasing
  Tally tally{};
};

// The buckets are in the order of the curve. Returns nothing if all open sites lie on one great
// circle.
RONDEL_API std::optional<JoinedFaces> join_buckets(std::span<const OpenBucket> buckets,
                                                   const AllSites& all, const system::Job& options,
                                                   const SeamRule& rule = {});

}  // namespace rondel::bulk
