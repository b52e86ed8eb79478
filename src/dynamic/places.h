// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// Sites with stable ids that come and go, and the places where they are. Duplicates share a place;
// the lexicographically smallest of their triples speaks for it.
#pragma once

#include <span>
#include <vector>

#include "blocks/hilbert.h"
#include "blocks/spatial_index.h"
#include "rondel/types.h"

namespace rondel::dynamic {

class Places {
 public:
  Places(Model model, const Point& center) : model_(model), center_(center) {}

  // --- sites ---

  [[nodiscard]] std::size_t num_sites() const { return points_.size() - free_sites_.size(); }
  // Ids are below this.
  [[nodiscard]] Index site_limit() const { return static_cast<Index>(points_.size()); }
  [[nodiscard]] bool is_alive(Index site) const {
    return site < points_.size() && links_[site].place != no_index;
  }
  [[nodiscard]] const Point& point(Index site) const { return points_[site]; }
  [[nodiscard]] Index place_of(Index site) const { return links_[site].place; }

  // An id for a new site, which is not at any place yet: one that was freed, else the next one.
  Index add_site();
  void free_site(Index site);
  void set_point(Index site, const Point& p) { points_[site] = p; }

  // --- places ---

  [[nodiscard]] std::size_t num_places() const { return speakers_.size() - free_places_.size(); }
  // Places are below this.
  [[nodiscard]] Index place_limit() const { return static_cast<Index>(speakers_.size()); }
  // For the traits class of the model: points by site, and the site that speaks for each place.
  [[nodiscard]] std::span<const Point> points() const { return points_; }
  [[nodiscard]] std::span<const Index> speakers() const { return speakers_; }
  [[nodiscard]] const Point& place_point(Index place) const { return points_[speakers_[place]]; }

  [[nodiscard]] blocks::HilbertKey key(const Point& p) const;
  // The place of p, exactly, or no_index.
  [[nodiscard]] Index find(const Point& p, const blocks::HilbertKey& key) const;
  // A place close to the key, or no_index.
  [[nodiscard]] Index near(const blocks::HilbertKey& key) const { return index_.near(key); }
  // All places in spatial order.
  [[nodiscard]] std::vector<Index> in_order() const { return index_.values(); }
  // By place, the lowest of its sites.
  [[nodiscard]] std::span<const Index> names() const { return names_; }

  // A new place for the site alone.
  Index add_place(Index site, const blocks::HilbertKey& key);
  // Precondition: the place has no site left.
  void free_place(Index place, const blocks::HilbertKey& key);

  // Whether the site, once there, would speak for the place.
  [[nodiscard]] bool would_speak(Index site, Index place) const;
  void join(Index site, Index place);
  // The site that speaks when this one leaves its place; no_index when nobody is left.
  [[nodiscard]] Index next_speaker(Index site) const;
  void leave(Index site);
  void set_speaker(Index place, Index site) { speakers_[place] = site; }

  // Takes the result of a build. Places are in spatial order.
  void assign(std::span<const Point> points, std::span<const Index> place_of_site,
              std::span<const Index> speakers);

 private:
  // The sites at a place form a ring.
  struct Link {
    Index place = no_index;
    Index next = no_index;
    Index previous = no_index;
  };

  Model model_;
  Point center_;
  std::vector<Point> points_;
  std::vector<Link> links_;
  std::vector<Index> speakers_;
  std::vector<Index> names_;
  std::vector<Index> free_sites_;
  std::vector<Index> free_places_;
  blocks::SpatialIndex index_;
};

}  // namespace rondel::dynamic
