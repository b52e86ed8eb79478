// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The faces are dealt to their owners, which are counted before: those that did not change are in
// order then. The faces of an owner that has some that changed, or had some, are put in order by a walk
// around it.

#include "constrained/constrained_order.h"

#include <algorithm>
#include <utility>

#include "system/large_arrays.h"
#include "system/parallel.h"
#include "system/row_assembly.h"
#include "topology/mesh.h"

namespace rondel::constrained {
namespace {

using topology::next_corner;

// Faces that start with their owners.
class FaceOrder {
 public:
  explicit FaceOrder(const FacesToOrder& all)
      : all_(all), order_(all.faces.size()), place_(all.faces.size()) {}

  void run() {
    const std::vector<Index> offsets = deal();
    for (Index v = 0; v < all_.names.size(); ++v) {
      if (all_.is_touched[v] == 0) continue;
      const std::size_t size = offsets[v + 1] - offsets[v];
      if (size > 1) sort_around(std::span(order_).subspan(offsets[v], size));
    }
    for (Index i = 0; i < order_.size(); ++i) place_[order_[i]] = i;
  }

  [[nodiscard]] const LargeVector<Index>& order() const { return order_; }
  // The places of the faces in the order.
  [[nodiscard]] const LargeVector<Index>& place() const { return place_; }

 private:
  // Puts the faces of each owner next to each other, and returns where they begin.
  std::vector<Index> deal() {
    system::RowPlaces<Index> places(all_.names.size());
    for (const Triple& face : all_.faces) places.count(face[0]);
    places.sum();
    for (Index f = 0; f < all_.faces.size(); ++f) order_[places.place(all_.faces[f][0])] = f;
    return std::move(places).offsets();
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
