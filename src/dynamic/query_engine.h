// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Queries of a triangulation that changes, in dimension 2, as it is now.
#pragma once

#include "dynamic/editor.h"
#include "query/directory.h"
#include "query/graph_engine.h"

namespace rondel::dynamic {

template <models::SphereModel T>
class HullDirectory final : public query::Directory {
 public:
  explicit HullDirectory(const Editor<T>& editor) : editor_(editor) {}

  [[nodiscard]] std::size_t num_vertices() const override { return editor_.hull()->num_vertices(); }
  [[nodiscard]] bool has_site(Index site) const override { return places().is_alive(site); }
  [[nodiscard]] Point site(Index site) const override { return places().point(site); }
  [[nodiscard]] Index vertex_of(Index site) const override {
    const Index place = places().place_of(site);
    return editor_.hull()->is_vertex(place) ? place : no_index;
  }
  [[nodiscard]] Index name(Index vertex) const override { return places().names()[vertex]; }
  [[nodiscard]] Index near(const Point& p) const override {
    const Index place = places().near(p);
    if (editor_.hull()->is_vertex(place)) return place;
    return editor_.hull()->mesh()[editor_.hull()->hidden().solid_face(place)].vertex[0];
  }

 private:
  [[nodiscard]] const Places& places() const { return editor_.places(); }

  const Editor<T>& editor_;
};

template <models::SphereModel T>
class HullEngine final : public query::SurfaceEngine<T> {
 public:
  HullEngine(const Editor<T>& editor, const Sphere& sphere)
      : query::SurfaceEngine<T>(editor.sites(), sphere), editor_(editor) {}

 private:
  [[nodiscard]] query::Surface<T> surface() const override {
    const PlaceHull<T>& hull = *editor_.hull();
    return {editor_.sites(), hull.mesh(), hull.kinds(), hull.corners(), editor_.places().names()};
  }
  [[nodiscard]] Index solid_face() const override { return editor_.hull()->solid_face(); }
  [[nodiscard]] Index entry_face() const override { return editor_.hull()->entry_face(); }

  const Editor<T>& editor_;
};

}  // namespace rondel::dynamic
