// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dynamic/hidden_sites.h"

#include <utility>

namespace rondel::dynamic {

void HiddenSites::attach(Index p, Index solid, Index entry) {
  if (p >= links_.size()) links_.resize(p + std::size_t{1});
  push(p, 0, solid);
  push(p, 1, entry);
}

void HiddenSites::detach(Index p) {
  unlink(p, 0);
  unlink(p, 1);
  links_[p] = {};
}

void HiddenSites::take(Index face, std::vector<Index>& sites) {
  if (face >= heads_.size()) return;
  while (heads_[face] != no_index) {
    sites.push_back(heads_[face]);
    detach(heads_[face]);
  }
}

void HiddenSites::take_ungrounded(std::vector<Index>& sites) {
  while (ungrounded_ != no_index) {
    sites.push_back(ungrounded_);
    detach(ungrounded_);
  }
}

void HiddenSites::renumber(std::span<const Index> new_site, std::span<const Index> new_face) {
  HiddenSites renumbered;
  for (Index p = 0; p < links_.size(); ++p) {
    if (!contains(p)) continue;
    const Index entry = entry_face(p) == no_index ? no_index : new_face[entry_face(p)];
    renumbered.attach(new_site[p], new_face[solid_face(p)], entry);
  }
  *this = std::move(renumbered);
}

void HiddenSites::push(Index p, std::size_t side, Index face) {
  if (face != no_index && face >= heads_.size()) heads_.resize(face + std::size_t{1}, no_index);
  Index& first = head(face);
  links_[p][side] = {face, first, no_index};
  if (first != no_index) links_[first][side].previous = p;
  first = p;
}

void HiddenSites::unlink(Index p, std::size_t side) {
  const Link& link = links_[p][side];
  if (link.previous != no_index) {
    links_[link.previous][side].next = link.next;
  } else {
    head(link.face) = link.next;
  }
  if (link.next != no_index) links_[link.next][side].previous = link.previous;
}

}  // namespace rondel::dynamic
