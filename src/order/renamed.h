// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The names of sites by rank. Among duplicates the lexicographically smallest one speaks for the
// place, so SpatialOrder::order lists that; but the lowest input index names the vertex.
#pragma once

#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::order {

// The vertex of rank `rank` is named by the input index `name`, which is not order[rank].
struct Renamed {
  Index rank;
  Index name;
  friend bool operator==(const Renamed&, const Renamed&) = default;
};

// Turns `order`, the site whose coordinates count for each rank, into the name of each rank.
inline void rename(std::span<Index> order, std::span<const Renamed> renamed) {
  for (const auto& [rank, name] : renamed) order[rank] = name;
}

// The name of each rank: `order` itself where nothing is renamed, or what is put into `space`.
inline std::span<const Index> names_of(std::span<const Index> order,
                                       std::span<const Renamed> renamed,
                                       std::vector<Index>& space) {
  if (renamed.empty()) return order;
  space.assign(order.begin(), order.end());
  rename(space, renamed);
  return space;
}

}  // namespace rondel::order
