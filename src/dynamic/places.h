// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites with stable ids that come and go, and the places where they are. Duplicates share a place;
// the lexicographically smallest of their triples speaks for it.
#pragma once

#include <array>
#include <compare>
#include <set>
#include <span>
#include <vector>

#include "dynamic/renumbering.h"
#include "order/hilbert.h"
#include "order/spatial_index.h"
#include "order/spatial_order.h"
#include "predicates/perturbation.h"
#include "rondel/export.h"
#include "rondel/types.h"
#include "system/prefetch.h"

namespace rondel::dynamic {

class RONDEL_API Places {
 public:
  Places(Model model, const Point& center) : model_(model), center_(center) {}
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  // --- sites ---

  [[nodiscard]] std::size_t num_sites() const { return num_sites_; }
  // Ids are below this.
  [[nodiscard]] Index site_limit() const { return static_cast<Index>(points_.size()); }
  [[nodiscard]] bool is_alive(Index site) const {
    return site < points_.size() && place_of_[site] != no_index;
  }
  [[nodiscard]] const Point& point(Index site) const { return points_[site]; }
  [[nodiscard]] Index place_of(Index site) const { return place_of_[site]; }

  // An id for a new site, which is not at any place yet: one that was freed, else the next one.
  Index add_site();
  void free_site(Index site);
  void set_point(Index site, const Point& p) { points_[site] = p; }

  // For a range of changes that a build follows: a new site is there, or one is there no longer.
  // Places mean nothing then, until assign() makes them anew.
  void expect(Index site) { place_of_[site] = 0; }
  void drop(Index site) {
    place_of_[site] = no_index;
    free_site(site);
  }

  // After a change that failed: these sites are there, or not, as before. Places, and what is made
  // of them, mean nothing then, until assign() makes them anew.
  void roll_back(std::span<const Index> sites, bool are_there) noexcept;

  // --- places ---

  // Places are below this.
  [[nodiscard]] Index place_limit() const { return static_cast<Index>(representatives_.size()); }
  // For the traits class of the model: points by site, and the site that speaks for each place.
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  [[nodiscard]] std::span<const Index> representatives() const { return representatives_; }
  [[nodiscard]] const Point& place_point(Index place) const {
    return points_[representatives_[place]];
  }

  [[nodiscard]] order::HilbertKey key(const Point& p) const {
    return order::place_key(p, model_, center_);
  }
  // Where a point belongs; until the next change.
  struct Spot {
    order::HilbertKey key;
    order::SpatialIndex::Position position;
    Index place = no_index;  // of the point, exactly
    Index close = no_index;  // some place close to it, if there is any
    std::array<Index, order::SpatialIndex::num_around> around;  // more of them, or no_index
  };
  [[nodiscard]] Spot look_up(const Point& p) const;
  // A place close to p, or no_index.
  [[nodiscard]] Index near(const Point& p) const { return index_.near(key(p)); }
  // Asks for the memory that changes at this site, or around this key, will need.
  void prefetch(Index site) const {
    system::prefetch(&points_[site]);
    system::prefetch(&representatives_[place_of_[site]]);
    system::prefetch(&names_[place_of_[site]]);
  }
  void prefetch(const order::HilbertKey& key) const { index_.prefetch(key); }
  [[nodiscard]] std::size_t num_places() const { return index_.size(); }
  // All places in spatial order.
  [[nodiscard]] std::vector<Index> in_order() const { return index_.values(); }
  // By place, the lowest of its sites.
  [[nodiscard]] std::span<const Index> names() const { return names_; }

  // A new place for the site alone, at the spot of its point.
  Index add_place(Index site, const Spot& spot);
  // Precondition: the place has no site left.
  void free_place(Index place, const order::HilbertKey& key);

  // Whether the site, once there, would speak for the place.
  [[nodiscard]] bool would_speak(Index site, Index place) const;
  void join(Index site, Index place);
  // The site that speaks when this one leaves its place; no_index when nobody is left.
  [[nodiscard]] Index next_representative(Index site) const;
  void leave(Index site);
  void set_representative(Index place, Index site) { representatives_[place] = site; }

  void renumber(const Renumbering& places);

  // --- all sites move at once ---

  // After set_point() for all of them: whether duplicates still share their places. Then each place
  // has the site that speaks for it. The index of places is that of the old points until
  // sort_index() is called: before it nothing may be looked up, come or go.
  [[nodiscard]] bool keep_residents();
  void sort_index();

  // The sites 0, 1, 2 ... of an object that has none. assign() follows.
  void assign_points(std::span<const Point> points);
  // Takes the result of a build: of each site the place, of those that are not there no_index.
  // Places are in spatial order. If it throws, nothing is lost but places.
  void assign(std::span<const Index> place_of_site, std::span<const Index> representatives);

 private:
  // keys[i] is that of places[i].
  [[nodiscard]] std::vector<order::HilbertKey> keys_of(std::span<const Index> places) const;

  // Places with several sites list them twice, so that whoever leaves has a successor at once: by
  // name, and by who speaks.
  struct Resident {
    Index place;
    Index site;
    friend auto operator<=>(const Resident&, const Resident&) = default;
  };
  struct SpeaksBefore {
    using is_transparent = void;
    const std::vector<Point>* points;
    bool operator()(const Resident& a, const Resident& b) const;
    bool operator()(const Resident& a, Index place) const { return a.place < place; }
  };

  // How the index orders weighted places of equal keys. In the projected model these are so close
  // that they are few.
  [[nodiscard]] auto order_of(const Point& p) const {
    return [this, &p](Index place) {
      return model_ == Model::weighted &&
             predicates::is_lexicographically_less(place_point(place), p);
    };
  }

  void count_sites() noexcept;
  void insert(const Resident& resident);
  void erase(const Resident& resident);

  Model model_;
  Point center_;
  // The sites themselves, and whether they are there; all else follows from these two.
  std::vector<Point> points_;
  std::vector<Index> place_of_;
  std::size_t num_sites_ = 0;

  std::vector<Index> representatives_;
  std::vector<Index> names_;
  std::vector<Index> free_sites_;  // all that are not there; after roll_back() none
  std::vector<Index> free_places_;
  std::set<Resident> by_name_;
  std::set<Resident, SpeaksBefore> by_triple_{SpeaksBefore{&points_}};
  order::SpatialIndex index_;
};

}  // namespace rondel::dynamic
