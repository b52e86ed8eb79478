// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Makes small solids for the tests of the validator.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "proof/validator.h"
#include "support/hull_oracle.h"
#include "support/other_surfaces.h"

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

inline std::vector<Point> octahedron_sites() {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
}
inline std::vector<Point> cube_sites() {
  return {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
          {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
}

inline Triple reversed(const Triple& face) { return {face[0], face[2], face[1]}; }

// Replaces the edge between two faces by the other diagonal of their four corners.
inline void flip(std::vector<Triple>& faces, Index from, Index to) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Triple face = faces[f];
      if (face[(i + 1) % 3] == from && face[(i + 2) % 3] == to && flip_edge(faces, f, i)) return;
    }
  }
  throw std::out_of_range("there is no such edge");
}

}  // namespace rondel::test
