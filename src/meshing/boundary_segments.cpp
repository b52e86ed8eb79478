// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Divides the border of triangles into segments: boundary_segments().
//
//      \  T  /      Where triangles meet in a node without a common edge, the walk along the border,
//       \   ^       which has its triangles T to the left, comes back along the same gap G: it goes
//    G   \ /        on with the first edge that leaves the node counterclockwise from the edge on
//         v    G    which it came.
//    ---> / \       A loop that comes back to a node all the same, as two parts of a mesh that touch
//        /   \      there have one gap around them, is divided at the node.
//       /  T  \.
#include <algorithm>
#include <numbers>
#include <string>

#include "exact/vector.h"
#include "map/ring_area.h"
#include "meshing/mesh_border.h"
#include "rondel/error.h"
#include "rondel/predicates.h"
#include "system/arithmetic.h"
#include "system/message_text.h"

namespace rondel::meshing {
namespace {

using mesh::BoundaryKind;
using mesh::BoundarySegment;
using BorderEdge = std::array<Index, 2>;

// True if the direction from v to a comes before that to b, counterclockwise from that to u.
bool comes_before(std::span<const Point> points, Index v, Index u, Index a, Index b) {
  const auto turn = [&](Index from, Index to) {
    return orientation(points[v], points[from], points[to]);
  };
  const Sign of_a = turn(u, a);
  const Sign of_b = turn(u, b);
  if (of_a != of_b) return of_a > of_b;
  return turn(a, b) == Sign::positive;
}

// Follows the edges of a border.
class BorderWalk {
 public:
  BorderWalk(std::span<const Point> points, std::span<const BorderEdge> border)
      : points_(points), edges_(border.begin(), border.end()), is_done_(border.size()) {
    std::ranges::sort(edges_);
  }

  // Returns loops without repeated nodes, each from its lowest node, in the order of these.
  std::vector<std::vector<Index>> loops() {
    std::vector<std::vector<Index>> found;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!is_done_[e]) divide(walk(e), found);
    }
    for (std::vector<Index>& loop : found) {
      std::rotate(loop.begin(), std::ranges::min_element(loop), loop.end());
    }
    std::ranges::sort(found);
    return found;
  }

 private:
  // Returns the nodes of the walk that begins with an edge. It comes back to that edge, unless runs
  // of triangles around a node overlap: then two edges to a node have the same next one.
  std::vector<Index> walk(std::size_t first) {
    std::vector<Index> nodes;
    std::size_t e = first;
    for (; !is_done_[e]; e = next(edges_[e])) {
      is_done_[e] = true;
      nodes.push_back(edges_[e][0]);
    }
    if (e != first) {
      const Index node = edges_[e][0];
      throw InvalidInput("triangles overlap around node " + std::to_string(node), node);
    }
    return nodes;
  }

  // Returns the edge on which the walk leaves the end of `edge`. As many edges leave a node as come
  // to it, since around it each run of triangles has one of both.
  [[nodiscard]] std::size_t next(const BorderEdge& edge) const {
    const auto [u, v] = edge;
    const auto begin = std::ranges::lower_bound(edges_, BorderEdge{v, 0});
    auto best = begin;
    for (auto other = begin + 1; other != edges_.end() && (*other)[0] == v; ++other) {
      if (comes_before(points_, v, u, (*other)[1], (*best)[1])) best = other;
    }
    return static_cast<std::size_t>(best - edges_.begin());
  }

  // Adds the loops of a walk, which ends where it comes back to a node.
  static void divide(const std::vector<Index>& nodes, std::vector<std::vector<Index>>& found) {
    std::vector<Index> sorted(nodes);
    std::ranges::sort(sorted);
    std::vector<std::size_t> places(
        sorted.size());  // of sorted nodes in `open`, from 1; 0: not there
    std::vector<Index> open;
    const auto place_of = [&](Index node) -> std::size_t& {
      return places[static_cast<std::size_t>(std::ranges::lower_bound(sorted, node) -
                                             sorted.begin())];
    };
    for (const Index node : nodes) {
      if (const std::size_t place = place_of(node); place != 0) {
        found.emplace_back(open.begin() + static_cast<std::ptrdiff_t>(place - 1), open.end());
        for (const Index gone : found.back()) place_of(gone) = 0;
        open.resize(place - 1);
      }
      open.push_back(node);
      place_of(node) = open.size();
    }
    found.push_back(std::move(open));
  }

  std::span<const Point> points_;
  std::vector<BorderEdge> edges_;
  std::vector<bool> is_done_;
};

// True if the gap to the right of a loop is at least half of the sphere, up to rounding.
bool is_outer(std::span<const Point> points, const std::vector<Index>& loop) {
  constexpr double tolerance = 4 * std::numbers::pi * 1e-9;
  std::vector<Point> ring;
  ring.reserve(loop.size());
  for (const Index node : loop) ring.push_back(normalized(points[node]));
  const double area = map::area_on_left(ring);
  if (area <= 0) return area <= tolerance - 2 * std::numbers::pi;
  // The sign of the area is right for small rings. A large ring almost without area is a crack.
  const bool is_small =
      std::ranges::all_of(ring, [&](const Point& p) { return norm(p - ring[0]) < 0.1; });
  return is_small || area > tolerance;
}

// Makes segments of loops.
class SegmentMaker {
 public:
  SegmentMaker(std::span<const Point> points,
               const std::optional<std::span<const BorderEdge>>& coast)
      : points_(points), is_all_coast_(!coast) {
    if (!coast) return;
    for (const auto& [a, b] : *coast) coast_.push_back({std::min(a, b), std::max(a, b)});
    std::ranges::sort(coast_);
  }

  void add(const std::vector<Index>& loop) {
    std::vector<bool> is_coast;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      is_coast.push_back(has(loop[k], loop[(k + 1) % loop.size()]));
    }
    const auto change = std::ranges::adjacent_find(is_coast, std::ranges::not_equal_to());
    if (change == is_coast.end()) {
      add_whole(loop, is_coast.front());
    } else {
      add_chains(loop, is_coast, static_cast<std::size_t>(change - is_coast.begin()) + 1);
    }
  }

  std::vector<BoundarySegment> take() {
    std::vector<BoundarySegment> all;
    for (auto& of_kind : segments_) std::ranges::move(of_kind, std::back_inserter(all));
    return all;
  }

 private:
  [[nodiscard]] bool has(Index a, Index b) const {
    return is_all_coast_ ||
           std::ranges::binary_search(coast_, BorderEdge{std::min(a, b), std::max(a, b)});
  }
  void put(BoundaryKind kind, std::vector<Index> nodes) {
    segments_[static_cast<std::size_t>(kind)].push_back({kind, std::move(nodes)});
  }

  // Adds a loop of one kind.
  void add_whole(const std::vector<Index>& loop, bool is_coast) {
    if (is_coast && !is_outer(points_, loop)) return put(BoundaryKind::island, loop);
    const auto half = loop.begin() + static_cast<std::ptrdiff_t>(loop.size() / 2);
    std::vector<Index> rest(half, loop.end());
    rest.push_back(loop.front());
    const BoundaryKind kind = is_coast ? BoundaryKind::land : BoundaryKind::open;
    put(kind, std::vector<Index>(loop.begin(), half + 1));
    put(kind, std::move(rest));
  }

  // Adds the chains of a loop, of which the edge `first` is the first one of a chain.
  void add_chains(const std::vector<Index>& loop, const std::vector<bool>& is_coast,
                  std::size_t first) {
    const std::size_t n = loop.size();
    std::vector<Index> chain = {loop[first]};
    for (std::size_t k = first; k < first + n; ++k) {
      chain.push_back(loop[(k + 1) % n]);
      if (k + 1 < first + n && is_coast[(k + 1) % n] == is_coast[k % n]) continue;
      put(is_coast[k % n] ? BoundaryKind::land : BoundaryKind::open, std::move(chain));
      chain = {loop[(k + 1) % n]};
    }
  }

  std::span<const Point> points_;
  bool is_all_coast_;
  std::vector<BorderEdge> coast_;
  std::array<std::vector<BoundarySegment>, 3> segments_;  // by kind
};

void require_directions(std::span<const Point> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    const bool is_direction =
        std::isfinite(p.x + p.y + p.z) && largest_coordinate(p) <= 0x1p500 && !(p == Point{});
    if (!is_direction) {
      throw InvalidInput("node " + std::to_string(i) + " is at the center, or not finite", i);
    }
  }
}

}  // namespace

std::vector<std::vector<Index>> loops_of(std::span<const Point> points,
                                         std::span<const BorderEdge> border) {
  return BorderWalk(points, border).loops();
}

std::vector<BoundarySegment> segments_of(std::span<const Point> points,
                                         std::span<const BorderEdge> border,
                                         const std::optional<std::span<const BorderEdge>>& coast) {
  SegmentMaker segments(points, coast);
  for (const std::vector<Index>& loop : loops_of(points, border)) segments.add(loop);
  return segments.take();
}

}  // namespace rondel::meshing

namespace rondel::mesh {

std::string_view name_of(BoundaryKind kind) noexcept {
  return system::name_in({"open", "land", "island"}, kind);
}

std::vector<BoundarySegment> boundary_segments(
    std::span<const Point> points, std::span<const Triple> triangles,
    const std::optional<std::span<const std::array<Index, 2>>>& coast) {
  const system::ArithmeticScope arithmetic;
  meshing::require_directions(points);
  return meshing::segments_of(points, meshing::border_of(points.size(), triangles), coast);
}

TriangleMesh triangle_mesh(std::span<const Point> points, std::span<const LonLat> positions,
                           std::span<const Triple> triangles,
                           const std::optional<std::span<const std::array<Index, 2>>>& coast,
                           std::span<const double> depths) {
  const system::ArithmeticScope arithmetic;
  const auto require_number = [&](std::size_t number, const char* what) {
    if (number == 0 || number == points.size()) return;
    throw InvalidInput("there are " + std::to_string(number) + what + " for " +
                       std::to_string(points.size()) + " points");
  };
  require_number(positions.size(), " positions");
  require_number(depths.size(), " depths");
  meshing::require_corners(points.size(), triangles);
  std::vector<Index> numbers(points.size(), no_index);
  for (const Triple& triangle : triangles) {
    for (const Index corner : triangle) numbers[corner] = 0;
  }
  TriangleMesh mesh;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (numbers[i] == no_index) continue;
    numbers[i] = static_cast<Index>(mesh.points.size());
    mesh.points.push_back(points[i]);
    if (!positions.empty()) mesh.positions.push_back(positions[i]);
    if (!depths.empty()) mesh.depths.push_back(depths[i]);
  }
  for (const auto& [a, b, c] : triangles) {
    mesh.triangles.push_back({numbers[a], numbers[b], numbers[c]});
  }
  require_valid(mesh);
  std::vector<std::array<Index, 2>> kept;
  for (const auto& [a, b] : coast.value_or(std::span<const std::array<Index, 2>>())) {
    if (std::max(a, b) >= points.size()) {
      throw InvalidInput("coast " + std::to_string(kept.size()) + " has the node " +
                             std::to_string(std::max(a, b)) + ", and there are " +
                             std::to_string(points.size()) + " points",
                         kept.size());
    }
    kept.push_back({numbers[a], numbers[b]});
  }
  const auto of_mesh =
      coast ? std::optional<std::span<const std::array<Index, 2>>>(kept) : std::nullopt;
  mesh.boundary = boundary_segments(mesh.points, mesh.triangles, of_mesh);
  return mesh;
}

void require_valid(const TriangleMesh& mesh) {
  const system::ArithmeticScope arithmetic;
  const auto fault = meshing::fault_of(mesh);
  if (!fault) return;
  const bool has_index = fault->part != meshing::MeshPart::mesh;
  throw InvalidInput(fault->text, has_index ? fault->index : InvalidInput::no_index);
}

std::vector<Index> pinched_nodes(const TriangleMesh& mesh) {
  std::vector<Index> starts;
  for (const auto& edge : meshing::border_of(mesh.points.size(), mesh.triangles)) {
    starts.push_back(edge[0]);
  }
  std::ranges::sort(starts);
  std::vector<Index> pinched;
  for (std::size_t k = 1; k < starts.size(); ++k) {
    const bool is_new = pinched.empty() || pinched.back() != starts[k];
    if (starts[k] == starts[k - 1] && is_new) pinched.push_back(starts[k]);
  }
  return pinched;
}

}  // namespace rondel::mesh
