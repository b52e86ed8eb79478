// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The part of the faces between buckets that one rank needs: all that have one of its sites as a
// corner.
//
// Sites, edges and faces are renumbered in the same order, so that those of a rank stay together:
//
//     sites   some of earlier ranks | the rank's open sites | some of later ranks
//     edges   some of earlier ranks | the rank's open edges | some of later ranks
//     faces   those with a corner at the rank's sites, by their owners | neighbors of these
//
// in    all faces between buckets, on the rank that joined them
// out   the part of each rank, as a message
// index open sites, open edges and faces between buckets: of all ranks, or those of a part
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bulk/bucket.h"
#include "distributed/messages.h"

namespace rondel::distributed {

// The first open site and the first open edge of each rank, and the ends.
struct OpenRanges {
  std::vector<Index> sites;
  std::vector<Index> edges;

  [[nodiscard]] std::size_t num_ranks() const { return sites.size() - 1; }
};

// The faces and open edges of a part whose numbers a rank tells another rank, or receives from it.
struct NumberList {
  std::size_t rank = 0;      // the other rank
  std::vector<Index> faces;  // faces between buckets
  std::vector<Index> edges;  // open edges, for the faces on their left
};

// The area of a site of the input.
struct SiteArea {
  std::uint64_t site = 0;
  double area = 0;
};

// The faces between buckets that one rank needs.
struct JoinedPart {
  bulk::JoinedFaces faces;  // neighbors may be faces outside of the part, of which only the number
                            // is known
  Index num_faces = 0;      // including such neighbors
  Index first_site = 0;     // first open site of this rank in the part
  // The first open edge of this rank in the part.
  Index first_edge = 0;
  std::vector<std::uint64_t> site_indices;  // by open site of the part: its index in the input
  std::vector<Point> site_points;           // by open site of the part, if points are kept
  std::vector<NumberList> told;             // numbers that this rank tells others, and
  std::vector<NumberList> asked;            // that it receives from them, in the same order
};

// Appends the part of each rank to its message. `indices` has the input index of each open site of
// all ranks, `points` their points or nothing; if there are points, ranks are told the numbers of
// all faces of their part.
void write_joined_parts(const bulk::JoinedFaces& joined, const OpenRanges& ranges,
                        std::span<const std::uint64_t> indices, std::span<const Point> points,
                        std::span<MessageWriter> messages);

// Reads the part of this rank. `own_indices` and `own_points` belong to this rank's open sites;
// `own_points` is empty if points are not kept.
JoinedPart read_joined_part(MessageReader& reader, std::span<const std::uint64_t> own_indices,
                            std::span<const Point> own_points);

}  // namespace rondel::distributed
