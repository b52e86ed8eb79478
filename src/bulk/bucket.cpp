// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "bulk/bucket.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bulk/stitch.h"
#include "bulk/triangulate.h"
#include "predicates/rung.h"
#include "system/parallel.h"

namespace rondel::bulk {
namespace {

// The squares above buckets: a square is one of them, or has some of them in it.
class SquaresAbove {
 public:
  explicit SquaresAbove(std::span<const OpenBucket> buckets) : buckets_(buckets) {
    for (unsigned face = 0; face < 6; ++face) add({{face, 0, 0}, order::position_bits, 0});
  }

  [[nodiscard]] const std::vector<TreeSquare>& squares() const { return squares_; }

 private:
  [[nodiscard]] bool is_next_in(const Square& square) const {
    if (next_ == buckets_.size()) return false;
    const Square& next = buckets_[next_].square;
    return next.corner.face == square.corner.face && next.bits <= square.bits &&
           has(square, next.corner);
  }

  Index add(const Square& square) {
    if (!is_next_in(square)) return no_index;
    TreeSquare result = {{0, 0, square}};
    if (buckets_[next_].square.bits == square.bits) {
      result.num_sites = buckets_[next_++].num_sites;
    } else {
      for (unsigned rank = 0; rank < 4; ++rank) {
        const Index quarter = add(quadrant(square, rank));
        result.quarters[rank] = quarter;
        if (quarter == no_index) continue;
        result.height = std::max(result.height, squares_[quarter].height + 1);
        result.num_sites += squares_[quarter].num_sites;
      }
    }
    squares_.push_back(result);
    return static_cast<Index>(squares_.size() - 1);
  }

  std::span<const OpenBucket> buckets_;
  std::size_t next_ = 0;
  std::vector<TreeSquare> squares_;
};

// Lists the faces of `seam` that belong to the result, by their owners.
void list_joined(const SeamFaces& seam, std::span<const Triple> at_edges, JoinedFaces& joined) {
  const auto num_sites = static_cast<Index>(seam.sites().size());
  const Index first = seam.names_begin();
  const std::span<const Index> all = seam.owned_by(0, num_sites);
  std::vector<Index> new_name(seam.names_end() - first, no_index);
  for (Index f = 0; f < all.size(); ++f) new_name[all[f] - first] = first + f;
  joined.owned_begin.push_back(0);
  for (Index s = 0; s < num_sites; ++s) {
    joined.owned_begin.push_back(joined.owned_begin.back() +
                                 static_cast<Index>(seam.owned_by(s).size()));
  }
  const auto named = [&](Index f) { return f < first ? f : new_name[f - first]; };
  for (const Index f : all) {
    const Triple& n = seam.neighbors(f);
    joined.faces.push_back(seam.seam_corners(f));
    joined.neighbors.push_back({named(n[0]), named(n[1]), named(n[2])});
  }
  for (const Triple& at_edge : at_edges) joined.across.push_back(named(at_edge[0]) - first);
  for (const Index f : seam.ghost_faces()) joined.ghost_faces.push_back(named(f) - first);
  std::ranges::sort(joined.ghost_faces);
}

// Lists the faces at open sites, and names what is across open edges.
void make_border(std::span<const Triple> faces, std::span<Triple> neighbors, std::size_t num_sites,
                 BucketBorder& border) {
  border.num_faces = static_cast<Index>(faces.size());
  for (Index i = 0; i < border.open_edges.size(); ++i) {
    const SeamEdge& edge = border.open_edges[i];
    neighbors[edge.face][edge.corner] = border.num_faces + i;
  }
  std::vector<bool> is_open(num_sites, false);
  for (const SeamSite& site : border.open_sites) is_open[site.rank] = true;
  for (Index f = 0; f < faces.size(); ++f) {
    const Triple& v = faces[f];
    if (!is_open[v[0]] && !is_open[v[1]] && !is_open[v[2]]) continue;
    border.rim.push_back(f);
    border.rim_corners.push_back(v);
    border.rim_neighbors.push_back(neighbors[f]);
  }
}

}  // namespace

Bucket triangulate_bucket(std::span<const Point> sites, const Square& square, const AllSites& all,
                          const system::Job& options, std::size_t max_block_sites,
                          const SeamRule& rule) {
  Bucket bucket;
  TriangulationArrays arrays;
  if (sites.size() >= min_copied_sites) arrays.faces.resize(2 * sites.size());
  const system::SiteCopies copies{std::span(arrays.faces)};
  bucket.order = order::spatial_order(sites, options.model, options.sphere.center, options.threads,
                                      {}, copies);
  const Input input = {sites, bucket.order.order, options, copies, all.extent()};
  const auto squares = make_squares(square, input, max_block_sites);
  const auto results = triangulate_blocks(input, blocks_of(squares), arrays);
  for (const BlockResult& block : results) predicates::add(bucket.tally, block.tally);
  const unsigned threads = system::num_threads(options.threads);
  SeamFaces seam(results, {arrays.faces, arrays.neighbors}, threads);
  OpenSeam open = fill_square_seam(input, squares, results, rule, seam, bucket.tally);
  if (all.surround_center()) {
    for (const Index s : open.hidden) bucket.hidden.push_back(seam.sites()[s].rank);
  } else {
    add_hidden(open);
  }
  std::vector<Index> ranks(input.order.size());
  std::iota(ranks.begin(), ranks.end(), Index{0});
  bucket.border.open_sites = stitch_open(results, seam, ranks, threads, open, arrays);
  bucket.faces = std::move(arrays.faces);
  bucket.neighbors = std::move(arrays.neighbors);
  bucket.border.open_edges = std::move(open.edges);
  bucket.border.hidden = std::move(open.undecided);
  make_border(bucket.faces, bucket.neighbors, ranks.size(), bucket.border);
  return bucket;
}

std::optional<JoinedFaces> join_buckets(std::span<const OpenBucket> buckets, const AllSites& all,
                                        const system::Job& options, const SeamRule& rule) {
  std::vector<BlockResult> results(buckets.size());
  std::vector<Point> points;
  Index num_edges = 0;
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    for (const Point& p : buckets[i].points) {
      results[i].seam_sites.push_back({static_cast<Index>(points.size()), 0, 0});
      points.push_back(p);
    }
    for (const SeamEdge& edge : buckets[i].open_edges)
      results[i].seam_edges.push_back({edge.a, edge.b, num_edges++, 0});
    results[i].hidden = buckets[i].hidden;
  }
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), Index{0});
  const Input input = {points, order, options, {}, all.extent()};
  // Each open edge stands for the face on its left.
  std::vector<Triple> corners(num_edges);
  std::vector<Triple> neighbors(num_edges, {no_index, no_index, no_index});
  SeamFaces seam(results, {corners, neighbors}, system::num_threads(options.threads));
  JoinedFaces joined;
  const SquaresAbove above(buckets);
  if (!fill_seam(input, above.squares(), results, rule, seam, joined.tally)) return std::nullopt;
  joined.num_edges = num_edges;
  list_joined(seam, neighbors, joined);
  return joined;
}

}  // namespace rondel::bulk
