// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Traces the borders of the regions between levels, as closed rings and as open lines.
//
// in    a surface of triangles, values at its sites, increasing levels
// out   the border of each region, with the region on the left
// index regions: region k lies between levels k - 1 and k; faces and sites of the surface;
//       pieces, numbered face by face and in a face by region
//
// A border goes along the sides of pieces (contour_pieces.h), with the region to its left. At the
// end of a side it continues with the next side of the same piece; if the region goes on across
// that side, it turns through the pieces around the corner until it reaches a side where it does
// not. So it never leaves the fan of pieces in which it arrived, and the rings of two fans that
// touch in a corner are not mixed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "interpolation/contour_pieces.h"
#include "rondel/compressed_rows.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// The extent of region k: a `band` has levels[k-1] <= f < levels[k]; `from_level_on` has
// levels[k-1] <= f.
enum class RegionKind : std::uint8_t { band, from_level_on };

// The lines or rings of one region, one after the other.
struct TracedLines {
  CompressedRows<Point> lines;
  std::vector<std::uint8_t> is_closed;  // by line: whether it returns to its first point
  std::vector<std::uint64_t>
      component;  // by ring: the number of the connected part of the band that it borders
};

class ContourTracer {
 public:
  ContourTracer(ContourSurface surface, std::span<const double> values,
                std::span<const double> levels, RegionKind kind, const Execution& execution);

  [[nodiscard]] std::size_t num_regions() const { return levels_.size() + 1; }
  // Returns the border of region k, each line once. One thread at a time may trace a region;
  // several threads may trace different regions. lines() leaves out what is the border of the
  // surface too.
  [[nodiscard]] TracedLines lines(std::size_t region);
  // Returns the same with the border of the surface, as closed rings.
  [[nodiscard]] TracedLines rings(std::size_t region);

  // Returns the region that covers the most pieces, if the surface is the whole sphere, and
  // otherwise num_regions(). Defined for bands only.
  [[nodiscard]] std::size_t region_without_border() const;

 private:
  // One side of the piece that a face has in a region.
  struct PieceSide {
    Index face = 0;
    std::size_t side = 0;
    ContourPiece piece{};
  };
  // The kind of a side: `inner` if the region goes on beyond it, `line` if it lies between two
  // regions, `rim` if it is on the border of the surface.
  enum class SideKind : std::uint8_t { inner, line, rim };
  // The content of a face: a `plain` face belongs to one region and has no border in it.
  enum class Content : std::uint8_t { plain, mixed, missing };

  // Returns the values of a region.
  [[nodiscard]] ValueRange range(std::size_t region) const;
  // Sets region_of_ for all sites.
  void find_levels(std::span<const double> values, unsigned threads);
  // Classifies all faces and numbers their pieces.
  void find_pieces(unsigned threads);
  // Sets the content of a face, and the number of regions that have a piece in it.
  void classify(Index face, std::uint64_t& num_pieces);
  // Lists for each region the faces in which it has a border.
  void list_mixed_faces();
  // Finds which pieces are connected, for the component of each ring.
  void connect();
  void connect(std::uint64_t a, std::uint64_t b);
  void connect_plain(Index face);
  void connect_mixed(Index face);
  // Returns the number of the piece that a face has in a region.
  [[nodiscard]] std::uint64_t piece_name(Index face, std::size_t region) const {
    return first_piece_[face] + (region - lowest_[face]);
  }
  // Returns the highest region that has a piece in a face.
  [[nodiscard]] std::size_t highest(Index face) const {
    return lowest_[face] + static_cast<std::size_t>(first_piece_[face + 1] - first_piece_[face]) -
           1;
  }

  // Returns the kind of a side; `range` has the values of the region.
  [[nodiscard]] SideKind kind(const PieceSide& place, const ValueRange& range) const;
  // Moves the place into the face across the side, to the same side as seen there.
  void cross(PieceSide& place, const ValueRange& range) const;
  // Moves the place to the next side of the border.
  void go_on(PieceSide& place, const ValueRange& range) const;
  // Moves the place to the previous side of the border.
  void go_back(PieceSide& place, const ValueRange& range) const;
  // Marks the side as traced; returns true if it was not marked before.
  bool take(const PieceSide& place, std::size_t region);

  // Returns the direction of a corner from the center, as a unit vector.
  [[nodiscard]] Point point(const PieceCorner& corner) const;
  // Returns the direction of a site from the center, or that of the site that represents its place.
  [[nodiscard]] Point direction(Index site) const;

  ContourSurface surface_;
  std::span<const double> levels_;
  RegionKind kind_;
  ValuedFaces faces_;
  std::vector<std::uint32_t> region_of_;    // by site: the number of levels up to its value
  std::vector<Content> content_;            // by face
  std::vector<std::uint32_t> lowest_;       // by face: its lowest region
  std::vector<std::uint64_t> first_piece_;  // by face: the number of its first piece; it has one
                                            // piece in each of its regions
  std::vector<std::uint8_t> taken_;         // by piece: a bit for each traced side
  std::vector<std::uint64_t> part_;         // by piece: a piece of a lower number that it is
                                            // connected with
  std::vector<std::vector<Index>> mixed_faces_;  // by region: the faces with a border in it
};

// Appends the line as lines that visit no point twice: each part between two visits of a point
// becomes a closed line of its own, and what remains is the last line. Loops of fewer than three
// points and lines of fewer than two points are dropped.
void append_simple_lines(std::span<const Point> line, bool is_closed, TracedLines& out);

}  // namespace rondel::interpolation
