// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Between the places where they meet sides of the other geometry, arcs run inside of it, outside,
// or along its sides. Which of these occur is seen at the nodes where they meet, and where arcs
// cross without a node both occur. Arcs that meet nothing are inside or outside as their nodes are.
#include "arrangement/line_relater.h"

#include <algorithm>

namespace rondel::arrangement {
namespace {

// The rows and columns of a matrix.
enum RelatedPart : std::size_t { interior, boundary, exterior };

// Raises an entry to a dimension that occurs.
void raise(Relation& relation, RelatedPart of_a, RelatedPart of_b, char dimension) {
  char& entry = relation.matrix[3 * of_a + of_b];
  if (entry == 'F' || entry < dimension) entry = dimension;
}

}  // namespace

Relation LineRelater::relate(PointNodes a, PointNodes b) {
  Relation relation;
  for (const Index node : a) {
    raise(relation, interior, std::ranges::binary_search(b, node) ? interior : exterior, '0');
  }
  if (!std::ranges::includes(a, b)) raise(relation, exterior, interior, '0');
  return relation;
}

Relation LineRelater::relate(PointNodes a, const PreparedLines& b) {
  Relation relation;
  for (const Index node : a) {
    const RelatedPart part = !b.is_on_side(node)    ? exterior
                             : b.has_boundary(node) ? boundary
                                                    : interior;
    raise(relation, interior, part, '0');
  }
  if (!b.sides().empty()) raise(relation, exterior, interior, '1');
  if (!std::ranges::includes(a, b.boundary())) raise(relation, exterior, boundary, '0');
  return relation;
}

Relation LineRelater::relate(PointNodes a, const PreparedPolygon& b) const {
  Relation relation;
  for (const Index node : a) {
    const RelatedPart part = b.is_on_side(node)                ? boundary
                             : b.has(meetings_.points()[node]) ? interior
                                                               : exterior;
    raise(relation, interior, part, '0');
  }
  if (!b.is_empty()) raise(relation, exterior, interior, '2');
  if (!b.sides().empty()) raise(relation, exterior, boundary, '1');
  if (b.is_whole()) relation.matrix[8] = 'F';
  return relation;
}

Relation LineRelater::relate(const PreparedLines& a, const PreparedLines& b) {
  Relation relation;
  meetings_.find(a, b);
  if (meetings_.has_crossings()) raise(relation, interior, interior, '0');
  if (meetings_.has_overlaps()) raise(relation, interior, interior, '1');
  std::vector<Index> nodes;
  meetings_.visit_nodes([&](Index node, const auto& /*directions*/) {
    nodes.push_back(node);
    raise(relation, a.has_boundary(node) ? boundary : interior,
          b.has_boundary(node) ? boundary : interior, '0');
  });
  if (!meetings_.is_covered(0)) raise(relation, interior, exterior, '1');
  if (!meetings_.is_covered(1)) raise(relation, exterior, interior, '1');
  if (!std::ranges::includes(nodes, a.boundary())) raise(relation, boundary, exterior, '0');
  if (!std::ranges::includes(nodes, b.boundary())) raise(relation, exterior, boundary, '0');
  return relation;
}

Relation LineRelater::relate(const PreparedLines& a, const PreparedPolygon& b) {
  const std::span<const Point> points = meetings_.points();
  Relation relation;
  meetings_.find(a, b);
  if (meetings_.has_crossings()) {
    raise(relation, interior, interior, '1');
    raise(relation, interior, boundary, '0');
    raise(relation, interior, exterior, '1');
  }
  std::vector<Index> nodes;
  meetings_.visit_nodes([&](Index node, const auto& directions) {
    nodes.push_back(node);
    raise(relation, a.has_boundary(node) ? boundary : interior, boundary, '0');
    for (const SideDirection& direction : directions[0]) {
      const SidePlace place = place_of_side(points, node, direction, directions[1]);
      const RelatedPart part = place == SidePlace::inside    ? interior
                               : place == SidePlace::outside ? exterior
                                                             : boundary;
      raise(relation, interior, part, '1');
    }
  });
  const std::span<const Index> met = meetings_.met_components(0);
  for (Index c = 0; c < a.num_components(); ++c) {
    if (std::ranges::binary_search(met, c)) continue;
    raise(relation, interior, b.has(points[a.side_of(c).from]) ? interior : exterior, '1');
  }
  for (const Index node : a.boundary()) {
    if (std::ranges::binary_search(nodes, node)) continue;
    raise(relation, boundary, b.has(points[node]) ? interior : exterior, '0');
  }
  if (!b.is_empty()) raise(relation, exterior, interior, '2');
  if (!b.sides().empty() && !meetings_.is_covered(1)) raise(relation, exterior, boundary, '1');
  if (b.is_whole()) relation.matrix[8] = 'F';
  return relation;
}

}  // namespace rondel::arrangement
