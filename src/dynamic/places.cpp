// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dynamic/places.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

#include "predicates/perturbation.h"
#include "predicates/ray_order.h"
#include "system/gather.h"
#include "system/large_arrays.h"
#include "system/prefetch.h"

namespace rondel::dynamic {
namespace {

Index take_slot(std::vector<Index>& free_slots) {
  const Index slot = free_slots.back();
  free_slots.pop_back();
  return slot;
}

}  // namespace

Index Places::add_site() {
  if (free_sites_.empty()) {
    system::grow_large(points_);
    system::grow_large(place_of_);
    points_.emplace_back();
    place_of_.push_back(no_index);
    ++num_sites_;
    return site_limit() - 1;
  }
  ++num_sites_;
  return take_slot(free_sites_);
}

void Places::free_site(Index site) {
  assert(place_of_[site] == no_index);
  free_sites_.push_back(site);
  --num_sites_;
}

void Places::roll_back(std::span<const Index> sites, bool are_there) noexcept {
  for (const Index site : sites) place_of_[site] = are_there ? 0 : no_index;
  free_sites_.clear();
  count_sites();
}

void Places::count_sites() noexcept {
  num_sites_ = place_of_.size() - static_cast<std::size_t>(std::ranges::count(place_of_, no_index));
}

Places::Spot Places::look_up(const Point& p) const {
  Spot spot;
  spot.key = key(p);
  spot.position = index_.seek(spot.key, order_of(p));
  spot.close = index_.near(spot.position, spot.key);
  spot.around = index_.around(spot.position);
  spot.place = index_.find(spot.position, spot.key, [&](Index place) {
    const Point& q = place_point(place);
    if (p == q) return true;
    return model_ == Model::projected && predicates::compare_rays(p, q, center_) == Sign::zero;
  });
  return spot;
}

Index Places::add_place(Index site, const Spot& spot) {
  Index place = static_cast<Index>(representatives_.size());
  if (free_places_.empty()) {
    representatives_.push_back(site);
    names_.push_back(site);
  } else {
    place = take_slot(free_places_);
    representatives_[place] = site;
    names_[place] = site;
  }
  place_of_[site] = place;
  index_.insert(spot.position, spot.key, place);
  return place;
}

void Places::free_place(Index place, const order::HilbertKey& key) {
  index_.erase(key, place, order_of(place_point(place)));
  free_places_.push_back(place);
}

bool Places::would_speak(Index site, Index place) const {
  return predicates::is_lexicographically_less(points_[site], place_point(place));
}

bool Places::SpeaksBefore::operator()(const Resident& a, const Resident& b) const {
  if (a.place != b.place) return a.place < b.place;
  const Point& p = (*points)[a.site];
  const Point& q = (*points)[b.site];
  if (predicates::is_lexicographically_less(p, q)) return true;
  return !predicates::is_lexicographically_less(q, p) && a.site < b.site;
}

void Places::insert(const Resident& resident) {
  by_name_.insert(resident);
  by_triple_.insert(resident);
}

void Places::erase(const Resident& resident) {
  by_name_.erase(resident);
  by_triple_.erase(resident);
}

void Places::join(Index site, Index place) {
  insert({place, representatives_[place]});
  insert({place, site});
  place_of_[site] = place;
  names_[place] = std::min(names_[place], site);
}

Index Places::next_representative(Index site) const {
  const Index place = place_of_[site];
  if (site != representatives_[place]) return representatives_[place];
  auto next = by_triple_.lower_bound(place);
  if (next == by_triple_.end() || next->place != place) return no_index;
  if (next->site == site) ++next;
  return next->site;
}

void Places::leave(Index site) {
  const Index place = std::exchange(place_of_[site], no_index);
  erase({place, site});
  const auto first = by_name_.lower_bound({place, 0});
  if (first == by_name_.end() || first->place != place) return;
  names_[place] = first->site;
  const auto second = std::next(first);
  const bool is_alone = second == by_name_.end() || second->place != place;
  if (is_alone) erase({place, names_[place]});
}

void Places::renumber(const Renumbering& places) {
  representatives_ = system::gather(representatives_, places.old_place, places.room());
  names_ = system::gather(names_, places.old_place, places.room());
  free_places_ = {};
  for (Index& place : place_of_) {
    if (place != no_index) place = places.new_place[place];
  }
  index_.renumber();
  const std::set<Resident> residents = std::exchange(by_name_, {});
  by_triple_.clear();
  for (const auto& [place, site] : residents) insert({places.new_place[place], site});
}

bool Places::keep_residents() {
  for (const auto& [place, site] : by_name_) {
    const Point& p = points_[site];
    const Point& q = points_[names_[place]];
    if (p == q) continue;
    if (model_ == Model::weighted || predicates::compare_rays(p, q, center_) != Sign::zero) {
      return false;
    }
  }
  // Points have changed, and with them the order of those who share a place.
  by_triple_.clear();
  for (const Resident& resident : by_name_) by_triple_.insert(resident);
  Index last = no_index;
  for (const auto& [place, site] : by_triple_) {
    if (place != last) representatives_[place] = site;
    last = place;
  }
  return true;
}

// Keys that are computed together take a fraction of the time.
std::vector<order::HilbertKey> Places::keys_of(std::span<const Index> places) const {
  constexpr std::size_t some = 256;
  std::array<Point, some> points;
  std::array<std::uint64_t, some> highs;
  std::array<std::uint64_t, some> lows;
  std::vector<order::HilbertKey> keys(places.size());
  for (std::size_t begin = 0; begin < places.size(); begin += some) {
    const std::size_t count = std::min(some, places.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      if (begin + i + system::prefetch_distance < places.size()) {
        const Index later = places[begin + i + system::prefetch_distance];
        system::prefetch(&points_[representatives_[later]]);
      }
      points[i] = place_point(places[begin + i]);
    }
    order::place_keys(std::span(points).first(count), model_, center_,
                      std::span(highs).first(count), std::span(lows).first(count));
    for (std::size_t i = 0; i < count; ++i) keys[begin + i] = {highs[i], lows[i]};
  }
  return keys;
}

void Places::sort_index() {
  struct KeyedPlace {
    order::HilbertKey key;
    Index place;
  };
  std::vector<KeyedPlace> entries;
  entries.reserve(num_places());
  // The old order is nearly the new one.
  const std::vector<Index> before = in_order();
  const std::vector<order::HilbertKey> new_keys = keys_of(before);
  for (std::size_t i = 0; i < before.size(); ++i) entries.push_back({new_keys[i], before[i]});
  std::ranges::sort(entries, [this](const KeyedPlace& a, const KeyedPlace& b) {
    if (a.key != b.key) return a.key < b.key;
    return predicates::is_lexicographically_less(place_point(a.place), place_point(b.place));
  });
  std::vector<order::HilbertKey> keys;
  std::vector<Index> places;
  keys.reserve(entries.size());
  places.reserve(entries.size());
  for (const KeyedPlace& entry : entries) {
    keys.push_back(entry.key);
    places.push_back(entry.place);
  }
  index_.assign(keys, places);
}

void Places::assign_points(std::span<const Point> points) {
  points_.assign(points.begin(), points.end());
}

void Places::assign(std::span<const Index> place_of_site, std::span<const Index> representatives) {
  place_of_.assign(place_of_site.begin(), place_of_site.end());
  count_sites();
  representatives_.assign(representatives.begin(), representatives.end());
  names_ = representatives_;
  const bool lists_free_sites = free_sites_.size() + num_sites_ == place_of_.size();
  if (!lists_free_sites) free_sites_.clear();  // memory may have run out in the loop below before
  free_places_.clear();
  by_name_.clear();
  by_triple_.clear();
  for (Index site = 0; site < site_limit(); ++site) {
    const Index place = place_of_[site];
    if (place == no_index) {
      if (!lists_free_sites) free_sites_.push_back(site);
    } else if (representatives_[place] != site) {
      join(site, place);
    }
  }
  std::vector<Index> places(representatives.size());
  std::iota(places.begin(), places.end(), Index{0});
  index_.assign(keys_of(places), places);
}

}  // namespace rondel::dynamic
