// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The regions of set operations on polygons.
//
// in    the sides of the polygons of two operands, and lines and points
// out   regions: rings of points, and where asked for lines and points beside them
// index polygons: those of A, and after them those of B
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arrangement/coverage.h"
#include "arrangement/region_rule.h"
#include "rondel/arrangement.h"
#include "rondel/cell_rings.h"
#include "rondel/compressed_rows.h"
#include "rondel/error.h"
#include "rondel/set_operations.h"
#include "rondel/types.h"
#include "system/parallel.h"

namespace rondel::arrangement {

// The sides of the polygons of two operands.
struct Sides {
  std::vector<Point> points;
  std::vector<std::array<Index, 2>> arcs;
  std::vector<Index> polygons;         // of each arc; no_index for an arc of a line
  std::vector<std::uint8_t> operands;  // of each polygon
  Owners whole;
  std::vector<std::optional<KnownPlace>> known = {};  // of each polygon, or none
  bool are_mended = false;  // the rings of a polygon do not contradict each other
  // The polygon to whose feature each arc of a line belongs, and no_index for the others; empty if
  // there are no lines. An arc whose ends are the same is a point.
  std::vector<Index> lines = {};

  // Appends the cells of an operand.
  void append(const CellRings& cells, std::uint8_t operand) {
    const auto first_point = static_cast<Index>(points.size());
    points.insert(points.end(), cells.points.begin(), cells.points.end());
    append_cells(cells, 0, cells.num_cells(), operand, [&](Index p) { return first_point + p; });
  }
  // Appends one cell of an operand and the points of its corners alone.
  void append_cell(const CellRings& cells, std::size_t cell, std::uint8_t operand) {
    const auto number = [&](Index p) {
      points.push_back(cells.points[p]);
      return static_cast<Index>(points.size() - 1);
    };
    append_cells(cells, cell, cell + 1, operand, number);
  }
  // Appends a line, or a point, of the feature of a polygon.
  void append_line(std::span<const Point> line, Index feature) {
    const auto first = static_cast<Index>(points.size());
    points.insert(points.end(), line.begin(), line.end());
    for (Index k = 0; k + 1 < line.size() || k == 0; ++k) {
      arcs.push_back({first + k, k + 1 < line.size() ? first + k + 1 : first + k});
    }
    polygons.resize(arcs.size(), no_index);
    lines.resize(arcs.size() - (line.size() > 1 ? line.size() - 1 : 1), no_index);
    lines.resize(arcs.size(), feature);
  }
  // Appends the sides of a polygon that is there already.
  void append_rings(const std::vector<std::vector<Point>>& rings, Index polygon) {
    for (const std::vector<Point>& ring : rings) {
      const auto first = static_cast<Index>(points.size());
      points.insert(points.end(), ring.begin(), ring.end());
      for (Index k = 0; k < ring.size(); ++k) {
        arcs.push_back({first + k, k + 1 < ring.size() ? first + k + 1 : first});
        polygons.push_back(polygon);
      }
    }
  }
  // Returns the polygons that have the whole sphere if there is no edge.
  [[nodiscard]] Owners owners_without_edges() const {
    Owners owners = whole;
    for (std::size_t p = 0; p < known.size(); ++p) {
      if (known[p] && known[p]->is_inside) owners[operands[p]].push_back(static_cast<Index>(p));
    }
    return owners;
  }

 private:
  template <class Number>
  void append_cells(const CellRings& cells, std::size_t begin, std::size_t end,
                    std::uint8_t operand, const Number& number) {
    for (std::size_t c = begin; c < end; ++c) {
      if (cells.is_whole(c)) whole[operand].push_back(static_cast<Index>(operands.size()));
      for (std::uint64_t r = cells.cells[c]; r < cells.cells[c + 1]; ++r) {
        append_ring(cells.corners_of(r), number);
      }
      operands.push_back(operand);
    }
  }
  template <class Number>
  void append_ring(std::span<const Index> ring, const Number& number) {
    if (ring.empty()) return;
    const Index first = number(ring[0]);
    Index from = first;
    for (std::size_t k = 1; k <= ring.size(); ++k) {
      const Index to = k < ring.size() ? number(ring[k]) : first;
      arcs.push_back({from, to});
      polygons.push_back(static_cast<Index>(operands.size()));
      from = to;
    }
  }
};

// A region: its rings of points, or the whole sphere, and its lines. A line of one point is that
// point.
struct Region {
  RegionKey key;
  std::vector<std::vector<Point>> rings;
  bool is_whole = false;
  std::vector<std::vector<Point>> lines = {};
};

// Which parts regions have: areas alone, or lines and points, too.
enum class RegionParts : std::uint8_t { areas, all };

// Returns the regions that are not empty, sorted by their keys.
std::vector<Region> regions_of(const Sides& sides, const RegionRule& rule, RegionParts parts,
                               const Execution& execution);

// Returns the one region of a joined result, which may be empty.
Region joined_region(const Sides& sides, SetOperation operation, RegionParts parts,
                     const Execution& execution);

// Returns the sides with some polygons replaced by what they are alone, so that it does not depend
// on the others.
Sides mended(const Sides& sides, const std::vector<Index>& polygons, const Execution& execution);

// Returns a cell for each region. Points are sorted by their coordinates; a ring begins at its
// first point, and the rings of a cell are sorted.
CellRings cells_of(std::span<const Region> regions, unsigned threads);

// Returns a region for each of `count` operations on a few polygons; sides_at(k) returns the sides
// of those of operation k. Throws InvalidInput with the first operation whose sides are refused.
template <class SidesAt>
std::vector<Region> joined_each(std::size_t count, SetOperation operation, RegionParts parts,
                                const Execution& execution, const SidesAt& sides_at) {
  std::vector<Region> regions(count);
  std::vector<std::string> refusals(count);
  constexpr std::size_t grain = 8;
  // A few large operations are divided themselves.
  const unsigned threads = count < 2 * grain ? execution.threads : 1;
  system::parallel_for(execution.threads, count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      try {
        regions[k] = joined_region(sides_at(k), operation, parts,
                                   {.threads = threads, .stop = execution.stop});
      } catch (const InvalidInput& error) {
        refusals[k] = error.what();
      }
    }
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (!refusals[k].empty()) throw InvalidInput(refusals[k], k);
  }
  return regions;
}

}  // namespace rondel::arrangement
