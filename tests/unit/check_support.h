// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Small solids for the tests of the validator.
#pragma once

#include <string>
#include <vector>

#include "proof/validator.h"
#include "support/hull_oracle.h"

namespace rondel::test {

// Sites with the faces of their triangulation.
struct Solid {
  std::vector<Point> sites;
  std::vector<Triple> faces;
  Options options{};
  Progress progress{};

  [[nodiscard]] CheckReport check() const {
    return proof::check_triangles(sites, faces, {options, {.progress = progress}});
  }
  [[nodiscard]] std::string reason() const { return check().reason; }
};

inline Solid solid(std::vector<Point> sites, Model model = Model::projected,
                   const Sphere& sphere = {}) {
  const Hull hull = brute_force_hull(sites, model, sphere);
  Options options;
  options.model = model;
  options.sphere = sphere;
  return {std::move(sites), {hull.faces.begin(), hull.faces.end()}, options, {}};
}

inline std::vector<Point> tetrahedron_sites() {
  return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
}
inline std::vector<Point> octahedron_sites() {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
}
inline std::vector<Point> cube_sites() {
  return {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
          {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
}

inline Triple reversed(const Triple& face) { return {face[0], face[2], face[1]}; }

// Replaces the edge between two faces by the other diagonal of their four corners. Works on any
// list in which each directed edge is unique.
inline void flip(std::vector<Triple>& faces, Index from, Index to) {
  const auto corner_across = [&](Index a, Index b) -> Index& {
    for (Triple& face : faces) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (face[i] == a && face[(i + 1) % 3] == b) return face[(i + 2) % 3];
      }
    }
    return faces.at(faces.size())[0];  // throws: the caller names an edge that is not there
  };
  const Index left = corner_across(from, to);
  const Index right = corner_across(to, from);
  for (Triple& face : faces) {
    const bool has_from = face[0] == from || face[1] == from || face[2] == from;
    const bool has_to = face[0] == to || face[1] == to || face[2] == to;
    if (!has_from || !has_to) continue;
    const bool is_left = face[0] == left || face[1] == left || face[2] == left;
    face = is_left ? Triple{from, right, left} : Triple{to, left, right};
  }
}

}  // namespace rondel::test
