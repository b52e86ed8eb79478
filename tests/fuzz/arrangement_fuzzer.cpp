// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// rondel/arrangement.h, rondel/set_operations.h, rondel/geometries.h, rondel/relate.h,
// rondel/buffer.h and rondel/simplify.h: what they promise of any arcs and rings.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/vector.h"
#include "fuzz/fuzz_input.h"
#include "rondel/arrangement.h"
#include "rondel/buffer.h"
#include "rondel/cell_set.h"
#include "rondel/geometries.h"
#include "rondel/predicates.h"
#include "rondel/relate.h"
#include "rondel/set_operations.h"
#include "rondel/simplify.h"

namespace rondel::fuzz {
namespace {

using Ends = std::array<Index, 2>;

// Sites as unit vectors, without coordinates so small that they are refused.
std::vector<Point> unit_vectors_of(std::vector<Point> sites) {
  constexpr double least = 1e-40;
  const auto flushed = [](double x) { return std::abs(x) < least ? 0 : x; };
  for (Point& p : sites) {
    p = normalized(p);
    p = {flushed(p.x), flushed(p.y), flushed(p.z)};
  }
  std::erase_if(sites, [](const Point& p) { return !(std::abs(norm(p) - 1) < 1e-14); });
  return sites;
}

bool are_opposite(const Point& p, const Point& q) { return norm(p + q) < 0x1p-40; }

void test_arrangement(const std::vector<Point>& points, const std::vector<Ends>& arcs) {
  const Arrangement result = arrange(points, arcs, {1});
  require(result.chains.size() == arcs.size(), "a chain for each arc");
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    Index at = no_index;
    for (const Index h : result.chains[i]) {
      require(at == no_index || result.edges[h / 2][h % 2] == at, "chains are connected");
      at = result.edges[h / 2][1 - h % 2];
    }
    require(at != no_index || is_same_site(points[arcs[i][0]], points[arcs[i][1]]), "arcs stay");
  }
  std::vector<Ends> again = result.edges;
  for (Index node = 0; node < result.nodes.size(); ++node) again.push_back({node, node});
  std::ranges::reverse(again);
  const Arrangement same = arrange(result.nodes, again, {1});
  require(same.nodes == result.nodes && same.edges == result.edges, "an arrangement is its own");
}

bool is_equal(const CellRings& a, const CellRings& b) {
  return a.cells == b.cells && a.rings == b.rings && a.corners == b.corners &&
         a.points == b.points && a.whole == b.whole;
}

// Each polygon has a ring of three to six of the points in a row.
CellRings polygons_of(ByteSource& source, const std::vector<Point>& points) {
  CellRings cells;
  cells.points = points;
  std::size_t next = 0;
  while (next + 3 <= points.size()) {
    const std::size_t end = std::min(points.size(), next + 3 + source.below(4));
    std::vector<Index> ring;
    for (; next < end; ++next) ring.push_back(static_cast<Index>(next));
    bool is_usable = true;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      is_usable = is_usable && !are_opposite(points[ring[k]], points[ring[(k + 1) % ring.size()]]);
    }
    if (is_usable) cells.append_ring(ring);
    cells.end_cell();
  }
  return cells;
}

// Each pair is what it is alone.
void test_pairs(const CellRings& a, const CellRings& b) {
  std::vector<std::array<Index, 2>> pairs;
  for (Index k = 0; k < std::min(a.num_cells(), b.num_cells()); ++k) pairs.push_back({k, k});
  const CellRings result = combine_pairs(a, b, pairs, SetOperation::symmetric_difference, {1});
  require(result.num_cells() == pairs.size(), "a cell for each pair");
  require(is_equal(repaired(result, {1}), result), "cells of pairs are valid");
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    CellRings first;
    first.points = a.points;
    first.append_cell(a, k);
    CellRings second;
    second.points = b.points;
    second.append_cell(b, k);
    CellRings alone;
    alone.points = result.points;
    alone.append_cell(result, k);
    require(is_equal(combine(second, first, SetOperation::symmetric_difference, {1}),
                     unite(alone, {1})),
            "a pair is what it is alone");
  }
}

// Sides of the union and of the intersection of valid cells are parts of their sides.
void test_lengths(const CellRings& a, const CellRings& b) {
  const auto length_of = [&](SetOperation operation) {
    return lengths(combine(a, b, operation, {1}))[0];
  };
  require(length_of(SetOperation::unite) + length_of(SetOperation::intersection) <
              lengths(a)[0] + lengths(b)[0] + 1e-9,
          "a union and an intersection have no more sides than their operands");
}

// Cells of results need no search for faults, as long as they are not thinner than rounding.
void test_valid_cells(const CellRings& result) {
  const CellRings cells = CellSet::valid_polygons(result, {1}).given_rings();
  require(is_equal(cells, CellSet::polygons(result, {1}).given_rings()), "results are valid");
}

void test_set_operations(const CellRings& a, const CellRings& b) {
  const CellRings either = combine(a, b, SetOperation::unite, {1});
  require(is_equal(either, combine(b, a, SetOperation::unite, {1})), "the union is symmetric");
  require(is_equal(unite(either, {1}), either), "a union is its own");
  const CellRings both = combine(a, b, SetOperation::intersection, {1});
  require(is_equal(repaired(both, {1}), both), "an intersection is valid");
  test_valid_cells(either);
  test_valid_cells(both);
  const CellRings first = combine(a, b, SetOperation::difference, {1});
  const CellRings none = combine(first, first, SetOperation::difference, {1});
  require(none.rings.size() == 1 && none.whole.empty(), "a region without itself is empty");
  test_lengths(unite(a, {1}), unite(b, {1}));
  test_pairs(a, b);
  const RegionPieces pieces = overlay_pieces(a, b, SetOperation::identity, {1});
  for (std::size_t k = 0; k < pieces.num_pieces(); ++k) {
    require(pieces.cells[k] < a.num_cells(), "pieces are of the first operand");
    require(pieces.regions[k] == no_index || pieces.regions[k] < b.num_cells(), "and the second");
  }
}

void test_relations(const CellRings& a, const CellRings& b) {
  const CellRings one = unite(a, {1});
  const CellRings two = repaired(b, {1});
  const RegionPieces pieces = overlay_pieces(one, b, SetOperation::unite, {1});
  const std::vector<Relation> rows = relate(one, two, {1});
  const std::vector<Relation> columns = relate(two, one, {1});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    require(rows[k] == columns[k].transposed(), "polygons may be exchanged");
    require(rows[k].matches(rows[k].text()), "a relation is its own pattern");
  }
  for (Index k = 0; k < columns.size(); ++k) {
    const std::array<Index, 2> pair = {k, 0};
    require(relate_pairs(two, one, {&pair, 1}, {1})[0] == columns[k], "a pair is what it is alone");
  }
  for (const RelatedPair& pair : related_pairs(one, two, SpatialPredicate::intersects, {1})) {
    require(pair.relation == rows[pair.second], "a join has the relations of pairs");
    require(!pair.relation.is(SpatialPredicate::disjoint), "and none that is disjoint");
  }
  if (pieces.num_pieces() == 0 || b.num_cells() > 1) return;
  for (const RelatedPair& pair :
       related_pairs(pieces.rings, pieces.rings, SpatialPredicate::intersects, {1})) {
    require(pair.relation.matches(pair.first == pair.second ? "T*F**FFF*" : "FF*F*****"),
            "pieces have no interior in common");
  }
}

bool is_equal(const Geometries& a, const Geometries& b) {
  return a.lines == b.lines && is_equal(a.polygons, b.polygons);
}

// Each polygon gets a line of some of the points, or one of them.
Geometries geometries_of(ByteSource& source, const CellRings& polygons,
                         std::span<const Point> points) {
  Geometries made{{}, polygons};
  for (std::size_t c = 0; c < polygons.num_cells(); ++c) {
    std::vector<Point> line;
    for (std::size_t k = points.empty() ? 0 : source.below(4); k > 0; --k) {
      const Point& p = points[source.below(points.size())];
      if (line.empty() || !are_opposite(line.back(), p)) line.push_back(p);
    }
    if (!line.empty()) made.lines.rows.append(line);
    made.lines.end_group();
  }
  return made;
}

bool is_of_one_dimension(const Geometries& geometries, std::size_t g) {
  std::array<bool, 3> has = {};
  for (std::uint64_t i = geometries.lines.offsets[g]; i < geometries.lines.offsets[g + 1]; ++i) {
    has[geometries.lines.rows[i].size() > 1 ? 1 : 0] = true;
  }
  has[2] = geometries.polygons.cells[g] < geometries.polygons.cells[g + 1];
  return has[0] + has[1] + has[2] < 2;
}

// Relations say where places are, as set operations do, if no place has to be rounded.
void test_relations(const Geometries& a, const Geometries& b) {
  for (const Geometries* operand : {&a, &b}) {
    for (std::size_t g = 0; g < operand->size(); ++g) {
      if (!is_of_one_dimension(*operand, g)) return;
    }
  }
  std::vector<RelatedPair> pairs;
  try {
    pairs = related_pairs(a, b, SpatialPredicate::intersects, {1});
  } catch (const InvalidInput&) {  // polygons that are not valid
    return;
  }
  for (const RelatedPair& pair : pairs) {
    const std::array<Index, 2> turned = {pair.second, pair.first};
    require(relate_pairs(b, a, {&turned, 1}, {1})[0] == pair.relation.transposed(),
            "relations can be turned around");
    require(pair.relation.is(SpatialPredicate::intersects), "pairs meet");
  }
  if (a.size() == b.size()) {
    const std::vector<Relation> rows = relate(a, b, {1});
    for (Index i = 0; i < rows.size(); ++i) {
      const bool is_listed = std::ranges::any_of(
          pairs, [&](const RelatedPair& pair) { return pair.first == i && pair.second == i; });
      require(rows[i].is(SpatialPredicate::disjoint) != is_listed, "a join has each pair");
    }
  }
}

void test_geometries(const Geometries& a, const Geometries& b) {
  const auto length_of = [&](SetOperation operation) {
    return lengths(combine(a, b, operation, {1}).lines)[0];
  };
  const Geometries either = combine(a, b, SetOperation::unite, {1});
  require(is_equal(unite(either, {1}), either), "a union of lines is its own");
  if (a.polygons.corners.empty() && b.polygons.corners.empty()) {
    const double all = lengths(either.lines)[0];
    require(std::abs(length_of(SetOperation::intersection) + length_of(SetOperation::difference) -
                     length_of(SetOperation::identity)) <= 1e-12 * (1 + all),
            "lines are divided into what is common and the rest");
  }
  std::vector<std::array<Index, 2>> pairs;
  for (Index k = 0; k < std::min(a.size(), b.size()); ++k) pairs.push_back({k, k});
  const Geometries each = combine_pairs(a, b, pairs, SetOperation::intersection, {1});
  require(each.size() == pairs.size(), "a geometry for each pair");
  const GeometryPieces pieces = overlay_pieces(a, b, SetOperation::identity, {1});
  require(pieces.pieces.size() == pieces.first.size(), "pieces have geometries");
  for (const Index first : pieces.first) require(first < a.size(), "pieces are of the first ones");
  test_relations(a, b);
}

bool is_within(const CellRings& a, const CellRings& b) {
  const CellRings rest = combine(a, b, SetOperation::difference, {1});
  return rest.corners.empty() && rest.whole.empty();
}

void test_buffers(ByteSource& source, const CellRings& polygons, std::span<const Point> points) {
  BufferOptions options;
  options.distance = std::ldexp(3.2, -static_cast<int>(source.below(30)));
  options.tolerance = options.distance / static_cast<double>(3 + source.below(200));
  const CellRings sound = repaired(polygons, {1});
  const CellRings grown = buffered(sound, options, {1});
  require(grown.num_cells() == sound.num_cells(), "a buffer for each polygon");
  require(is_equal(repaired(grown, {1}), grown), "a buffer is valid");
  require(is_within(sound, grown), "a buffer covers its polygon");
  const CellRings disks = buffered(points, options, {1});
  require(disks.num_cells() == points.size(), "a buffer for each point");
  options.distance = -options.distance;
  const CellRings shrunk = buffered(sound, options, {1});
  require(is_equal(repaired(shrunk, {1}), shrunk), "what is left of a polygon is valid");
  require(is_within(shrunk, grown), "and in it");
}

void test_simplification(ByteSource& source, const CellRings& polygons) {
  const CellRings sound = unite(polygons, {1});
  SimplifyOptions options;
  const CellRings same = simplified(sound, options, {1});
  require(same.rings == sound.rings && is_equal(unite(same, {1}), sound),
          "a tolerance of 0 changes nothing");
  options.tolerance = std::ldexp(1.5, -static_cast<int>(source.below(30)));
  options.drop_small = source.below(2) == 1;
  const CellRings fewer = simplified(sound, options, {1});
  require(is_equal(simplified(sound, options, {2}), fewer), "threads change nothing");
  require(options.drop_small || fewer.rings.size() == sound.rings.size(), "no ring vanishes");
  for (std::size_t r = 0; r + 1 < fewer.rings.size(); ++r) {
    require(fewer.corners_of(r).size() >= 3, "rings have three corners");
  }
  require(std::ranges::all_of(fewer.points,
                              [&](const Point& p) {
                                return std::ranges::find(sound.points, p) != sound.points.end();
                              }),
          "corners are corners of the input");
  const CellRings again = unite(fewer, {1});
  require(again.corners.size() == fewer.corners.size() && again.whole == fewer.whole,
          "what is simplified is valid");
}

}  // namespace
}  // namespace rondel::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rondel::fuzz;
  using namespace rondel;
  ByteSource source(data, size);
  require(name_of(static_cast<SetOperation>(source.below(5))).size() > 4, "operations have names");
  const bool are_polygons = source.below(2) == 0;
  const std::size_t limit = next_limit(source, 60);
  const std::vector<Point> points =
      unit_vectors_of(all_sites(source, limit, Scales::near, {.model = Model::projected}));
  if (are_polygons) {
    const std::size_t half = points.size() / 2;
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(half);
    const CellRings a = polygons_of(source, {points.begin(), middle});
    const CellRings b = polygons_of(source, {middle, points.end()});
    test_set_operations(a, b);
    test_geometries(geometries_of(source, a, points), geometries_of(source, b, points));
    CellRings none_of_a;
    CellRings none_of_b;
    while (none_of_a.num_cells() < a.num_cells()) none_of_a.end_cell();
    while (none_of_b.num_cells() < b.num_cells()) none_of_b.end_cell();
    test_geometries(geometries_of(source, none_of_a, points),
                    geometries_of(source, none_of_b, points));
    test_relations(a, b);
    test_simplification(source, a);
    test_buffers(source, a, std::span(points).subspan(half));
    return 0;
  }
  std::vector<std::array<Index, 2>> arcs;
  for (Index i = 0; i + 1 < points.size(); i += 2) {
    if (!are_opposite(points[i], points[i + 1])) arcs.push_back({i, i + 1});
  }
  test_arrangement(points, arcs);
  return 0;
}
