// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Lists of sites that RapidCheck shrinks site by site and number by number, full of ties: a small
// grid, multiples of 15 degrees, the same rays and places again, neighbours one ulp apart.
#pragma once

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "property/property.h"
#include "rondel/delaunay.h"

namespace rondel::test {

// Numbers rather than points, so that what is left after shrinking is easy to read.
using Recipe = std::tuple<int, int, int, int>;

inline Point site_of(const Recipe& recipe) {
  const auto& [kind, x, y, z] = recipe;
  const Point grid = {x * 1.0, y * 1.0, z * 1.0};
  switch (kind) {
    case 1:
      return unit_vector({15.0 * x, 15.0 * y});
    case 2:
      return {std::nextafter(grid.x, 9), grid.y, grid.z};
    case 3:
      return {grid.x, grid.y, std::nextafter(grid.z, -9)};
    case 4:
      return std::ldexp(1, 3 * x) * unit_vector({15.0 * y, 15.0 * z});
    case 5:
      return std::ldexp(1, x * y) * Point{1.0 * y, 1, 1.0 * z};
    default:
      return grid;
  }
}

inline rc::Gen<std::vector<Recipe>> recipes() {
  const auto digit = rc::gen::resize(rc::kNominalSize, rc::gen::inRange(-3, 4));
  const auto kind = rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 8));
  return rc::gen::container<std::vector<Recipe>>(rc::gen::tuple(kind, digit, digit, digit));
}

inline std::vector<Point> sites_of(const std::vector<Recipe>& list, Model model) {
  std::vector<Point> sites;
  for (const Recipe& recipe : list) {
    const Point p = site_of(recipe);
    if (model == Model::weighted || p != Point{}) sites.push_back(p);
  }
  return sites;
}

struct TiedSites {
  std::vector<Point> sites;
  Options options;

  [[nodiscard]] Triangulation triangulate() const { return delaunay(sites, options); }
};

inline Options options_of(Model model) {
  Options options;
  options.model = model;
  return options;
}

inline TiedSites any_tied_sites() {
  const auto model = *rc::gen::element(Model::projected, Model::weighted).as("model");
  return {sites_of(*recipes().as("sites"), model), options_of(model)};
}

// Some positions in a list of this size, perhaps repeatedly.
inline std::vector<std::size_t> some_positions(std::size_t size) {
  if (size == 0) return {};
  return *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, size))
              .as("positions");
}

inline bool have_same_bits(const Triangulation& a, const Triangulation& b) {
  return a.dimension() == b.dimension() && std::ranges::equal(a.faces(), b.faces()) &&
         std::ranges::equal(a.neighbors(), b.neighbors()) &&
         std::ranges::equal(a.ghost_faces(), b.ghost_faces()) &&
         std::ranges::equal(a.ring(), b.ring()) && std::ranges::equal(a.hidden(), b.hidden());
}

}  // namespace rondel::test
