// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/solid_rings.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "system/row_assembly.h"
#include "topology/mesh.h"

namespace rondel::interpolation {
namespace {

// The number of vertices that one thread takes at a time.
constexpr std::size_t stars_per_piece = 4096;

// Returns one corner (a halfedge) of each vertex.
std::vector<topology::Halfedge> corners_of(const PreparedTriangulation& prepared) {
  const topology::Mesh& mesh = prepared.mesh();
  std::vector<topology::Halfedge> corners(prepared.num_vertices());
  for (Index f = 0; f < mesh.num_slots(); ++f) {
    for (unsigned i = 0; i < 3; ++i) corners[mesh[f].vertex[i]] = topology::halfedge(f, i);
  }
  return corners;
}

// The stars of consecutive vertices.
struct StarBlock {
  std::vector<Index> sizes;
  std::vector<Index> ends;
};

// Appends the other ends of the edges of solid faces around a vertex, counterclockwise.
void append_star(const PreparedTriangulation& prepared, topology::Halfedge first,
                 std::vector<Index>& star) {
  const topology::Mesh& mesh = prepared.mesh();
  topology::Halfedge h = first;
  bool is_after_solid = prepared.is_solid(
      topology::face_of(mesh.previous_around(topology::face_of(h), topology::edge_of(h))));
  do {
    const Index f = topology::face_of(h);
    const unsigned corner = topology::edge_of(h);
    const bool is_solid = prepared.is_solid(f);
    if (is_solid || is_after_solid) star.push_back(mesh[f].vertex[topology::next_corner[corner]]);
    is_after_solid = is_solid;
    h = mesh.next_around(f, corner);
  } while (h != first);
}

}  // namespace

SolidStars::SolidStars(const PreparedTriangulation& prepared, unsigned threads) {
  const std::vector<topology::Halfedge> corners = corners_of(prepared);
  const std::size_t n = prepared.num_vertices();
  std::vector<StarBlock> blocks(system::num_pieces(n, stars_per_piece));
  system::parallel_for(threads, n, stars_per_piece, [&](std::size_t begin, std::size_t end) {
    auto& [sizes, ends] = blocks[begin / stars_per_piece];
    sizes.reserve(end - begin);
    ends.reserve(6 * (end - begin) + 6);
    for (std::size_t v = begin; v < end; ++v) {
      const auto size = static_cast<std::ptrdiff_t>(ends.size());
      append_star(prepared, corners[v], ends);
      std::rotate(ends.begin() + size, std::min_element(ends.begin() + size, ends.end()),
                  ends.end());
      sizes.push_back(static_cast<Index>(ends.size() - static_cast<std::size_t>(size)));
    }
  });
  rows_.offsets = system::join_rows(
      threads, n, std::move(blocks),
      [](std::size_t b, const StarBlock&, std::size_t k) { return b * stars_per_piece + k; },
      system::JoinedColumn{&StarBlock::ends, rows_.values});
}

// About every second vertex has been found before, in no order that a processor could predict, so
// the loop has no branch for it.
void SolidRings::add_star(Index v) {
  const std::span<const Index> star = stars_[v];
  if (size_ + star.size() > found_.size()) found_.resize(2 * (size_ + star.size()));
  Index* const found = found_.data();
  std::uint32_t* const times = times_.data();
  const std::uint32_t time = time_;
  std::size_t size = size_;
  for (const Index w : star) {
    found[size] = w;
    size += static_cast<std::size_t>(times[w] != time);
    times[w] = time;
  }
  size_ = size;
}

std::span<const Index> SolidRings::find(Index v, unsigned rings) {
  if (++time_ == 0) {
    std::ranges::fill(times_, 0);
    time_ = 1;
  }
  size_ = 1;
  found_[0] = v;
  times_[v] = time_;
  std::size_t next = 0;
  for (unsigned ring = 0; ring < rings; ++ring) {
    const std::size_t end = size_;
    if (next == end) break;
    for (; next < end; ++next) add_star(found_[next]);
  }
  return std::span(found_).subspan(1, size_ - 1);
}

}  // namespace rondel::interpolation
