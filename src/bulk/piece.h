// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A piece of a build: sites in some squares, from coordinates to one merged triangulation. A block is
// a piece of one square (blocks.cpp). The whole sphere is made of pieces of three squares, which are
// merged (sphere.cpp).
//
// in    an Input that lists the sites, and which of them are in which square
// out   a graph of which the outer boundary is known, and the sites that are hidden
// index local sites: 0, 1, ... in the order of that Input
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bulk/closing.h"
#include "bulk/divide.h"
#include "bulk/input.h"
#include "bulk/squares.h"
#include "system/large_arrays.h"

namespace rondel::bulk {

// The arrays of pieces of one Input, one piece behind the other. It is one allocation: glibc keeps
// freed memory in proportion to the largest one, so the next build need not ask the system again.
class PieceMemory {
 public:
  // For so many sites in so many pieces; forgets what there was if it has to grow.
  void reserve(std::size_t num_sites, std::size_t num_pieces = 1);

  [[nodiscard]] SquareCoordinates coordinates() const { return coordinates_; }
  [[nodiscard]] predicates::Vector* directions() const { return directions_; }
  // For a piece with this number, behind pieces that have `first` sites.
  [[nodiscard]] PlaneGraph graph(std::size_t number, Index first, Index num_sites) const {
    return {edges_, num_halfedges_, 6 * std::size_t{first} + 2 * number, num_sites};
  }

 private:
  system::LargeArray<std::byte> memory_;
  SquareCoordinates coordinates_;
  std::byte* edges_ = nullptr;
  std::size_t num_halfedges_ = 0;
  predicates::Vector* directions_ = nullptr;
};

template <models::SphereModel T>
class Piece {
 public:
  using Edge = PlaneGraph::Edge;

  // The sites first ... first + num_sites - 1 of `input`, in this part of the memory.
  void assign(const Input& input, Index first, Index num_sites, const PieceMemory& memory,
              std::size_t number = 0) {
    input_ = &input;
    num_sites_ = num_sites;
    part_ = {};
    directions_ = memory.directions();
    given_ = GivenSites<T>(input, directions_);
    sites_.assign(input, given_, first, num_sites, memory.coordinates());
    graph_ = memory.graph(number, first, num_sites);
  }

  // Triangulates the sites of squares, which have the local sites of these blocks in their order, and
  // merges them: great circles separate the squares. Returns false if this does not work.
  bool solve(std::span<const Block> squares) {
    if (T::model == Model::projected && squares.size() > 1) {
      find_directions(squares.front().begin, squares.back().end);
    }
    Merge<GivenSites<T>> merge(given_, graph_);
    for (const Block& block : squares) {
      if (block.begin == block.end) continue;
      sites_.enter(block.square, block.end - block.begin);
      const auto part = solve_entered(block);
      if (!part) return false;
      part_ = merge.merge(part_, *part, {});
    }
    return !merge.has_failed();
  }

  // Merges this piece and the next one in memory, which a great circle separates. Returns false if
  // this does not work.
  bool merge(const Piece& next) {
    append(next);
    Merge<GivenSites<T>> merge(given_, graph_);
    part_ = merge.merge(part_, next.part_, {});
    return !merge.has_failed();
  }

  // Merges this piece and the next one in memory, which fills the other side of a great circle, to a
  // sphere, see Closing::run. Returns false if this does not work.
  bool close(const Piece& next, const predicates::Vector& normal, const predicates::Vector& along) {
    append(next);
    part_.edge = Closing<T>(given_, graph_).run(part_, next.part_, normal, along);
    return part_.edge != no_index;
  }

  // Lists the sites that no edge connects to the boundary, which are hidden, and deletes their
  // edges. Returns false if the rest is no triangulation.
  bool find_hidden() {
    // A triangulated disc of V vertices, h of them on the boundary, has 3V - 3 - h edges, and a
    // sphere as many as a disc without one of its faces.
    std::size_t boundary = 0;
    Edge e = part_.edge;
    do {
      ++boundary;
      e = graph_.next(e ^ 1);
    } while (e != part_.edge);
    hidden_.clear();
    const auto is_complete = [&] {
      return graph_.num_edges() + 3 + boundary == 3 * (num_sites_ - hidden_.size());
    };
    if (is_complete()) return true;
    hidden_ = remove_unreached(graph_, part_.edge, num_sites_);
    return is_complete();
  }

  [[nodiscard]] PlaneGraph& graph() { return graph_; }
  [[nodiscard]] const SquareSites<T>& sites() const { return sites_; }
  [[nodiscard]] Index num_sites() const { return num_sites_; }
  // An edge with the outer face on its right, if there is one.
  [[nodiscard]] Edge boundary() const { return part_.edge; }
  [[nodiscard]] const std::vector<Index>& hidden() const { return hidden_; }
  [[nodiscard]] Tally tally() const {
    Tally sum = given_.tally();
    predicates::add(sum, sites_.tally());
    return sum;
  }

 private:
  void find_directions(Index begin, Index end) {
    std::array<Point, 128> some;
    for (Index first = begin; first < end; first += some.size()) {
      const Index size = std::min<Index>(some.size(), end - first);
      for (Index i = 0; i < size; ++i) some[i] = input_->point(first + i);
      predicates::directions(std::span(some).first(size), input_->center(), directions_ + first);
    }
  }

  void append(const Piece& next) {
    graph_.append(next.graph_);
    num_sites_ += next.num_sites_;
  }

  // Returns nothing if this does not work.
  std::optional<Part> solve_entered(const Block& block) {
    misplaced_.clear();
    if (!std::ranges::all_of(sites_.doubtful(), [&](Index i) { return correct(i, block.square); }))
      return std::nullopt;
    Divide<T> divide(sites_, misplaced_, *plan_, graph_);
    const Part part = divide.run(block.begin, block.end, block.square.state, block.square.bits - 1);
    if (divide.has_failed()) return std::nullopt;
    return part;
  }

  // Corrects a position that rounding may have changed, and lists the site if it is misplaced.
  // Returns false if positions cannot tell the site from those of other squares.
  bool correct(Index i, const Square& square) {
    const auto is_close = [](std::uint64_t p, std::uint64_t q) {
      return p < q + position_rounding && q < p + position_rounding;
    };
    if (sites_.point(i) == sites_.center()) return false;
    // By p the site has its place in the order. It may be exact, or none if a difference overflows.
    const order::CubePosition p = input_->position(i);
    const order::CubePosition q = order::exact_cube_position(sites_.point(i), sites_.center());
    if (p.face != q.face || q.face != square.corner.face) return false;
    if (!is_close(p.u, q.u) || !is_close(p.v, q.v)) return false;
    sites_.set_position(i, {p.u, p.v});
    const std::uint64_t difference = ((p.u ^ q.u) | (p.v ^ q.v)) >> min_bit;
    if (difference != 0) {
      misplaced_.push_back({i, min_bit + static_cast<int>(std::bit_width(difference)) - 1});
    }
    return true;
  }

  const Input* input_ = nullptr;
  Index num_sites_ = 0;
  predicates::Vector* directions_ = nullptr;
  GivenSites<T> given_;
  SquareSites<T> sites_;
  PlaneGraph graph_;
  std::unique_ptr<LeafPlan> plan_ = std::make_unique<LeafPlan>();
  std::vector<Misplaced> misplaced_;  // of the square that was entered
  Part part_;
  std::vector<Index> hidden_;
};

}  // namespace rondel::bulk
