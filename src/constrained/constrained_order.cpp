// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Faces are counted by their owners. Those of an owner that has some that changed, or had some, are
// then put in order, one behind the other or by a walk around it.

#include "constrained/constrained_order.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "order/place_keys.h"
#include "system/parallel.h"
#include "system/prefetch.h"
#include "topology/canonical_order.h"
#include "topology/mesh.h"

namespace rondel::constrained {
namespace {

using topology::edge_of;
using topology::face_of;
using topology::halfedge;
using topology::next_corner;

// A vertex with its place along the curve.
struct PlacedVertex {
  std::uint64_t key;
  Index name;
};

std::vector<PlacedVertex> placed(std::span<const Index> names, const NamedSites& sites,
                                 const Point& center, unsigned threads) {
  std::vector<PlacedVertex> result(names.size());
  constexpr std::size_t grain = 4096;
  system::parallel_for(threads, names.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Point> points;
    points.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      if (i + system::prefetch_distance < end) {
        system::prefetch(&sites.point(names[i + system::prefetch_distance]));
      }
      points.push_back(sites.point(names[i]));
    }
    std::vector<std::uint64_t> keys(points.size());
    order::place_keys(points, Model::projected, center, keys);
    for (std::size_t i = begin; i < end; ++i) result[i] = {keys[i - begin], names[i]};
  });
  return result;
}

// What puts vertices of equal keys in order.
std::tuple<std::uint64_t, double, double, double> details(const Point& p, const Point& center) {
  std::array<std::uint64_t, 1> high{};
  std::array<std::uint64_t, 1> low{};
  order::place_keys(std::span(&p, 1), Model::projected, center, high, low);
  return {low[0], p.x, p.y, p.z};
}

// The faces as halfedges opposite to their owners.
class FaceOrder {
 public:
  explicit FaceOrder(const ConstrainedFaces& all)
      : all_(all), is_touched_(all.points().size()), end_(all.points().size()) {}

  LargeVector<Index> run(std::span<const Triple> before) {
    for (Index f = 0; f < before.size(); ++f) {
      const Index v = owner(halfedge(f, first_corner(f)));
      ++end_[v];
      if (!all_.is_changed(f)) continue;
      is_touched_[v] = 1;
      is_touched_[all_.vertex_of(before[f][0])] = 1;
    }
    Index sum = 0;
    for (Index& end : end_) sum += std::exchange(end, sum);
    order_.resize(before.size());
    for (Index f = 0; f < before.size(); ++f) {
      const Index h = halfedge(f, first_corner(f));
      order_[end_[owner(h)]++] = h;
    }
    Index begin = 0;
    for (std::size_t v = 0; v < end_.size(); ++v) {
      if (is_touched_[v] != 0 && end_[v] > begin + 1) {
        sort_around(std::span(order_).subspan(begin, end_[v] - begin));
      }
      begin = end_[v];
    }
    return std::move(order_);
  }

 private:
  [[nodiscard]] Index owner(Index h) const { return all_.faces()[face_of(h)][edge_of(h)]; }
  [[nodiscard]] unsigned first_corner(Index f) const {
    return topology::first_corner(all_.faces()[f]);
  }

  // The face with the earlier second corner comes first, or the solid one if they have the same.
  [[nodiscard]] bool starts_before(Index g, Index h) const {
    const Index v = all_.faces()[face_of(g)][next_corner[edge_of(g)]];
    const Index w = all_.faces()[face_of(h)][next_corner[edge_of(h)]];
    if (v != w) return v < w;
    return all_.is_solid(face_of(g)) && !all_.is_solid(face_of(h));
  }

  void sort_around(std::span<Index> faces) const {
    std::ranges::iter_swap(faces.begin(), std::ranges::min_element(faces, [&](Index g, Index h) {
                             return starts_before(g, h);
                           }));
    if (!is_chain(faces)) walk_around(faces);
  }

  // Puts the faces in order behind the first one if each of them meets the one before.
  [[nodiscard]] bool is_chain(std::span<Index> faces) const {
    constexpr std::size_t many = 16;  // where looking for the next one takes longer than a walk
    if (faces.size() > many) return false;
    for (std::size_t i = 1; i < faces.size(); ++i) {
      const Index third = corner_of(faces[i - 1], 2);
      std::size_t next = i;
      while (next < faces.size() && !is_next(faces[i - 1], faces[next], third)) ++next;
      if (next == faces.size()) return false;
      std::swap(faces[i], faces[next]);
    }
    return true;
  }
  [[nodiscard]] bool is_next(Index g, Index h, Index third) const {
    return corner_of(h, 1) == third &&
           all_.neighbors()[face_of(g)][next_corner[edge_of(g)]] == face_of(h);
  }
  [[nodiscard]] Index corner_of(Index h, unsigned i) const {
    return all_.faces()[face_of(h)][(edge_of(h) + i) % 3];
  }

  // Lists the faces of an owner from the first one on.
  void walk_around(std::span<Index> faces) const {
    Index h = faces[0];
    for (std::size_t found = 0; found < faces.size();) {
      if (first_corner(face_of(h)) == edge_of(h)) faces[found++] = h;
      const Index across = all_.opposite(halfedge(face_of(h), next_corner[edge_of(h)]));
      h = halfedge(face_of(across), next_corner[edge_of(across)]);
    }
  }

  const ConstrainedFaces& all_;
  std::vector<std::uint8_t> is_touched_;  // by vertex: it owns a face that changed, or did before
  std::vector<Index> end_;                // by vertex: where its faces end in the order
  LargeVector<Index> order_;
};

}  // namespace

// Owners of faces are in order already. What owns no face, as all around come before, is merged.
std::vector<Index> names_in_order(const Triangulation& triangulation, const NamedSites& sites,
                                  unsigned threads) {
  std::vector<Index> owners;
  std::vector<std::uint8_t> is_owner(triangulation.num_sites());
  for (const Triple& face : triangulation.faces()) {
    if (!owners.empty() && owners.back() == face[0]) continue;
    owners.push_back(face[0]);
    is_owner[face[0]] = 1;
  }
  std::vector<Index> others;
  for (Index name = 0; name < triangulation.num_sites(); ++name) {
    if (is_owner[name] == 0 && sites.name(name) == name) others.push_back(name);
  }
  const Point& center = triangulation.sphere().center;
  const auto is_before = [&](const PlacedVertex& v, const PlacedVertex& w) {
    if (v.key != w.key) return v.key < w.key;
    return v.name != w.name &&
           details(sites.point(v.name), center) < details(sites.point(w.name), center);
  };
  std::vector<PlacedVertex> rest = placed(others, sites, center, threads);
  std::ranges::sort(rest, is_before);
  std::vector<Index> names;
  names.reserve(triangulation.num_vertices());
  auto next = rest.begin();
  for (const PlacedVertex& v : placed(owners, sites, center, threads)) {
    for (; next != rest.end() && is_before(*next, v); ++next) names.push_back(next->name);
    names.push_back(v.name);
  }
  for (; next != rest.end(); ++next) names.push_back(next->name);
  return names;
}

void write_in_order(const ConstrainedFaces& all, const Triangulation& before, unsigned threads,
                    TriangulationArrays& arrays, std::vector<std::uint8_t>& sides) {
  const LargeVector<Index> order = FaceOrder(all).run(before.faces());
  LargeVector<Index> place(order.size());
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
        arrays.faces[i][j] = all.name_of(all.faces()[f][corner]);
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
