// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "meshing/mesh_border.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "exact/vector.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/row_assembly.h"

namespace rondel::meshing {
namespace {

std::string numbered(const char* part, std::size_t index, Index base) {
  return std::string(part) + ' ' + std::to_string(index + base);
}

// A side of a triangle in the list of its lower node.
struct MeshSide {
  Index triangle;
  Index other;  // the higher node
  bool is_up;   // true if the triangle has the side from the lower to the higher node
};

// The sides of triangles, in lists by their lower nodes.
class MeshSides {
 public:
  MeshSides(std::size_t num_nodes, std::span<const Triple> triangles)
      : sides_(3 * triangles.size()) {
    system::RowPlaces<> places(num_nodes);
    visit(triangles, [&](Index low, const MeshSide& /*side*/) { places.count(low); });
    places.sum();
    visit(triangles, [&](Index low, const MeshSide& side) { sides_[places.place(low)] = side; });
    offsets_ = std::move(places).offsets();
    for (std::size_t i = 0; i < num_nodes; ++i) {
      std::ranges::sort(sides_.begin() + static_cast<std::ptrdiff_t>(offsets_[i]),
                        sides_.begin() + static_cast<std::ptrdiff_t>(offsets_[i + 1]), {},
                        [](const MeshSide& side) { return std::pair(side.other, side.triangle); });
    }
  }

  // Returns the sides between two nodes, by their triangles.
  [[nodiscard]] std::span<const MeshSide> between(Index low, Index high) const {
    const auto of_low = std::span(sides_).subspan(offsets_[low], offsets_[low + 1] - offsets_[low]);
    const auto begin = std::ranges::lower_bound(of_low, high, {}, &MeshSide::other);
    const auto end =
        std::find_if(begin, of_low.end(), [&](const MeshSide& side) { return side.other != high; });
    return {begin, end};
  }

 private:
  template <class Visit>
  static void visit(std::span<const Triple> triangles, const Visit& visit_side) {
    for (Index t = 0; t < triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = triangles[t][k];
        const Index b = triangles[t][(k + 1) % 3];
        visit_side(std::min(a, b), MeshSide{t, std::max(a, b), a < b});
      }
    }
  }

  std::vector<std::uint64_t> offsets_;
  std::vector<MeshSide> sides_;
};

// Throws InvalidInput if another triangle has the side in the same direction. Of three triangles at
// an edge, two do.
void require_one_direction(std::span<const MeshSide> sides, Index triangle, Index a, Index b,
                           Index base) {
  for (const MeshSide& other : sides) {
    if (other.triangle == triangle || other.is_up != (a < b)) continue;
    throw InvalidInput(numbered("triangle", triangle, base) + " has the edge between nodes " +
                           std::to_string(std::min(a, b) + base) + " and " +
                           std::to_string(std::max(a, b) + base) +
                           " in the direction in which triangle " +
                           std::to_string(other.triangle + base) + " has it",
                       triangle);
  }
}

using Found = std::optional<MeshFault>;

std::string text_of_lengths(const char* what, std::size_t count, std::size_t num_nodes) {
  return "there are " + std::to_string(count) + ' ' + what + " for " + std::to_string(num_nodes) +
         " nodes";
}

// Returns the first fault of the arrays of nodes and levels.
Found fault_of_numbers(const mesh::TriangleMesh& mesh, Index base) {
  const std::size_t n = mesh.points.size();
  if (!mesh.positions.empty() && mesh.positions.size() != n) {
    return MeshFault{.text = text_of_lengths("positions", mesh.positions.size(), n)};
  }
  if (!mesh.depths.empty() && mesh.depths.size() != n) {
    return MeshFault{.text = text_of_lengths("depths", mesh.depths.size(), n)};
  }
  const auto at_node = [&](std::size_t i, const char* what) {
    return MeshFault{MeshPart::node, i, numbered("node", i, base) + what};
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Point& p = mesh.points[i];
    if (!std::isfinite(p.x + p.y + p.z) || largest_coordinate(p) > 0x1p500) {
      return at_node(i, " has coordinates that are not finite, or too large");
    }
    if (p == Point{}) return at_node(i, " is at the center of the sphere");
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto& [lon, lat] = mesh.positions[i];
    if (!std::isfinite(lon) || !(std::abs(lat) <= 90)) {
      return at_node(i, " has no longitude and latitude in degrees");
    }
  }
  for (std::size_t i = 0; i < mesh.depths.size(); ++i) {
    if (!std::isfinite(mesh.depths[i])) return at_node(i, " has a depth that is not finite");
  }
  if (!mesh.levels.empty() && mesh.levels.size() < 3) {
    return MeshFault{.text = "there are " + std::to_string(mesh.levels.size()) +
                             " levels; three are needed, or none"};
  }
  for (std::size_t k = 0; k < mesh.levels.size(); ++k) {
    if (std::isfinite(mesh.levels[k]) && (k == 0 || mesh.levels[k - 1] < mesh.levels[k])) continue;
    return MeshFault{.text = numbered("level", k, base) +
                             " is not finite, or not deeper than the one before"};
  }
  return std::nullopt;
}

// Returns the first fault of the triangles, and the border if there is none.
Found fault_of_triangles(const mesh::TriangleMesh& mesh, Index base,
                         std::vector<std::array<Index, 2>>& border) {
  try {
    require_corners(mesh.points.size(), mesh.triangles, base);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Sign sign = orientation(mesh.points[a], mesh.points[b], mesh.points[c]);
      if (sign == Sign::positive) continue;
      return MeshFault{MeshPart::triangle, t,
                       numbered("triangle", t, base) +
                           (sign == Sign::zero ? " has no area: nodes " : " is clockwise: nodes ") +
                           std::to_string(a + base) + ", " + std::to_string(b + base) + " and " +
                           std::to_string(c + base)};
    }
    border = border_of(mesh.points.size(), mesh.triangles, base);
  } catch (const InvalidInput& error) {
    return MeshFault{MeshPart::triangle, error.index(), error.what()};
  }
  std::vector<bool> is_corner(mesh.points.size());
  for (const Triple& triangle : mesh.triangles) {
    for (const Index corner : triangle) is_corner[corner] = true;
  }
  const auto alone = std::ranges::find(is_corner, false);
  if (alone == is_corner.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(alone - is_corner.begin());
  return MeshFault{MeshPart::node, i, numbered("node", i, base) + " is in no triangle"};
}

// True if a segment has a type that its kind does not have, or that needs no mention.
bool is_type_wrong(const mesh::BoundarySegment& segment) {
  if (!segment.type) return false;
  const std::int32_t type = *segment.type;
  if (type < 0 || type > largest_type || type == usual_type(segment.kind)) return true;
  if (segment.kind == mesh::BoundaryKind::open) return false;
  return is_barrier_type(type) ||
         is_island_type(type) != (segment.kind == mesh::BoundaryKind::island);
}

// Returns what is wrong with the nodes of a segment; an empty text if nothing is.
std::string fault_of_nodes(const mesh::BoundarySegment& segment, std::size_t num_nodes,
                           std::span<const std::array<Index, 2>> sorted, Index base) {
  const bool is_island = segment.kind == mesh::BoundaryKind::island;
  const std::vector<Index>& nodes = segment.nodes;
  if (mesh::name_of(segment.kind).empty()) return " has no kind";
  if (is_type_wrong(segment)) {
    return " has the type " + std::to_string(*segment.type) + ", which is not one of " +
           std::string(mesh::name_of(segment.kind)) + " segments that has to be said";
  }
  if (nodes.size() < (is_island ? 3U : 2U)) {
    return " has " + std::to_string(nodes.size()) + (nodes.size() == 1 ? " node" : " nodes");
  }
  for (std::size_t k = 0; k < nodes.size() - (is_island ? 0 : 1); ++k) {
    const Index a = nodes[k];
    const Index b = nodes[(k + 1) % nodes.size()];
    const Index too_large = std::max(a, b);
    if (too_large >= num_nodes) {
      return " has the node " + std::to_string(std::uint64_t{too_large} + base) + "; there are " +
             std::to_string(num_nodes) + " nodes";
    }
    const std::array<Index, 2> edge = {std::min(a, b), std::max(a, b)};
    if (std::ranges::binary_search(sorted, edge)) continue;
    return ": nodes " + std::to_string(a + base) + " and " + std::to_string(b + base) +
           " are not joined by an edge of the border";
  }
  return "";
}

}  // namespace

void require_corners(std::size_t num_nodes, std::span<const Triple> triangles, Index base) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const Index corner : triangles[t]) {
      if (corner < num_nodes) continue;
      throw InvalidInput(numbered("triangle", t, base) + " has the corner " +
                             std::to_string(std::uint64_t{corner} + base) + "; there are " +
                             std::to_string(num_nodes) + " nodes",
                         t);
    }
  }
}

std::vector<std::array<Index, 2>> border_of(std::size_t num_nodes,
                                            std::span<const Triple> triangles, Index base) {
  require_corners(num_nodes, triangles, base);
  const MeshSides sides(num_nodes, triangles);
  std::vector<std::array<Index, 2>> border;
  for (Index t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangles[t][k];
      const Index b = triangles[t][(k + 1) % 3];
      if (a == b) {
        throw InvalidInput(numbered("triangle", t, base) + " has the corner " +
                               std::to_string(a + base) + " twice",
                           t);
      }
      const std::span<const MeshSide> at_edge = sides.between(std::min(a, b), std::max(a, b));
      require_one_direction(at_edge, t, a, b, base);
      if (at_edge.size() == 1) border.push_back({a, b});
    }
  }
  return border;
}

std::vector<std::array<Index, 2>> undirected(std::vector<std::array<Index, 2>> edges) {
  for (auto& edge : edges) std::ranges::sort(edge);
  std::ranges::sort(edges);
  return edges;
}

std::vector<std::array<Index, 2>> sides_of(std::span<const Triple> triangles) {
  std::vector<std::array<Index, 2>> sides;
  sides.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  return undirected(std::move(sides));
}

Found fault_of(const mesh::TriangleMesh& mesh, Index base) {
  if (Found fault = fault_of_numbers(mesh, base)) return fault;
  std::vector<std::array<Index, 2>> border;
  if (Found fault = fault_of_triangles(mesh, base, border)) return fault;
  border = undirected(std::move(border));
  for (std::size_t s = 0; s < mesh.boundary.size(); ++s) {
    const std::string text = fault_of_nodes(mesh.boundary[s], mesh.points.size(), border, base);
    if (text.empty()) continue;
    return MeshFault{MeshPart::segment, s, numbered("segment", s, base) + text};
  }
  return std::nullopt;
}

}  // namespace rondel::meshing
