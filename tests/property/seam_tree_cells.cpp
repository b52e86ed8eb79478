// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The cells of a tree of seams: the faces of the cube, halved along lines. Near a line, where order
// and cells may disagree, and on it, chance decides to which side a site belongs.

#include <cmath>

#include "inputs/points.h"
#include "property/seam_tree.h"

namespace rondel::test {

using inputs::operator+;
using inputs::operator*;

// Whether a site belongs to the side that a normal of multiples of 1/16 points to. Near the line,
// and on it, chance decides, for each ray.
bool SeamTree::is_beyond(const Point& normal, const Point& p) const {
  const double value = dot(normal, p);
  if (std::abs(value) > std::sin(input_.margin) * length_of(normal) * length_of(p))
    return value > 0;
  std::uint64_t seed = input_.seed;
  for (const int i : ray_of(p)) seed = inputs::Random(seed ^ static_cast<std::uint64_t>(i)).next();
  const Point key = 16.0 * normal;
  for (const double i : {key.x, key.y, key.z})
    seed = inputs::Random(seed ^ static_cast<std::uint64_t>(std::abs(i))).next();
  const bool chance = inputs::Random(seed).coin();
  // The same of both normals of a line.
  const double first = key.x != 0 ? key.x : key.y != 0 ? key.y : key.z;
  return chance == (first > 0);
}

// The six faces of the cube, split at random lines; sites at the center are in none.
SeamCell SeamTree::make_cells() {
  SeamCell root;
  root.children.resize(6);
  for (unsigned i = 0; i < 6; ++i) {
    const auto along = [&](unsigned axis, double value) {
      return Point{axis == 0 ? value : 0, axis == 1 ? value : 0, axis == 2 ? value : 0};
    };
    for (const unsigned axis : {(i + 1) % 3, (i + 2) % 3}) {
      for (const double side : {1.0, -1.0}) {
        const Point inward = along(i % 3, i < 3 ? 1 : -1) + along(axis, side);
        root.children[i].inward.push_back(1 / length_of(inward) * inward);
      }
    }
  }
  for (Index i = 0; i < input_.sites.size(); ++i) {
    const Point& p = input_.sites[i];
    if (p == Point{}) {
      root.sites.push_back({i, p});
      continue;
    }
    const bool xy = is_beyond({1, -1, 0}, p) == is_beyond({1, 1, 0}, p);
    const unsigned a = xy ? 0 : 1;  // |x| > |y|, or not
    const Point across = a == 0 ? Point{1, 0, -1} : Point{0, 1, -1};
    const Point other = a == 0 ? Point{1, 0, 1} : Point{0, 1, 1};
    const unsigned axis = is_beyond(across, p) == is_beyond(other, p) ? a : 2;
    const double coordinate = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    root.children[coordinate > 0 ? axis : axis + 3].sites.push_back({i, p});
  }
  for (unsigned i = 0; i < 6; ++i)
    split(root.children[i], {-16, -16, 16, 16}, i % 3, i < 3 ? 1 : -1, 0);
  return root;
}

// `box` are the least and the largest quotients of a face, in sixteenths.
void SeamTree::split(SeamCell& cell, std::array<int, 4> box, unsigned axis, double sign,
                     unsigned depth) {
  inputs::Random random(input_.seed + 1000 * cell.sites.size() + depth);
  cell.fails = random.below(12) == 0;
  if (depth == 5 || cell.sites.size() < 5 || random.below(8) == 0) return;
  const unsigned k = box[2] - box[0] >= box[3] - box[1] ? 0 : 1;
  if (box[k + 2] - box[k] < 2) return;
  const int middle = (box[k] + box[k + 2]) / 2;
  const unsigned side = (axis + 1 + k) % 3;
  const auto part = [side, axis](unsigned i, double on_side, double on_axis) {
    return i == side ? on_side : i == axis ? on_axis : 0;
  };
  const double limit = -sign * middle / 16.0;
  const Point normal = {part(0, 1, limit), part(1, 1, limit), part(2, 1, limit)};
  cell.children.resize(2);
  for (const unsigned i : {0U, 1U}) {
    SeamCell& child = cell.children[i];
    child.inward = cell.inward;
    child.inward.push_back((i == 0 ? -1 : 1) / length_of(normal) * normal);
    for (const PlacedSite& s : cell.sites) {
      if (is_beyond(normal, s.point) == (i == 1)) child.sites.push_back(s);
    }
    std::array<int, 4> part_box = box;
    part_box[i == 0 ? k + 2 : k] = middle;
    split(child, part_box, axis, sign, depth + 1);
  }
  cell.sites.clear();
}

}  // namespace rondel::test
