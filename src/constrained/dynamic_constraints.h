// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Constraints that come and go, by id.
//
// in    two sites, by their ids
// out   the id of a constraint, which it keeps until it is removed
// index ids of constraints; ids of sites
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::constrained {

class DynamicConstraints {
 public:
  using Ends = std::array<Index, 2>;

  // Takes the constraints 0, 1, 2 ...
  void assign(std::span<const Ends> ends);

  [[nodiscard]] std::size_t size() const { return ends_.size() - free_.size(); }
  // Ids are below this.
  [[nodiscard]] Index limit() const { return static_cast<Index>(ends_.size()); }
  [[nodiscard]] bool contains(Index id) const { return id < limit() && ends_[id][0] != no_index; }
  [[nodiscard]] const Ends& ends(Index id) const { return ends_[id]; }
  // All of them, ascending.
  [[nodiscard]] std::vector<Index> ids() const;
  // Returns how many have an end at a site.
  [[nodiscard]] Index num_ends_at(Index site) const {
    return site < num_ends_.size() ? num_ends_[site] : 0;
  }
  // Returns the lowest one with an end at a site. Precondition: there is one.
  [[nodiscard]] Index first_at(Index site) const;

  // Returns the id that the next one gets.
  [[nodiscard]] Index next_id() const { return free_.empty() ? limit() : free_.back(); }
  // Makes room, so that the functions below do not throw.
  void make_room(const Ends& ends);
  Index insert(const Ends& ends) noexcept;
  void remove(Index id) noexcept;

 private:
  std::vector<Ends> ends_;  // no_index twice: there is none
  std::vector<Index> free_;
  std::vector<Index> num_ends_;  // by site
};

}  // namespace rondel::constrained
