// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// All graphs of constraints on few sites, more of them with RONDEL_TEST_SCALE above 1. The oracle lists all triangulations of the sites and takes
// the only one that has the constraints and is locally Delaunay elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "rondel/constrained.h"
#include "rondel/delaunay.h"
#include "support/generators.h"
#include "unit/constrained/integer_places.h"

namespace rondel::test::of_constrained_graphs {
namespace {

using Arc = IntegerPlaces::Arc;
using Mask = std::uint64_t;  // of arcs between at most 8 places

Mask bit_of(Index a, Index b) { return Mask{1} << (8 * a + b); }
Mask edge_bit(Index a, Index b) { return bit_of(std::min(a, b), std::max(a, b)); }

// The sides of a mask that has each of them in one direction, in the other one.
Mask reversed(Mask sides) {
  Mask result = 0;
  for (; sides != 0; sides &= sides - 1) {
    const auto bit = static_cast<Index>(std::countr_zero(sides));
    result |= bit_of(bit % 8, bit / 8);
  }
  return result;
}

struct CandidateFace {
  Triple corners;
  Mask sides = 0;    // directed
  Mask edges = 0;    // not directed
  Mask crossed = 0;  // edges that cross one of its sides
};

struct ListedTriangulation {
  std::vector<Triple> faces;  // each from its lowest corner on, sorted
  Mask edges = 0;
  Mask bad = 0;  // edges that are not locally Delaunay
};

// All triangulations of sites, by the definition in docs/theory/constrained.md.
class AllTriangulations {
 public:
  explicit AllTriangulations(const IntegerPlaces& places) : places_(places) {
    list_arcs();
    list_faces();
    if (faces_.empty()) return;
    const IntegerRay start = generic_ray();
    for (const CandidateFace& face : faces_) {
      if (places_.side_of_face(face.corners, start) > 0) add({&face}, face.sides, face.edges);
    }
  }

  [[nodiscard]] const std::vector<ListedTriangulation>& all() const { return all_; }
  // The arcs without a place in their inside.
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
  [[nodiscard]] Mask crossed(const Arc& e) const { return crossed_[8 * e[0] + e[1]]; }

 private:
  void list_arcs() {
    for (Index a = 0; a < places_.size(); ++a) {
      for (Index b = a + 1; b < places_.size(); ++b) {
        if (places_.has_arc({a, b}) && places_.chain({a, b}).size() == 2) arcs_.push_back({a, b});
      }
    }
    for (const auto& [a, b] : arcs_) {
      for (const auto& [c, d] : arcs_) {
        if (places_.do_cross({a, b}, {c, d})) crossed_[8 * a + b] |= edge_bit(c, d);
      }
      if (places_.is_border({a, b})) no_left_ |= bit_of(b, a);
      if (places_.is_border({b, a})) no_left_ |= bit_of(a, b);
    }
  }
  void list_faces() {
    Mask known = 0;
    for (const auto& [a, b] : arcs_) known |= edge_bit(a, b);
    for (const auto& [a, b] : arcs_) {
      for (Index c = a + 1; c < places_.size(); ++c) {
        if ((known & edge_bit(a, c)) == 0 || (known & edge_bit(b, c)) == 0) continue;
        if (places_.orientation(a, b, c) > 0) add_face({a, b, c});
      }
    }
  }
  void add_face(const Triple& corners) {
    CandidateFace face;
    face.corners = corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = corners[i];
      const Index q = corners[(i + 1) % 3];
      face.sides |= bit_of(p, q);
      face.edges |= edge_bit(p, q);
      face.crossed |= crossed({std::min(p, q), std::max(p, q)});
    }
    for (Index v = 0; v < places_.size(); ++v) {
      bool is_in = std::ranges::find(corners, v) == corners.end();
      for (std::size_t i = 0; i < 3; ++i) {
        is_in = is_in && places_.orientation(corners[i], corners[(i + 1) % 3], v) >= 0;
      }
      if (is_in) return;
    }
    faces_.push_back(face);
  }
  // Returns a ray in the inside of some face and in no plane of two places.
  [[nodiscard]] IntegerRay generic_ray() const {
    for (std::int64_t number = 0;; ++number) {
      const IntegerRay ray = places_.inner_ray(faces_.front().corners, number);
      const auto is_apart = [&](const CandidateFace& face) {
        return places_.side_of_face(face.corners, ray) != 0;
      };
      if (std::ranges::all_of(faces_, is_apart)) return ray;
    }
  }
  // Fills the left of the first side whose other face is there, in all ways.
  void add(const std::vector<const CandidateFace*>& chosen, Mask sides, Mask edges) {
    const Mask open = reversed(sides) & ~sides & ~no_left_;
    if (open == 0) {
      finish(chosen, edges);
      return;
    }
    const Mask side = open & (~open + 1);
    for (const CandidateFace& face : faces_) {
      if ((face.sides & side) == 0 || (face.sides & sides) != 0 || (face.crossed & edges) != 0) {
        continue;
      }
      std::vector<const CandidateFace*> more = chosen;
      more.push_back(&face);
      add(more, sides | face.sides, edges | face.edges);
    }
  }
  void finish(const std::vector<const CandidateFace*>& chosen, Mask edges) {
    ListedTriangulation made;
    made.edges = edges;
    std::array<Index, 64> apex{};
    for (const CandidateFace* face : chosen) {
      made.faces.push_back(face->corners);
      for (std::size_t i = 0; i < 3; ++i) {
        const Triple& c = face->corners;
        apex[8 * c[i] + c[(i + 1) % 3]] = c[(i + 2) % 3] + 1;
      }
    }
    for (Mask rest = edges; rest != 0; rest &= rest - 1) {
      const auto bit = static_cast<Index>(std::countr_zero(rest));
      const Index a = bit / 8;
      const Index b = bit % 8;
      const Index left = apex[8 * a + b];
      const Index right = apex[8 * b + a];
      if (left == 0 || right == 0) continue;
      if (places_.is_above(a, b, left - 1, right - 1)) made.bad |= edge_bit(a, b);
    }
    std::ranges::sort(made.faces);
    all_.push_back(std::move(made));
  }

  const IntegerPlaces& places_;
  std::vector<Arc> arcs_;
  std::array<Mask, 64> crossed_{};  // by 8 * low + high
  Mask no_left_ = 0;                // sides that have no face on their left
  std::vector<CandidateFace> faces_;
  std::vector<ListedTriangulation> all_;
};

// Compares the results for all graphs on some sites.
class GraphTrials {
 public:
  explicit GraphTrials(const std::vector<Point>& sites)
      : sites_(sites), places_(sites), oracle_(places_) {
    for (Index a = 0; a < places_.size(); ++a) {
      for (Index b = a + 1; b < places_.size(); ++b) {
        if (!places_.has_arc({a, b})) continue;
        const std::vector<Index> chain = places_.chain({a, b});
        if (chain.size() == 2) continue;
        Mask parts = 0;
        for (std::size_t k = 1; k < chain.size(); ++k) parts |= edge_bit(chain[k - 1], chain[k]);
        long_arcs_.push_back({{a, b}, parts});
      }
    }
  }

  // Returns the number of graphs.
  std::size_t run() {
    extend(0, {}, 0);
    return count_;
  }

 private:
  struct LongArc {
    Arc ends;
    Mask parts;
  };

  // Tries a graph, and all that have more arcs, from the k-th one on.
  void extend(std::size_t k, const std::vector<Arc>& graph, Mask edges) {
    try_graph(graph, edges);
    for (; k < oracle_.arcs().size() && !testing::Test::HasFatalFailure(); ++k) {
      const Arc& arc = oracle_.arcs()[k];
      if ((oracle_.crossed(arc) & edges) != 0) continue;
      std::vector<Arc> more = graph;
      more.push_back(arc);
      extend(k + 1, more, edges | edge_bit(arc[0], arc[1]));
    }
  }
  void try_graph(const std::vector<Arc>& graph, Mask edges) {
    ++count_;
    const ListedTriangulation* found = nullptr;
    for (const ListedTriangulation& t : oracle_.all()) {
      if ((edges & ~t.edges) != 0 || (t.bad & ~edges) != 0) continue;
      ASSERT_EQ(found, nullptr) << "two triangulations are constrained Delaunay";
      found = &t;
    }
    ASSERT_TRUE(found != nullptr || oracle_.all().empty());
    expect_result(graph, edges, found);
    // Arcs over several places, in place of their parts.
    std::vector<Arc> long_ones;
    Mask covered = 0;
    for (const auto& [ends, parts] : long_arcs_) {
      if ((parts & ~edges) != 0) continue;
      long_ones.push_back({ends[1], ends[0]});
      covered |= parts;
    }
    if (long_ones.empty()) return;
    for (const Arc& arc : graph) {
      if ((edge_bit(arc[0], arc[1]) & covered) == 0) long_ones.push_back(arc);
    }
    expect_result(long_ones, edges, found);
  }
  void expect_result(const std::vector<Arc>& graph, Mask edges, const ListedTriangulation* found) {
    std::vector<Arc> constraints;
    for (const auto& [a, b] : graph) constraints.push_back({places_.name(a), places_.name(b)});
    const auto result = constrained_delaunay(sites_, constraints, {}, {.threads = 1});
    Mask listed = 0;
    for (const auto& [a, b] : result.edges) {
      listed |= edge_bit(places_.place(a), places_.place(b));
    }
    ASSERT_EQ(listed, edges);
    if (found == nullptr) {
      ASSERT_LT(result.triangulation.dimension(), 2);
    } else {
      ASSERT_EQ(solid_faces(result.triangulation), found->faces);
    }
  }
  [[nodiscard]] std::vector<Triple> solid_faces(const Triangulation& t) const {
    std::vector<Triple> faces;
    for (Index f = 0; f < t.num_faces(); ++f) {
      if (t.is_ghost(f)) continue;
      Triple face = t.faces()[f];
      for (Index& corner : face) corner = places_.place(corner);
      std::rotate(face.begin(), std::ranges::min_element(face), face.end());
      faces.push_back(face);
    }
    std::ranges::sort(faces);
    return faces;
  }

  std::vector<Point> sites_;
  IntegerPlaces places_;
  AllTriangulations oracle_;
  std::vector<LongArc> long_arcs_;
  std::size_t count_ = 0;
};

std::size_t try_subsets(const std::vector<Point>& all, std::size_t fewest, std::size_t most) {
  std::size_t count = 0;
  for (unsigned set = 0; set < 1U << all.size(); ++set) {
    std::vector<Point> sites;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((set >> i & 1U) != 0) sites.push_back(all[i]);
    }
    if (sites.size() < fewest || sites.size() > most) continue;
    count += GraphTrials(sites).run();
    if (testing::Test::HasFatalFailure()) break;
  }
  return count;
}

TEST(constrained_graphs, all_on_up_to_six_of_a_square_grid) {
  std::vector<Point> grid;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) grid.push_back({1.0 * x, 1.0 * y, 1});
  }
  const std::size_t most = is_shortened() ? 4 : scaled(6) > 6 ? 7 : 6;
  const std::size_t count = try_subsets(grid, 1, most);
  RecordProperty("graphs", static_cast<int>(count));
  EXPECT_GT(count, 1'000U);
}

TEST(constrained_graphs, all_on_up_to_six_of_the_axes_and_diagonals) {
  // Opposite places, great circles with many places, and sets around the center.
  const std::vector<Point> places = {{1, 0, 0},  {0, 1, 0}, {0, 0, 1},   {-1, 0, 0}, {0, -1, 0},
                                     {0, 0, -1}, {1, 1, 1}, {-1, -1, 1}, {1, -1, 0}, {0, 1, -1}};
  const std::size_t count = try_subsets(places, 4, is_shortened() ? 4 : 6);
  RecordProperty("graphs", static_cast<int>(count));
  EXPECT_GT(count, 1'000U);
}

TEST(constrained_graphs, all_on_random_integers_and_duplicates) {
  Random random(11);
  std::size_t count = 0;
  for (std::size_t round = 0; round < scaled(300); ++round) {
    const int extent = 1 + static_cast<int>(round % 3);
    std::vector<Point> sites;
    while (sites.size() < 6) {
      const Point p = {1.0 * random.between(-extent, extent), 1.0 * random.between(-extent, extent),
                       1.0 * random.between(-extent, extent)};
      if (p.x == 0 && p.y == 0 && p.z == 0) continue;
      sites.push_back(p);
      if (random.below(4) == 0) sites.push_back({2 * p.x, 2 * p.y, 2 * p.z});
    }
    count += GraphTrials(sites).run();
    ASSERT_FALSE(HasFatalFailure()) << "round " << round;
  }
  RecordProperty("graphs", static_cast<int>(count));
  EXPECT_GT(count, 0U);
}

}  // namespace
}  // namespace rondel::test::of_constrained_graphs
