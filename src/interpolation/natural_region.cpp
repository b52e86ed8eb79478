// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "interpolation/natural_region.h"

#include <algorithm>
#include <cstddef>

namespace rondel::interpolation {

void NaturalRegion::find(const LocatedTarget& place) {
  const auto horizon = prepared_.engine().horizon(place.point, place.location.face, search_);
  const auto first = std::ranges::min_element(horizon, {}, &topology::HorizonEdge::origin);
  ring_.clear();
  for (auto edge = first; edge != horizon.end(); ++edge) ring_.push_back(edge->origin);
  for (auto edge = horizon.begin(); edge != first; ++edge) ring_.push_back(edge->origin);
  root_ = prepared_.mesh()[topology::face_of(first->outside)]
              .opposite[topology::edge_of(first->outside)];
}

// Searches from both ends, so that it takes no more steps than the smaller part has: O(k log k) in
// total.
Index NaturalRegion::position_between(Index a, Index b, Index vertex) const {
  Index low = a + 1;
  Index high = b - 1;
  while (low < high && ring_[low] != vertex) {
    if (ring_[high] == vertex) return high;
    ++low;
    --high;
  }
  return low;
}

// Goes depth first. Edge i of a face runs from corner i+1 to corner i+2, and the apex is opposite
// to the edge across which the face was entered.
void NaturalRegion::list_faces() {
  const topology::Mesh& mesh = prepared_.mesh();
  const auto size = static_cast<Index>(ring_.size());
  faces_.clear();
  stack_.clear();
  RegionEntry next{root_, 1, size, no_index};
  for (;;) {
    const topology::Face& face = mesh[topology::face_of(next.into)];
    const unsigned entered = topology::edge_of(next.into);
    const Index apex = face.vertex[entered];
    const Index position = position_between(next.a, next.b, apex);
    const auto index = static_cast<Index>(faces_.size());
    faces_.push_back({next.a, position, next.b, next.parent});
    if (position + 1 < next.b) {
      stack_.push_back(
          {face.opposite[topology::previous_corner[entered]], position, next.b, index});
    }
    if (next.a + 1 < position) {
      next = {face.opposite[topology::next_corner[entered]], next.a, position, index};
    } else if (stack_.empty()) {
      return;
    } else {
      next = stack_.back();
      stack_.pop_back();
    }
  }
}

}  // namespace rondel::interpolation
