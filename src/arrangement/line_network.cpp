// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A node may be removed if everything that passes it comes from one of two nodes and goes on to the
// other one. Ends of lines, single points, and nodes where a line turns back are kept.
#include "arrangement/line_network.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "arrangement/arc_checks.h"
#include "arrangement/numbering.h"
#include "arrangement/ring_arrays.h"
#include "rondel/error.h"
#include "system/row_assembly.h"

namespace rondel::arrangement {
namespace {

using Pair = std::array<Index, 2>;

constexpr Pair unknown = {no_index, 0};
constexpr Pair fixed = {no_index, no_index};

void validate_lines(const FeatureLines& lines) {
  if (!system::are_offsets(lines.offsets, lines.rows.size()) ||
      !system::are_offsets(lines.rows.offsets, lines.rows.values.size())) {
    throw InvalidInput("the arrays of the lines do not fit");
  }
  for (std::size_t f = 0; f < lines.size(); ++f) {
    for (std::uint64_t row = lines.offsets[f]; row < lines.offsets[f + 1]; ++row) {
      validate_line_arcs(lines.rows[row], f);
    }
  }
}

void validate_polygons(const CellRings& cells) {
  validate_rings(cells);
  validate_points(cells.points);
  for (std::size_t r = 0; r + 1 < cells.rings.size(); ++r) {
    const std::span<const Index> ring = cells.corners_of(r);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      validate_ends(cells.points[ring[k]], cells.points[ring[k + 1 == ring.size() ? 0 : k + 1]],
                    cells.rings[r] + k);
    }
  }
}

// Appends a row of nodes without repetitions; those of a closed row may end with its first node.
void append_row(std::span<const Index> nodes, bool is_closed, CompressedRows<Index>& rows) {
  const std::size_t first = rows.values.size();
  for (const Index node : nodes) {
    if (rows.values.size() == first || rows.values.back() != node) rows.values.push_back(node);
  }
  while (is_closed && rows.values.size() > first + 1 && rows.values.back() == rows.values[first]) {
    rows.values.pop_back();
  }
  rows.end_row();
}

// Finds the neighbors of nodes.
class NeighborFinder {
 public:
  explicit NeighborFinder(LineNetwork& network) : neighbors_(network.neighbors) {
    neighbors_.assign(network.points.size(), unknown);
  }
  void fix(Index node) { neighbors_[node] = fixed; }
  // Something passes a node between two others.
  void pass(Index from, Index node, Index to) {
    Pair& known = neighbors_[node];
    if (known == unknown && from != to) {
      known = {from, to};
    } else if (from == to || (known != Pair{from, to} && known != Pair{to, from})) {
      known = fixed;
    }
  }

 private:
  std::vector<Pair>& neighbors_;
};

void find_neighbors(LineNetwork& network, bool keeps_boundary) {
  NeighborFinder finder(network);
  std::vector<std::uint8_t> num_passes(keeps_boundary ? network.points.size() : 0, 0);
  for (std::size_t r = 0; r < network.rings.size(); ++r) {
    const std::span<const Index> ring = network.rings[r];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      finder.pass(ring[k == 0 ? ring.size() - 1 : k - 1], ring[k],
                  ring[k + 1 == ring.size() ? 0 : k + 1]);
      if (keeps_boundary) {
        num_passes[ring[k]] = static_cast<std::uint8_t>(std::min(2, num_passes[ring[k]] + 1));
      }
    }
  }
  for (std::size_t i = 0; i < network.lines.size(); ++i) {
    const std::span<const Index> line = network.lines[i];
    if (line.empty()) continue;
    for (std::size_t k = 1; k + 1 < line.size(); ++k)
      finder.pass(line[k - 1], line[k], line[k + 1]);
    finder.fix(line.front());
    finder.fix(line.back());
  }
  for (Index node = 0; node < num_passes.size(); ++node) {
    if (num_passes[node] == 1) finder.fix(node);
  }
}

}  // namespace

LineNetwork line_network(const FeatureLines& lines, const CellRings& polygons, bool keeps_boundary,
                         unsigned threads) {
  validate_lines(lines);
  validate_polygons(polygons);
  // Points that no ring has are no nodes.
  std::vector<Index> places(polygons.points.size(), no_index);
  std::vector<Point> used;
  for (const Index p : polygons.corners) {
    if (places[p] != no_index) continue;
    places[p] = static_cast<Index>(used.size());
    used.push_back(polygons.points[p]);
  }
  const std::size_t num_of_rings = used.size();
  used.insert(used.end(), lines.rows.values.begin(), lines.rows.values.end());
  NumberedPoints numbered_points = numbered(used, 0, threads);
  const std::vector<Index>& numbers = numbered_points.numbers;

  LineNetwork network;
  std::vector<Index> row;
  for (std::size_t r = 0; r + 1 < polygons.rings.size(); ++r) {
    row.clear();
    for (const Index p : polygons.corners_of(r)) row.push_back(numbers[places[p]]);
    append_row(row, true, network.rings);
  }
  for (std::size_t i = 0; i < lines.rows.size(); ++i) {
    append_row(
        std::span(numbers).subspan(num_of_rings + lines.rows.offsets[i], lines.rows[i].size()),
        false, network.lines);
  }
  network.points = std::move(numbered_points.points);
  find_neighbors(network, keeps_boundary);
  return network;
}

}  // namespace rondel::arrangement
