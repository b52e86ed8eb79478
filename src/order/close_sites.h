// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The spatial order of a few sites whose keys begin alike, and which of them are duplicates.
#pragma once

#include <span>
#include <vector>

#include "order/renamed.h"
#include "rondel/triangulation.h"
#include "rondel/types.h"

namespace rondel::order {

class CloseSites {
 public:
  CloseSites(std::span<const Point> sites, Model model, const Point& center)
      : sites_(sites), model_(model), center_(center) {}

  // Orders the group in place: the sites whose coordinates count come first. Returns their number.
  // Appends the duplicates, and what is renamed with the ranks counted from `first_rank`.
  std::size_t order(std::span<Index> group, std::size_t first_rank,
                    std::vector<Duplicate>& duplicates, std::vector<Renamed>& renamed) const;

 private:
  struct Entry;

  [[nodiscard]] bool is_lexicographically_less(Index i, Index j) const;
  [[nodiscard]] Sign compare_places(Index i, Index j) const;
  [[nodiscard]] std::vector<Entry> sorted_entries(std::span<const Index> group) const;
  std::size_t merge_duplicates(std::span<const Entry> cell, std::span<Index> ordered,
                               std::size_t first_rank, std::vector<Duplicate>& duplicates,
                               std::vector<Renamed>& renamed) const;

  std::span<const Point> sites_;
  Model model_;
  Point center_;
};

}  // namespace rondel::order
