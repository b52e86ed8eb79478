// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Of the faces between buckets, those that one rank needs: all that have one of its sites as a corner.
//
// Sites, edges and faces are numbered anew, in the same order, so that those of a rank stay together:
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

// Where the open sites and open edges of each rank begin, and behind the last one.
struct OpenRanges {
  std::vector<Index> sites;
  std::vector<Index> edges;

  [[nodiscard]] std::size_t num_ranks() const { return sites.size() - 1; }
};

// Faces and open edges of a part whose numbers a rank tells another one, or is told.
struct NumberList {
  std::size_t rank = 0;      // the other one
  std::vector<Index> faces;  // between buckets
  std::vector<Index> edges;  // faces on the left of open edges
};

// Of a site in the input.
struct SiteArea {
  std::uint64_t site = 0;
  double area = 0;
};

struct JoinedPart {
  bulk::JoinedFaces faces;  // of the part; neighbors may be faces of which there is nothing else
  Index num_faces = 0;      // these counted, too
  Index first_site = 0;     // of this rank's
  Index first_edge = 0;
  std::vector<std::uint64_t> site_indices;  // in the input, by open site of the part
  std::vector<Point> site_points;           // theirs, if they are kept
  std::vector<NumberList> told;             // what this rank gives to others,
  std::vector<NumberList> asked;            // and gets from them, in the same order
};

// Writes each rank's part behind what its message has. `indices` are those of all open sites in the input,
// `points` theirs, or none; if there are some, ranks are told the numbers of all faces of their part.
void write_joined_parts(const bulk::JoinedFaces& joined, const OpenRanges& ranges,
                        std::span<const std::uint64_t> indices, std::span<const Point> points,
                        std::span<MessageWriter> messages);

// `own_indices` and `own_points` are those of this rank's open sites; no points, if none are kept.
JoinedPart read_joined_part(MessageReader& reader, std::span<const std::uint64_t> own_indices,
                            std::span<const Point> own_points);

}  // namespace rondel::distributed
