// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "dynamic/places.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "blocks/cube_position.h"
#include "predicates/perturbation.h"
#include "predicates/ray_order.h"

namespace rondel::dynamic {
namespace {

Index take_slot(std::vector<Index>& free_slots) {
  const Index slot = free_slots.back();
  free_slots.pop_back();
  return slot;
}

}  // namespace

Index Places::add_site() {
  if (!free_sites_.empty()) return take_slot(free_sites_);
  points_.emplace_back();
  links_.emplace_back();
  return site_limit() - 1;
}

void Places::free_site(Index site) {
  assert(links_[site].place == no_index);
  free_sites_.push_back(site);
}

blocks::HilbertKey Places::key(const Point& p) const {
  // As in blocks/spatial_order.cpp: sites in one place must have one key.
  const bool is_rounding_harmless = model_ == Model::weighted || center_ == Point{};
  return blocks::hilbert_key(is_rounding_harmless ? blocks::cube_position(p, center_)
                                                  : blocks::exact_cube_position(p, center_));
}

Index Places::find(const Point& p, const blocks::HilbertKey& key) const {
  return index_.find(key, [&](Index place) {
    const Point& q = place_point(place);
    if (p == q) return true;
    return model_ == Model::projected && predicates::compare_rays(p, q, center_) == Sign::zero;
  });
}

Index Places::add_place(Index site, const blocks::HilbertKey& key) {
  Index place = static_cast<Index>(speakers_.size());
  if (free_places_.empty()) {
    speakers_.push_back(site);
    names_.push_back(site);
  } else {
    place = take_slot(free_places_);
    speakers_[place] = site;
    names_[place] = site;
  }
  links_[site] = {place, site, site};
  index_.insert(key, place);
  return place;
}

void Places::free_place(Index place, const blocks::HilbertKey& key) {
  index_.erase(key, place);
  free_places_.push_back(place);
}

bool Places::would_speak(Index site, Index place) const {
  return predicates::is_raised_more(points_[site], place_point(place));
}

void Places::join(Index site, Index place) {
  const Index before = speakers_[place];
  const Index after = links_[before].next;
  links_[site] = {place, after, before};
  links_[before].next = site;
  links_[after].previous = site;
  names_[place] = std::min(names_[place], site);
}

Index Places::next_speaker(Index site) const {
  const Index speaker = speakers_[links_[site].place];
  if (site != speaker) return speaker;
  Index best = no_index;
  for (Index s = links_[site].next; s != site; s = links_[s].next) {
    if (best == no_index || predicates::is_raised_more(points_[s], points_[best])) best = s;
  }
  return best;
}

void Places::leave(Index site) {
  const Link link = links_[site];
  Index& name = names_[link.place];
  if (name == site && link.next != site) {
    name = link.next;
    for (Index s = links_[name].next; s != site; s = links_[s].next) name = std::min(name, s);
  }
  links_[link.previous].next = link.next;
  links_[link.next].previous = link.previous;
  links_[site] = {};
}

void Places::assign(std::span<const Point> points, std::span<const Index> place_of_site,
                    std::span<const Index> speakers) {
  points_.assign(points.begin(), points.end());
  speakers_.assign(speakers.begin(), speakers.end());
  names_ = speakers_;
  links_.assign(points.size(), {});
  for (Index place = 0; place < speakers.size(); ++place) {
    links_[speakers[place]] = {place, speakers[place], speakers[place]};
  }
  for (Index site = 0; site < points.size(); ++site) {
    if (links_[site].place == no_index) join(site, place_of_site[site]);
  }
  std::vector<blocks::HilbertKey> keys(speakers.size());
  std::vector<Index> places(speakers.size());
  for (Index place = 0; place < speakers.size(); ++place) {
    keys[place] = key(place_point(place));
    places[place] = place;
  }
  index_.assign(keys, places);
}

}  // namespace rondel::dynamic
