// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/seam_tree.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "bulk/builder_pool.h"
#include "bulk/sphere.h"
#include "bulk/square_seam.h"
#include "bulk/triangulate.h"
#include "models/with_model.h"
#include "predicates/rung.h"
#include "system/parallel.h"

namespace rondel::bulk {
namespace {

// What a square hands up.
struct HandedUp {
  std::vector<Index> sites;     // increasing
  std::vector<SeamEdge> edges;  // between positions in `sites`
  std::vector<Index> hidden;    // the root decides about these
};

// Behind what earlier parts of the same square hand up.
void append(const HandedUp& part, HandedUp& all) {
  const auto offset = static_cast<Index>(all.sites.size());
  all.sites.insert(all.sites.end(), part.sites.begin(), part.sites.end());
  all.hidden.insert(all.hidden.end(), part.hidden.begin(), part.hidden.end());
  for (const SeamEdge& e : part.edges)
    all.edges.push_back({e.a + offset, e.b + offset, e.face, e.corner});
}

// Hands up the sites and edges of a block, whose first seam site is `first`.
HandedUp hand_up(const BlockResult& block, Index first) {
  HandedUp result;
  std::vector<Index> place(block.seam_sites.size(), 0);
  for (const Index i : block.hidden) {
    place[i] = no_index;
    result.hidden.push_back(first + i);
  }
  for (Index i = 0; i < place.size(); ++i) {
    if (place[i] == no_index) continue;
    place[i] = static_cast<Index>(result.sites.size());
    result.sites.push_back(first + i);
  }
  for (const SeamEdge& e : block.seam_edges)
    result.edges.push_back({place[e.a], place[e.b], e.face, e.corner});
  return result;
}

// The points of seam sites, which a vector would set to zeros first.
class SeamPoints {
 public:
  template <class PointOf>
  SeamPoints(std::size_t size, unsigned threads, PointOf point)
      : points_(system::make_large_array<Point>(size)), size_(size) {
    constexpr std::size_t grain = 4096;
    system::parallel_for(threads, size, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) points_[i] = point(i);
    });
  }

  [[nodiscard]] std::span<const Point> all() const { return {points_.get(), size_}; }

 private:
  system::LargeArray<Point> points_;
  std::size_t size_;
};

SeamPoints points_of(const Input& input, const SeamFaces& seam) {
  return {seam.sites().size(), input.options.threads,
          [&](std::size_t i) { return input.point(seam.sites()[i].rank); }};
}

// A square of n uniform sites leaves some 7.3 sqrt(n) of them, so two thirds of those that come in
// would find all of their faces. Nothing is final where it would leave most of its sites.
bool is_worth_it(const TreeSquare& square, const HandedUp& seam, bool is_last) {
  const double num_sites = square.num_sites;
  const auto num_seam_sites = static_cast<double>(seam.sites.size());
  const double least = is_last ? 0 : 22 * std::sqrt(num_sites);
  return num_seam_sites > least && 2 * num_seam_sites < num_sites;
}

// The squares, the lower ones first.
template <models::SphereModel T>
class SeamTree {
 public:
  SeamTree(const Input& input, std::span<const Point> points, std::span<const TreeSquare> squares,
           const SeamRule& rule, SeamFaces& seam)
      : input_(input),
        points_(points),
        squares_(squares),
        rule_(rule),
        seam_(seam),
        handed_up_(squares.size()),
        found_(squares.size()),
        tallies_(squares.size()) {}

  // The last square works although what comes in is little, for those above it, which are elsewhere.
  void finish_last() { has_to_finish_ = true; }

  // Returns what goes up to the sphere.
  HandedUp run(std::span<const BlockResult> results, Tally& tally) {
    enter_blocks(results);
    seam_.reserve();
    unsigned highest = 0;
    for (const TreeSquare& square : squares_) highest = std::max(highest, square.height);
    for (unsigned height = 1; height <= highest; ++height) climb(height);
    for (const Tally& of_square : tallies_) predicates::add(tally, of_square);
    HandedUp all;
    for (std::size_t i = 0; i < squares_.size(); ++i) {
      if (!is_part_[i]) append(handed_up_[i], all);
    }
    return all;
  }

 private:
  void enter_blocks(std::span<const BlockResult> results) {
    is_part_.assign(squares_.size(), false);
    std::vector<Index> blocks;
    for (Index i = 0; i < squares_.size(); ++i) {
      for (const Index quarter : squares_[i].quarters) {
        if (quarter != no_index) is_part_[quarter] = true;
      }
      if (squares_[i].height == 0) blocks.push_back(i);
    }
    system::parallel_for(input_.options.threads, blocks.size(), 1,
                         [&](std::size_t i, std::size_t /*end*/) {
                           handed_up_[blocks[i]] = hand_up(results[i], seam_.first_site(i));
                         });
  }

  // The squares of this height, in parallel. Their new faces get names when their numbers are known.
  void climb(unsigned height) {
    std::vector<Index> level;
    for (Index i = 0; i < squares_.size(); ++i) {
      if (squares_[i].height == height) level.push_back(i);
    }
    const unsigned threads = input_.options.threads;
    system::parallel_for(threads, level.size(), 1,
                         [&](std::size_t i, std::size_t /*end*/) { triangulate(level[i]); });
    std::vector<std::size_t> begin = {0};
    for (const Index i : level) begin.push_back(begin.back() + found_[i].corners.size());
    const Index first = seam_.add(begin.back());
    system::parallel_for(threads, level.size(), 1, [&](std::size_t i, std::size_t /*end*/) {
      write(level[i], first + static_cast<Index>(begin[i]));
    });
  }

  void triangulate(Index square) {
    HandedUp& seam = handed_up_[square];
    for (const Index quarter : squares_[square].quarters) {
      if (quarter != no_index) append(std::exchange(handed_up_[quarter], {}), seam);
    }
    const bool is_last = has_to_finish_ && square + 1 == squares_.size();
    if (!rule_.is_every_square && !is_worth_it(squares_[square], seam, is_last)) return;
    const Input of_square = {points_, seam.sites, input_.options, {}, input_.extent};
    std::vector<FinalEdge> edges;
    edges.reserve(seam.edges.size());
    for (const SeamEdge& e : seam.edges) edges.push_back({e.a, e.b});
    builders_.with_builder(std::make_unique<SquareSeamBuilder<T>>, [&](auto& builder) {
      found_[square] = builder.build(of_square, squares_[square].block.square, edges);
      tallies_[square] = builder.tally();
    });
  }

  // Writes the new faces, which get the names first, first + 1, ..., links them to those that are
  // known, and replaces what came in by what goes up.
  void write(Index square, Index first) {
    SquareSeam& found = found_[square];
    if (found.corners.empty()) return;
    HandedUp& seam = handed_up_[square];
    for (Index f = 0; f < found.corners.size(); ++f) {
      for (unsigned i = 0; i < 3; ++i) {
        seam_.seam_corners(first + f)[i] = seam.sites[found.corners[f][i]];
        const Index neighbor = found.neighbors[f][i];
        seam_.neighbors(first + f)[i] = neighbor == no_index ? no_index : first + neighbor;
      }
    }
    for (const DoneEdge& done : found.done) {
      const SeamEdge& edge = seam.edges[done.edge];
      seam_.neighbors(first + done.face)[done.corner] = edge.face;
      seam_.neighbors(edge.face)[edge.corner] = first + done.face;
    }
    HandedUp up;
    for (std::size_t i = 0; i < found.edges.size(); ++i) {
      const FinalSide& side = found.sides[i];
      const FinalEdge& edge = found.edges[i];
      if (side.edge == no_index) {
        up.edges.push_back({edge.a, edge.b, first + side.face, side.corner});
      } else {
        const SeamEdge& known = seam.edges[side.edge];
        up.edges.push_back({edge.a, edge.b, known.face, known.corner});
      }
    }
    for (const Index v : found.sites) up.sites.push_back(seam.sites[v]);
    for (const Index v : found.hidden) seam.hidden.push_back(seam.sites[v]);
    up.hidden = std::move(seam.hidden);
    seam = std::move(up);
    found = {};
  }

  const Input& input_;
  std::span<const Point> points_;  // of the seam sites
  std::span<const TreeSquare> squares_;
  const SeamRule& rule_;
  SeamFaces& seam_;
  std::vector<HandedUp> handed_up_;  // by square
  std::vector<SquareSeam> found_;    // by square
  std::vector<Tally> tallies_;       // by square
  std::vector<bool> is_part_;        // by square: of a larger one
  bool has_to_finish_ = false;
  BuilderPool<SquareSeamBuilder<T>> builders_;
};

// What all blocks hand up, hidden sites with the others: all seam sites.
std::vector<SeamEdge> edges_of(std::span<const BlockResult> results, const SeamFaces& seam) {
  std::vector<SeamEdge> edges;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Index first = seam.first_site(i);
    for (const SeamEdge& e : results[i].seam_edges)
      edges.push_back({e.a + first, e.b + first, e.face, e.corner});
  }
  return edges;
}

// Adds what is hidden to the other sites, in their order.
void add_hidden(HandedUp& root) {
  const std::size_t num_sites = root.sites.size();
  std::vector<Index> before = root.sites;
  root.sites.insert(root.sites.end(), root.hidden.begin(), root.hidden.end());
  std::ranges::sort(root.sites);
  std::vector<Index> place(num_sites);
  for (std::size_t i = 0, j = 0; i < num_sites; ++j) {
    if (root.sites[j] == before[i]) place[i++] = static_cast<Index>(j);
  }
  for (SeamEdge& e : root.edges) {
    e.a = place[e.a];
    e.b = place[e.b];
  }
}

// Over the whole sphere. Most of these sites lie along borders of squares, so blocks would not help;
// their mesh is small beside the result, of so many sites.
kernel::Triangulated triangulate_sites(const Input& input, SeamPoints seam_points, double num_all) {
  const std::span<const Point> points = seam_points.all();
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  system::Job options = input.options;
  options.progress = {};
  kernel::Triangulated result;
  if (2 * static_cast<double>(points.size()) >= num_all) {
    result = kernel::triangulate(points, std::move(order), {}, options);
  } else {
    const auto most = std::max(default_max_sphere_sites, static_cast<std::size_t>(num_all / 8));
    result = triangulate(points, std::move(order), {}, options, {}, most);
  }
  result.arrays.num_sites = points.size();
  return result;
}

// What came up, or all seam sites if the root lists none.
bool fill_sphere(const Input& input, SeamPoints points, double num_all, HandedUp root,
                 SeamFaces& seam, Tally& tally) {
  kernel::Triangulated sphere = triangulate_sites(input, std::move(points), num_all);
  if (sphere.arrays.dimension < 2) return false;
  predicates::add(tally, sphere.tally);
  return seam.fill(std::move(sphere.arrays), root.sites, std::move(root.edges),
                   system::num_threads(input.options.threads));
}

}  // namespace

bool fill_seam_at_once(const Input& input, std::span<const BlockResult> results, SeamFaces& seam,
                       Tally& tally) {
  const auto num_all = static_cast<double>(input.order.size());
  HandedUp root;
  root.edges = edges_of(results, seam);
  return fill_sphere(input, points_of(input, seam), num_all, std::move(root), seam, tally);
}

bool fill_seam(const Input& input, std::span<const TreeSquare> squares,
               std::span<const BlockResult> results, const SeamRule& rule, SeamFaces& seam,
               Tally& tally) {
  if (seam.sites().size() < rule.min_sites) {
    return fill_seam_at_once(input, results, seam, tally);
  }
  double num_all = 0;
  for (const TreeSquare& square : squares) {
    if (square.height == 0) num_all += square.num_sites;
  }
  SeamPoints points = points_of(input, seam);
  HandedUp root = models::with_model(input.options.model, [&]<class T> {
    return SeamTree<T>(input, points.all(), squares, rule, seam).run(results, tally);
  });
  // If the center is inside the hull what is hidden in a square is hidden.
  if (!surround_center(points.all(), input.center())) add_hidden(root);
  points = SeamPoints(root.sites.size(), input.options.threads,
                      [all = points.all(), &root](std::size_t i) { return all[root.sites[i]]; });
  return fill_sphere(input, std::move(points), num_all, std::move(root), seam, tally);
}

OpenSeam fill_square_seam(const Input& input, std::span<const TreeSquare> squares,
                          std::span<const BlockResult> results, const SeamRule& rule,
                          SeamFaces& seam, Tally& tally) {
  const SeamPoints points = points_of(input, seam);
  HandedUp up = models::with_model(input.options.model, [&]<class T> {
    SeamTree<T> tree(input, points.all(), squares, rule, seam);
    tree.finish_last();
    return tree.run(results, tally);
  });
  seam.leave_open(system::num_threads(input.options.threads));
  std::ranges::sort(up.hidden);
  return {std::move(up.sites), std::move(up.edges), std::move(up.hidden), {}};
}

void add_hidden(OpenSeam& open) {
  HandedUp up = {std::move(open.seam_sites), std::move(open.edges), std::move(open.hidden)};
  add_hidden(up);
  open = {std::move(up.sites), std::move(up.edges), {}, {}};
  for (const Index s : up.hidden) {
    const auto place = std::ranges::lower_bound(open.seam_sites, s) - open.seam_sites.begin();
    open.undecided.push_back(static_cast<Index>(place));
  }
}

}  // namespace rondel::bulk
