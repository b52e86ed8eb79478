// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Which faces hide which sites, so that a hidden site comes back when what hid it goes.
//
//            solid         A hidden site p lies on its ray between a solid face above it and, when
//         .---------.      the center o is outside, an entry face below it. As long as both are
//        /     p     \     there, p is inside the hull. With o inside, nothing is needed below.
//        '-----------'     Sites without an entry face are "ungrounded": they depend on o staying
//            entry         inside, or on grazing faces.
//              o
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondel/types.h"

namespace rondel::dynamic {

class HiddenSites {
 public:
  [[nodiscard]] bool contains(Index p) const {
    return p < links_.size() && links_[p][0].face != no_index;
  }
  [[nodiscard]] Index solid_face(Index p) const { return links_[p][0].face; }
  [[nodiscard]] Index entry_face(Index p) const { return links_[p][1].face; }

  // `entry` may be no_index.
  void attach(Index p, Index solid, Index entry);
  void detach(Index p);

  // New numbers of sites and faces, by old numbers.
  void renumber(std::span<const Index> new_site, std::span<const Index> new_face);

  // Detach all sites of a face, or all that are ungrounded, and append them to `sites`.
  void take(Index face, std::vector<Index>& sites);
  void take_ungrounded(std::vector<Index>& sites);

 private:
  // Two doubly linked lists: of the sites below a solid face, and above an entry face or nothing.
  struct Link {
    Index face = no_index;
    Index next = no_index;
    Index previous = no_index;
  };

  Index& head(Index face) { return face == no_index ? ungrounded_ : heads_[face]; }
  void push(Index p, std::size_t side, Index face);
  void unlink(Index p, std::size_t side);

  std::vector<std::array<Link, 2>> links_;  // by site
  std::vector<Index> heads_;                // by face
  Index ungrounded_ = no_index;
};

}  // namespace rondel::dynamic
