// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Where the walks start. A grid of directions knows a face in the middle of each cell, from which
// most sites have few steps to go, in any order. The others, in cells with many faces or around
// vertices of high degree, are put in spatial order, and each walk starts where the one before has
// ended. A face found depends on no start: so neither on the pieces nor on the threads.
#include "hidden/hidden_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "hidden/direction_grid.h"
#include "hidden/face_walk.h"
#include "order/along_the_curve.h"
#include "system/parallel.h"

namespace rondel::hidden {
namespace {

using predicates::Vector;

constexpr std::size_t grain = 4096;

// What a piece leaves to others, by indices of `hidden`.
struct Left {
  std::vector<Index> far;        // not found within a few steps
  std::vector<Index> at_vertex;  // the ray passes a vertex: in `face`, until its faces are known
};

class FaceFinder {
 public:
  FaceFinder(std::span<const Point> sites, const Point& center, TriangulationArrays& arrays,
             unsigned threads)
      : sites_(sites),
        arrays_(arrays),
        threads_(threads),
        walk_(sites, center, arrays),
        grid_(cells_for(std::min(arrays.hidden.size(), arrays.faces.size()))),
        has_cones_(arrays.hidden.size() > arrays.faces.size() / 4) {
    if (has_cones_) walk_.keep_cones(threads);
    fill_grid();
  }

  void run() {
    std::vector<Left> left(system::num_pieces(arrays_.hidden.size(), grain));
    system::parallel_for(threads_, arrays_.hidden.size(), grain,
                         [&](std::size_t begin, std::size_t end) {
                           Left& mine = left[begin / grain];
                           if (has_cones_) {
                             find_near<true>(begin, end, mine);
                           } else {
                             find_near<false>(begin, end, mine);
                           }
                         });
    std::vector<Index> far;
    for (Left& l : left) {
      far.insert(far.end(), l.far.begin(), l.far.end());
      l.far = {};
    }
    walk_.drop_cones();
    if (!far.empty()) find_far(std::move(far), left);
    find_at_vertices(left);
  }

 private:
  static constexpr Index unlimited = no_index;

  // Some 2.4 cells for each face or hidden site, whatever there is less of.
  static unsigned cells_for(std::size_t size) {
    constexpr double cells_for_each = 0.4;
    const double cells = std::sqrt(cells_for_each * static_cast<double>(size));
    return std::clamp(static_cast<unsigned>(cells), 1U, 256U);
  }

  // A face at a vertex in each cell, or one of the cell next to it, and from there by a walk to the
  // middle. Walks in doubles may go wrong, and they are short, so that needles do not cost much.
  void fill_grid() {
    starts_.assign(grid_.num_cells(), no_index);
    num_faces_.assign(grid_.num_cells(), 0);
    for (Index f = 0; f < arrays_.faces.size(); ++f) {
      if (walk_.is_ghost(f)) continue;
      const Direction d = grid_.direction(walk_.frame().to(sites_[arrays_.faces[f][0]]));
      if (!(d.length > 0)) continue;
      const std::size_t cell = grid_.cell(d);
      starts_[cell] = f;
      if (num_faces_[cell] < many_faces) ++num_faces_[cell];
    }
    Index first_of_row = walk_.first_solid();
    Index* start = starts_.data();
    for (unsigned side = 0; side < 6; ++side) {
      for (unsigned i = 0; i < grid_.cells(); ++i) {
        Index last = first_of_row;
        for (unsigned j = 0; j < grid_.cells(); ++j, ++start) {
          last = walk_.walk_by_guess(*start == no_index ? last : *start,
                                     grid_.point(side, i + 0.5, j + 0.5));
          *start = last;
          if (j == 0) first_of_row = last;
        }
      }
    }
  }

  template <bool uses_cones>
  void find_near(std::size_t begin, std::size_t end, Left& left) {
    constexpr Index few_steps = 16;
    for (auto k = static_cast<Index>(begin); k < end; ++k) {
      const Point& p = sites_[arrays_.hidden[k].site];
      const Vector v = walk_.frame().to(p);
      const Direction d = grid_.direction(v);
      if (!(d.length > 0)) {
        store(k, walk_.walk<uses_cones>(walk_.first_solid(), p, v, 0, unlimited), left);
        continue;
      }
      const std::size_t cell = grid_.cell(d);
      if (num_faces_[cell] == many_faces) {
        left.far.push_back(k);
        continue;
      }
      const auto found = walk_.walk<uses_cones>(starts_[cell], p, v, d.length, few_steps);
      if (found.face == no_index && found.vertex == no_index) {
        left.far.push_back(k);
      } else {
        store(k, found, left);
      }
    }
  }

  void find_far(std::vector<Index> far, std::vector<Left>& left) {
    const auto order = along_the_curve(std::move(far));
    const std::size_t pieces = left.size();
    left.resize(pieces + system::num_pieces(order.size(), grain));
    system::parallel_for(threads_, order.size(), grain, [&](std::size_t begin, std::size_t end) {
      find_along(std::span(order).subspan(begin, end - begin), left[pieces + begin / grain]);
    });
  }

  // The curve of the frame's coordinates, in which flat clouds are round.
  [[nodiscard]] std::vector<Index> along_the_curve(std::vector<Index> far) const {
    constexpr std::size_t many_close = 64;  // fewer have few faces, across which walks are short
    auto data = order::along_the_curve(std::move(far), Model::weighted, {}, threads_,
                                       [this](Index k) { return in_frame(k); });
    for (std::size_t i = 0; i < data.keys.size();) {
      std::size_t end = i + 1;
      while (end < data.keys.size() && data.keys[end] == data.keys[i]) ++end;
      if (end - i > many_close) {
        order::sort_along_the_curve(std::span(data.indices).subspan(i, end - i), [this](Index k) {
          return order::place_key(in_frame(k), Model::weighted, {});
        });
      }
      i = end;
    }
    return std::move(data.indices);
  }

  [[nodiscard]] Point in_frame(Index k) const {
    const Vector v = walk_.frame().to(sites_[arrays_.hidden[k].site]);
    return {v.x, v.y, v.z};
  }

  // Each from where the one before was found, unless that was in another cell.
  void find_along(std::span<const Index> order, Left& left) {
    std::size_t cell = grid_.num_cells();
    Index start = no_index;
    for (const Index k : order) {
      const Point& p = sites_[arrays_.hidden[k].site];
      const Vector v = walk_.frame().to(p);
      const std::size_t next = grid_.cell(grid_.direction(v));
      if (next != cell) start = starts_[next];
      cell = next;
      const auto found = walk_.walk<false>(start, p, v, 0, unlimited);
      start = found.end;
      store(k, found, left);
    }
  }

  void store(Index k, const FaceWalk::Result& found, Left& left) {
    const bool is_at_vertex = found.vertex != no_index;
    arrays_.hidden[k].face = is_at_vertex ? found.vertex : found.face;
    if (is_at_vertex) left.at_vertex.push_back(k);
  }

  void find_at_vertices(std::span<const Left> left) {
    if (std::ranges::all_of(left, [](const Left& l) { return l.at_vertex.empty(); })) return;
    std::vector<Index> first_at(sites_.size(), no_index);
    for (Index f = 0; f < arrays_.faces.size(); ++f) {
      if (walk_.is_ghost(f)) continue;
      for (const Index v : arrays_.faces[f]) first_at[v] = std::min(first_at[v], f);
    }
    for (const Left& l : left) {
      for (const Index k : l.at_vertex) arrays_.hidden[k].face = first_at[arrays_.hidden[k].face];
    }
  }

  // From the middle of a cell with so many faces a walk takes longer than to find a place in the
  // spatial order.
  static constexpr std::uint8_t many_faces = 64;

  std::span<const Point> sites_;
  TriangulationArrays& arrays_;
  unsigned threads_;
  FaceWalk walk_;
  DirectionGrid grid_;
  bool has_cones_;
  std::vector<Index> starts_;            // by cell
  std::vector<std::uint8_t> num_faces_;  // by cell, counted up to many_faces
};

}  // namespace

void assign_hidden_faces(std::span<const Point> sites, const Point& center,
                         TriangulationArrays& arrays, unsigned threads) {
  if (arrays.dimension < 2 || arrays.hidden.empty()) return;
  FaceFinder(sites, center, arrays, threads).run();
}

}  // namespace rondel::hidden
