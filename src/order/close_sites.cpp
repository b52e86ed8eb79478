// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "order/close_sites.h"

#include <algorithm>
#include <tuple>

#include "order/place_keys.h"
#include "predicates/ray_order.h"

namespace rondel::order {

struct CloseSites::Entry {
  HilbertKey key;
  Index site;
};

bool CloseSites::is_lexicographically_less(Index i, Index j) const {
  const Point& a = sites_[i];
  const Point& b = sites_[j];
  return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
}

Sign CloseSites::compare_places(Index i, Index j) const {
  if (model_ == Model::projected) {
    return predicates::compare_rays(sites_[i], sites_[j], center_);
  }
  const auto order = std::tie(sites_[i].x, sites_[i].y, sites_[i].z) <=>
                     std::tie(sites_[j].x, sites_[j].y, sites_[j].z);
  return order < 0 ? Sign::negative : (order > 0 ? Sign::positive : Sign::zero);
}

// By key, and where these agree by place, so that duplicates meet, with the lexicographically
// smallest in front.
std::vector<CloseSites::Entry> CloseSites::sorted_entries(std::span<const Index> group) const {
  std::vector<Entry> entries;
  entries.reserve(group.size());
  for (const Index i : group) entries.push_back({place_key(sites_[i], model_, center_), i});
  std::ranges::sort(entries, [this](const Entry& a, const Entry& b) {
    if (a.key != b.key) return a.key < b.key;
    const Sign places = compare_places(a.site, b.site);
    if (places != Sign::zero) return places == Sign::negative;
    return is_lexicographically_less(a.site, b.site);
  });
  return entries;
}

std::size_t CloseSites::order(std::span<Index> group, std::size_t first_rank,
                              std::vector<Duplicate>& duplicates,
                              std::vector<Renamed>& renamed) const {
  const Point& first = sites_[group[0]];
  if (std::ranges::all_of(group, [&](Index i) { return sites_[i] == first; })) {
    const Index lowest = *std::ranges::min_element(group);
    for (const Index i : group) {
      if (i != lowest) duplicates.push_back({i, lowest});
    }
    group[0] = lowest;
    return 1;
  }
  const auto entries = sorted_entries(group);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size();) {
    std::size_t end = i + 1;
    while (end < entries.size() && entries[end].key == entries[i].key) ++end;
    kept += merge_duplicates({entries.data() + i, end - i}, group.subspan(kept), first_rank + kept,
                             duplicates, renamed);
    i = end;
  }
  return kept;
}

// Sites with one key: merges duplicates, then orders the places lexicographically.
std::size_t CloseSites::merge_duplicates(std::span<const Entry> cell, std::span<Index> ordered,
                                         std::size_t first_rank, std::vector<Duplicate>& duplicates,
                                         std::vector<Renamed>& renamed) const {
  if (cell.size() == 1) {
    ordered[0] = cell[0].site;
    return 1;
  }
  struct Place {
    Index site;    // whose coordinates count
    Index lowest;  // index, which names the vertex
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < cell.size();) {
    std::size_t end = i + 1;
    while (end < cell.size() && compare_places(cell[i].site, cell[end].site) == Sign::zero) ++end;
    const auto place = cell.subspan(i, end - i);
    const Index lowest = std::ranges::min(place, {}, &Entry::site).site;
    for (const Entry& e : place) {
      if (e.site != lowest) duplicates.push_back({e.site, lowest});
    }
    places.push_back({cell[i].site, lowest});
    i = end;
  }
  std::ranges::sort(places, [this](const Place& a, const Place& b) {
    return is_lexicographically_less(a.site, b.site);
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [site, lowest] = places[i];
    ordered[i] = site;
    if (site != lowest) renamed.push_back({static_cast<Index>(first_rank + i), lowest});
  }
  return places.size();
}

}  // namespace rondel::order
