// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Surfaces of triangles that are not the hull of their corners.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "rondel/triangulation.h"

namespace rondel::test {

// Replaces the diagonal that faces[f] has opposite to its corner i, so that the list stays a closed
// surface: false if its other face is not there, or has the same corners.
inline bool flip_edge(std::vector<Triple>& faces, std::size_t f, std::size_t i) {
  const auto [a, b, c] = std::tuple(faces[f][i], faces[f][(i + 1) % 3], faces[f][(i + 2) % 3]);
  for (std::size_t g = 0; g < faces.size(); ++g) {
    for (std::size_t j = 0; j < 3 && g != f; ++j) {
      const Index d = faces[g][j];
      if (faces[g][(j + 1) % 3] != c || faces[g][(j + 2) % 3] != b || d == a) continue;
      faces[f] = {a, b, d};
      faces[g] = {a, d, c};
      return true;
    }
  }
  return false;
}

// The faces across the edges; no_index where there is none.
inline std::vector<Triple> neighbors_of(const std::vector<Triple>& faces) {
  std::map<std::pair<Index, Index>, Index> face_at;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      face_at[{faces[f][i], faces[f][(i + 1) % 3]}] = static_cast<Index>(f);
    }
  }
  std::vector<Triple> neighbors;
  for (const Triple& face : faces) {
    Triple& row = neighbors.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = face_at.find({face[(i + 2) % 3], face[(i + 1) % 3]});
      row[i] = at == face_at.end() ? no_index : at->second;
    }
  }
  return neighbors;
}

}  // namespace rondel::test
