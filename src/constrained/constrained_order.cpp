// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces that changed are sorted by their owners and merged with the others. The faces of an owner
// that has some of them, or had some, are then put in order by a walk around it.

#include "constrained/constrained_order.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "order/place_keys.h"
#include "system/parallel.h"
#include "topology/mesh.h"

namespace rondel::constrained {
namespace {

using topology::edge_of;
using topology::face_of;
using topology::halfedge;
using topology::next_corner;

// The order of the vertices along the curve.
class VertexOrder {
 public:
  VertexOrder(const NamedSites& sites, std::size_t num_sites, const Sphere& sphere,
              unsigned threads)
      : sites_(sites), center_(sphere.center), keys_(num_sites) {
    constexpr std::size_t grain = 4096;
    system::parallel_for(threads, num_sites, grain, [&](std::size_t begin, std::size_t end) {
      std::vector<Point> points;
      for (std::size_t v = begin; v < end; ++v)
        points.push_back(sites.point(static_cast<Index>(v)));
      order::place_keys(points, Model::projected, center_,
                        std::span(keys_).subspan(begin, end - begin));
    });
  }

  [[nodiscard]] bool is_before(Index v, Index w) const {
    if (keys_[v] != keys_[w]) return keys_[v] < keys_[w];
    return v != w && full(v) < full(w);
  }

 private:
  [[nodiscard]] std::tuple<std::uint64_t, double, double, double> full(Index v) const {
    const Point& p = sites_.point(v);
    std::array<std::uint64_t, 1> high{};
    std::array<std::uint64_t, 1> low{};
    order::place_keys(std::span(&p, 1), Model::projected, center_, high, low);
    return {low[0], p.x, p.y, p.z};
  }

  const NamedSites& sites_;
  Point center_;
  std::vector<std::uint64_t> keys_;
};

// The faces as halfedges opposite to their owners.
class FaceOrder {
 public:
  FaceOrder(const ConstrainedFaces& all, const NamedSites& sites, const Sphere& sphere,
            unsigned threads)
      : all_(all), vertices_(sites, sites.size(), sphere, threads), is_touched_(sites.size()) {}

  std::vector<Index> run(std::span<const Triple> before) {
    std::vector<Index> made;
    for (Index f = 0; f < before.size(); ++f) {
      if (!all_.is_changed(f)) continue;
      is_touched_[before[f][0]] = true;
      made.push_back(halfedge(f, first_corner(f)));
      is_touched_[owner(made.back())] = true;
    }
    std::ranges::sort(made, [&](Index g, Index h) {
      const Index v = owner(g);
      const Index w = owner(h);
      return v == w ? g < h : vertices_.is_before(v, w);
    });
    merge(made);
    for (std::size_t begin = 0; begin < order_.size();) {
      const Index v = owner(order_[begin]);
      std::size_t end = begin + 1;
      while (end < order_.size() && owner(order_[end]) == v) ++end;
      if (is_touched_[v]) sort_around(std::span(order_).subspan(begin, end - begin));
      begin = end;
    }
    return std::move(order_);
  }

 private:
  [[nodiscard]] Index owner(Index h) const { return all_.faces()[face_of(h)][edge_of(h)]; }
  [[nodiscard]] unsigned first_corner(Index f) const {
    const Triple& v = all_.faces()[f];
    const unsigned i = vertices_.is_before(v[1], v[0]) ? 1 : 0;
    return vertices_.is_before(v[2], v[i]) ? 2 : i;
  }

  // Joins the sorted faces that changed and the others.
  void merge(const std::vector<Index>& made) {
    order_.reserve(all_.faces().size());
    auto next = made.begin();
    for (Index f = 0; f < all_.faces().size(); ++f) {
      if (all_.is_changed(f)) continue;
      const Index h = halfedge(f, 0);
      while (next != made.end() && vertices_.is_before(owner(*next), owner(h))) {
        order_.push_back(*next++);
      }
      order_.push_back(h);
    }
    order_.insert(order_.end(), next, made.end());
  }

  // Of two faces with the same second corner the solid one comes first.
  [[nodiscard]] bool starts_before(Index g, Index h) const {
    const Index v = all_.faces()[face_of(g)][next_corner[edge_of(g)]];
    const Index w = all_.faces()[face_of(h)][next_corner[edge_of(h)]];
    if (v != w) return vertices_.is_before(v, w);
    return all_.is_solid(face_of(g)) && !all_.is_solid(face_of(h));
  }

  void sort_around(std::span<Index> faces) const {
    std::ranges::iter_swap(faces.begin(), std::ranges::min_element(faces, [&](Index g, Index h) {
                             return starts_before(g, h);
                           }));
    Index h = faces[0];
    const Index v = owner(h);
    for (std::size_t found = 0; found < faces.size();) {
      if (owner_of(face_of(h)) == v) faces[found++] = h;
      const Index across = all_.opposite(halfedge(face_of(h), next_corner[edge_of(h)]));
      h = halfedge(face_of(across), next_corner[edge_of(across)]);
    }
  }
  [[nodiscard]] Index owner_of(Index f) const {
    return all_.faces()[f][all_.is_changed(f) ? first_corner(f) : 0];
  }

  const ConstrainedFaces& all_;
  VertexOrder vertices_;
  std::vector<bool> is_touched_;  // by vertex: it owns a face that changed, or did before
  std::vector<Index> order_;
};

}  // namespace

void write_in_order(const ConstrainedFaces& all, const NamedSites& sites,
                    const Triangulation& before, unsigned threads, TriangulationArrays& arrays,
                    std::vector<std::uint8_t>& sides) {
  const std::vector<Index> order =
      FaceOrder(all, sites, before.sphere(), threads).run(before.faces());
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[face_of(order[i])] = static_cast<Index>(i);
  arrays.faces.resize(order.size());
  arrays.neighbors.resize(order.size());
  sides.resize(order.size());
  constexpr std::size_t grain = 16384;
  system::parallel_for(threads, order.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = face_of(order[i]);
      unsigned corner = edge_of(order[i]);
      unsigned bits = 0;
      for (unsigned j = 0; j < 3; ++j) {
        arrays.faces[i][j] = all.faces()[f][corner];
        arrays.neighbors[i][j] = place[all.neighbors()[f][corner]];
        bits |= (all.sides()[f] >> corner & 1U) << j;
        corner = next_corner[corner];
      }
      sides[i] = static_cast<std::uint8_t>(bits);
    }
  });
  for (const Index f : before.ghost_faces()) arrays.ghost_faces.push_back(place[f]);
  std::ranges::sort(arrays.ghost_faces);
}

}  // namespace rondel::constrained
