// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces that did not change are in order already. Those that changed come behind them, owner by
// owner; then the faces of an owner that has some that changed, or had some, are put in order by a
// walk around it.

#include "constrained/constrained_order.h"

#include <algorithm>
#include <utility>

#include "system/large_arrays.h"
#include "system/parallel.h"
#include "topology/mesh.h"

namespace rondel::constrained {
namespace {

using topology::next_corner;

// Faces that start with their owners.
class FaceOrder {
 public:
  explicit FaceOrder(const FacesToOrder& all)
      : all_(all), order_(all.faces.size() + 1), place_(all.faces.size()) {}

  void run() {
    list_changed();
    const std::span<const Triple> faces = all_.faces;
    std::size_t end = 0;
    std::size_t f = 0;
    for (Index v = 0; v < all_.names.size(); ++v) {
      const std::size_t begin = end;
      for (; f < faces.size(); ++f) {
        const bool is_old = !all_.is_changed(f);
        if (is_old && faces[f][0] != v) break;
        // What is left out is overwritten: nothing predicts a branch here.
        order_[end] = static_cast<Index>(f);
        end += is_old ? 1 : 0;
      }
      for (Index g = changed_[v]; g != no_index; g = place_[g]) order_[end++] = g;
      const std::span<Index> own = std::span(order_).subspan(begin, end - begin);
      if (own.size() > 1 && all_.is_touched[v] != 0) sort_around(own);
      for (std::size_t i = begin; i < end; ++i) place_[order_[i]] = static_cast<Index>(i);
    }
    order_.pop_back();
  }

  [[nodiscard]] const LargeVector<Index>& order() const { return order_; }
  // The places of the faces in the order.
  [[nodiscard]] const LargeVector<Index>& place() const { return place_; }

 private:
  // Makes the lists of faces that changed; places that are not known yet have the next of a list.
  void list_changed() {
    changed_.assign(all_.names.size(), no_index);
    for (Index f = 0; f < all_.faces.size(); ++f) {
      if (all_.is_changed(f)) place_[f] = std::exchange(changed_[all_.faces[f][0]], f);
    }
  }

  // The face with the earlier second corner comes first, or the solid one if they have the same.
  [[nodiscard]] bool starts_before(Index g, Index h) const {
    const Index v = all_.faces[g][1];
    const Index w = all_.faces[h][1];
    if (v != w) return v < w;
    return all_.is_solid(g) && !all_.is_solid(h);
  }

  // Puts the faces of an owner in order, counterclockwise from the first one.
  void sort_around(std::span<Index> own) const {
    const auto first =
        std::ranges::min_element(own, [this](Index g, Index h) { return starts_before(g, h); });
    std::ranges::iter_swap(own.begin(), first);
    if (own.size() == 2) return;
    Index f = own[0];
    const Index v = all_.faces[f][0];
    unsigned corner = 0;
    for (std::size_t found = 1; found < own.size();) {
      f = all_.neighbors[f][next_corner[corner]];
      const Triple& face = all_.faces[f];
      corner = face[0] == v ? 0 : face[1] == v ? 1 : 2;
      if (corner == 0) own[found++] = f;
    }
  }

  const FacesToOrder& all_;
  LargeVector<Index> order_;
  LargeVector<Index> place_;
  std::vector<Index> changed_;  // by owner: the first face of its list
};

}  // namespace

void write_in_order(const FacesToOrder& all, unsigned threads, TriangulationArrays& arrays,
                    std::vector<std::uint8_t>& sides) {
  FaceOrder faces(all);
  faces.run();
  const LargeVector<Index>& order = faces.order();
  const LargeVector<Index>& place = faces.place();
  arrays.faces.resize(order.size());
  arrays.neighbors.resize(order.size());
  sides.resize(order.size());
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, order.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = order[i];
      for (unsigned j = 0; j < 3; ++j) {
        arrays.faces[i][j] = all.names[all.faces[f][j]];
        arrays.neighbors[i][j] = place[all.neighbors[f][j]];
      }
      sides[i] = all.sides[f];
    }
  });
  for (Index& f : arrays.ghost_faces) f = place[f];
  std::ranges::sort(arrays.ghost_faces);
}

}  // namespace rondel::constrained
