// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What the vertices of an engine are called outside: input indices, or ids of sites that change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "order/cube_position.h"
#include "order/hilbert.h"
#include "query/vertices.h"
#include "rondel/types.h"

namespace rondel::query {

inline std::uint64_t spatial_key(const Point& p, const Point& center) {
  return order::hilbert_key(order::cube_position(p, center)).high;
}

class Directory {
 public:
  Directory() = default;
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  virtual ~Directory() = default;

  [[nodiscard]] virtual std::size_t num_vertices() const = 0;
  [[nodiscard]] virtual bool has_site(Index site) const = 0;
  // Preconditions: there is such a site.
  [[nodiscard]] virtual Point site(Index site) const = 0;
  [[nodiscard]] virtual Index vertex_of(Index site) const = 0;  // no_index: it is hidden
  [[nodiscard]] virtual Index name(Index vertex) const = 0;
  // A vertex close to p. Precondition: there is a vertex.
  [[nodiscard]] virtual Index near(const Point& p) const = 0;
};

// Of a finished triangulation.
class BuiltDirectory final : public Directory {
 public:
  // `ids`, if any, name the sites; they increase. Keeps a reference to `sites`.
  BuiltDirectory(const Triangulation& triangulation, std::span<const Point> sites,
                 std::vector<Index> ids)
      : sites_(sites),
        center_(triangulation.sphere().center),
        ids_(std::move(ids)),
        vertices_(list_vertices(triangulation, sites)) {}

  [[nodiscard]] const Vertices& vertices() const { return vertices_; }

  [[nodiscard]] std::size_t num_vertices() const override { return vertices_.names.size(); }
  [[nodiscard]] bool has_site(Index site) const override {
    return ids_.empty() ? site < sites_.size() : std::ranges::binary_search(ids_, site);
  }
  [[nodiscard]] Point site(Index site) const override { return sites_[position(site)]; }
  [[nodiscard]] Index vertex_of(Index site) const override {
    return vertices_.vertex_of[position(site)];
  }
  [[nodiscard]] Index name(Index vertex) const override {
    const Index site = vertices_.names[vertex];
    return ids_.empty() ? site : ids_[site];
  }
  [[nodiscard]] Index near(const Point& p) const override {
    return vertices_.near(spatial_key(p, center_));
  }

 private:
  [[nodiscard]] Index position(Index site) const {
    if (ids_.empty()) return site;
    return static_cast<Index>(std::ranges::lower_bound(ids_, site) - ids_.begin());
  }

  std::span<const Point> sites_;
  Point center_;
  std::vector<Index> ids_;
  Vertices vertices_;
};

}  // namespace rondel::query
