// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The borders of regions between levels, as rings and as lines.
//
// A border runs from side to side of pieces (contour_pieces.h), the region to its left. At the end of a
// side it goes on with the next side of the same piece; where that is inside the region, it turns through the
// pieces around the corner until one is not. So it never leaves the fan of pieces in which it
// arrived, and the rings of two fans that touch in a corner do not mix.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "interpolation/contour_pieces.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::interpolation {

// What the regions are: those of region k are levels[k-1] <= f < levels[k], or <= f alone.
enum class RegionKind : std::uint8_t { band, from_level_on };

// Lines or rings of one region.
struct TracedLines {
  std::vector<Point> points;
  std::vector<std::uint64_t> ends;      // of each line, in `points`
  std::vector<std::uint8_t> is_closed;  // of each line
  std::vector<std::uint64_t>
      component;  // of each ring: which connected part of its band it borders
};

class ContourTracer {
 public:
  ContourTracer(const Triangulation& triangulation, std::span<const double> values,
                std::span<const double> levels, RegionKind kind, const Execution& execution);

  [[nodiscard]] std::size_t num_regions() const { return levels_.size() + 1; }
  // The border of region k, each line once: without what is the surface's border too, or with it. One
  // thread for each region.
  [[nodiscard]] TracedLines lines(std::size_t region);
  [[nodiscard]] TracedLines rings(std::size_t region);

  // The region that has most of the surface if this is the whole sphere, and otherwise num_regions().
  // Of bands only.
  [[nodiscard]] std::size_t region_without_border() const;

 private:
  // A side of a face's piece.
  struct PieceSide {
    Index face = 0;
    std::size_t side = 0;
    ContourPiece piece{};
  };
  enum class SideKind : std::uint8_t { inner, line, rim };
  enum class Content : std::uint8_t {
    plain,
    mixed,
    missing
  };  // of a face; plain: no border is in it

  [[nodiscard]] ValueRange range(std::size_t region) const;
  void find_levels(std::span<const double> values, unsigned threads);
  void find_pieces(unsigned threads);
  void classify(Index face, std::uint64_t& num_pieces);
  void list_mixed_faces();
  void connect();
  void connect(std::uint64_t a, std::uint64_t b);
  void connect_plain(Index face);
  void connect_mixed(Index face);
  [[nodiscard]] std::uint64_t piece_name(Index face, std::size_t region) const {
    return first_piece_[face] + (region - lowest_[face]);
  }
  [[nodiscard]] std::size_t highest(Index face) const {
    return lowest_[face] + static_cast<std::size_t>(first_piece_[face + 1] - first_piece_[face]) -
           1;
  }

  [[nodiscard]] SideKind kind(const PieceSide& place, const ValueRange& range) const;
  // Steps into the face across the side, to the same side there.
  void cross(PieceSide& place, const ValueRange& range) const;
  void go_on(PieceSide& place, const ValueRange& range) const;
  void go_back(PieceSide& place, const ValueRange& range) const;
  // Marks the side; whether it was not marked before.
  bool take(const PieceSide& place, std::size_t region);

  [[nodiscard]] Point point(const PieceCorner& corner) const;
  [[nodiscard]] Point direction(Index site) const;

  const Triangulation& triangulation_;
  std::span<const double> levels_;
  RegionKind kind_;
  ValuedFaces faces_;
  std::unordered_map<Index, Index>
      speakers_;  // of a vertex, where another site of its place speaks for it
  std::vector<std::uint32_t> region_of_;    // of each site: the number of levels up to its value
  std::vector<Content> content_;            // of the faces
  std::vector<std::uint32_t> lowest_;       // region of each face
  std::vector<std::uint64_t> first_piece_;  // of each face: a piece for each of its regions
  std::vector<std::uint8_t> taken_;         // of each piece: a bit for each side
  std::vector<std::uint64_t> part_;         // of each piece: the first one that is connected to it
  std::vector<std::vector<Index>> mixed_faces_;  // of each region
};

}  // namespace rondel::interpolation
