// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// A triangulation that changes: sites with stable ids, the places that they share, and the hull
// of the places.
//
// While all places lie in one plane with the center there is no hull (dimension 1 and below). The
// first place off that plane starts it; when the last one leaves, it is given up.
//
// A change may throw, for want of memory, while places and hull are in pieces. Then the sites are
// what they were before the change, and nothing else can be asked for, until a build from these
// sites is assigned.
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dynamic/flip_mender.h"
#include "dynamic/place_hull.h"
#include "dynamic/places.h"
#include "dynamic/renumbering.h"
#include "kernel/brio.h"
#include "kernel/great_circle.h"
#include "models/sphere_traits.h"
#include "order/along_the_curve.h"
#include "query/graph.h"
#include "system/job.h"
#include "system/large_arrays.h"
#include "system/on_failure.h"

namespace rondel::dynamic {

// Hull is PlaceHull, or what has its functions: constrained::ConstrainedHull.
template <models::SphereModel T, class Hull = PlaceHull<T>>
class Editor {
 public:
  Editor(Model model, const Point& center)
      : center_(center), places_(model, center), sites_({}, {}, center) {}
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  [[nodiscard]] const Places& places() const { return places_; }
  [[nodiscard]] const T& sites() const { return sites_; }
  // The hull of the places, whose vertices are their numbers; none below dimension 2.
  [[nodiscard]] const std::optional<Hull>& hull() const { return hull_; }
  // For changes that leave the places alone. If one fails after a site has come or gone,
  // roll_back() says whether it is there.
  [[nodiscard]] std::optional<Hull>& hull() { return hull_; }
  void roll_back(Index site, bool is_there) noexcept { places_.roll_back({&site, 1}, is_there); }

  // For queries, as long as nothing changes. Precondition: there is a hull.
  [[nodiscard]] query::SurfaceGraph<T> graph() const {
    return {sites_,          hull_->mesh(),       hull_->kinds(),     hull_->corners(),
            places_.names(), hull_->solid_face(), hull_->entry_face()};
  }
  // A vertex close to p. Precondition: there is a hull.
  [[nodiscard]] Index vertex_near(const Point& p) const {
    const Index place = places_.near(p);
    if (hull_->is_vertex(place)) return place;
    return hull_->mesh()[hull_->hidden().solid_face(place)].vertex[0];
  }

  // `hint` is a site close to p, or no_index: the place to start is looked up.
  Index insert(const Point& p, Index hint) {
    const Index site = places_.add_site();
    system::OnFailure undo([&] { places_.roll_back({&site, 1}, false); });
    sites_.rebind(places_.points(), places_.representatives());
    arrive(site, p, hint);
    renumber_if_due();
    undo.succeed();
    return site;
  }

  // Ids in the order of `points`, although they are inserted in rounds along the spatial order.
  std::vector<Index> insert(std::span<const Point> points, const Execution& execution) {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    order::sort_along_the_curve(order, [&](Index i) { return places_.key(points[i]); });
    std::vector<Index> ids;
    ids.reserve(points.size());
    system::OnFailure undo([&] { places_.roll_back(ids, false); });
    while (ids.size() < points.size()) ids.push_back(places_.add_site());
    sites_.rebind(places_.points(), places_.representatives());
    std::size_t num_done = 0;
    for (const Index rank : kernel::insertion_order(static_cast<Index>(points.size()))) {
      arrive(ids[order[rank]], points[order[rank]], no_index);
      renumber_if_due();
      report(execution, ++num_done, points.size());
    }
    undo.succeed();
    return ids;
  }

  void remove(Index site) {
    system::OnFailure undo([&] { places_.roll_back({&site, 1}, true); });
    depart(site);
    places_.free_site(site);
    renumber_if_due();
    undo.succeed();
  }

  // Backwards in the order in which a range is inserted: what is close leaves together, and what
  // remains is spread evenly. Numbers of places are close enough to the spatial order.
  void remove(std::span<const Index> sites, const Execution& execution) {
    std::vector<std::pair<Index, Index>> order;
    order.reserve(sites.size());
    for (const Index site : sites) order.emplace_back(places_.place_of(site), site);
    std::ranges::sort(order);
    std::vector<Index> ranks = kernel::insertion_order(static_cast<Index>(sites.size()));
    std::ranges::reverse(ranks);
    system::OnFailure undo([&] { places_.roll_back(sites, true); });
    std::size_t num_done = 0;
    for (const Index rank : ranks) {
      depart(order[rank].second);
      renumber_if_due();
      report(execution, ++num_done, sites.size());
    }
    for (const Index site : sites) places_.free_site(site);
    undo.succeed();
  }

  // One after the other; a site may appear again.
  void move(std::span<const Index> sites, std::span<const Point> to, const Execution& execution) {
    std::vector<Point> from;
    from.reserve(sites.size());
    system::OnFailure undo([&] { restore(sites, from); });
    for (std::size_t i = 0; i < sites.size(); ++i) {
      from.push_back(places_.point(sites[i]));
      depart(sites[i]);
      arrive(sites[i], to[i], no_index);
      renumber_if_due();
      report(execution, i + 1, sites.size());
    }
    undo.succeed();
  }

  // Changes of ranges, where `build` takes the result of a build of all sites that
  // are then there, by assign().
  template <class Build>
  std::vector<Index> insert(std::span<const Point> points, const Build& build) {
    std::vector<Index> ids;
    ids.reserve(points.size());
    system::OnFailure undo([&] { places_.roll_back(ids, false); });
    for (const Point& p : points) {
      ids.push_back(places_.add_site());
      places_.expect(ids.back());
      places_.set_point(ids.back(), p);
    }
    build();
    undo.succeed();
    return ids;
  }
  template <class Build>
  void remove(std::span<const Index> sites, const Build& build) {
    system::OnFailure undo([&] { places_.roll_back(sites, true); });
    for (const Index site : sites) places_.drop(site);
    build();
    undo.succeed();
  }
  template <class Build>
  void move(std::span<const Index> sites, std::span<const Point> to, const Build& build) {
    std::vector<Point> from;
    from.reserve(sites.size());
    system::OnFailure undo([&] { restore(sites, from); });
    for (std::size_t i = 0; i < sites.size(); ++i) {
      from.push_back(places_.point(sites[i]));
      places_.set_point(sites[i], to[i]);
    }
    build();
    undo.succeed();
  }

  // Moves all sites that there are, by flips or by `build`. Returns whether it was by flips: then
  // sort_index() has to be called before anything but this.
  template <class Build>
  bool move_all(std::span<const Index> sites, std::span<const Point> to, unsigned threads,
                const Build& build) {
    std::vector<Point> from;
    system::reserve_large(from, places_.points().size());
    from.assign(places_.points().begin(), places_.points().end());
    const auto set_points = [&] {
      for (std::size_t i = 0; i < sites.size(); ++i) places_.set_point(sites[i], to[i]);
    };
    system::OnFailure undo([&] {
      for (const Index site : sites) places_.set_point(site, from[site]);
      places_.roll_back(sites, true);
    });
    set_points();
    const bool is_mended = mend(from, threads);
    if (!is_mended) {
      set_points();  // some may have gone back
      build();
    }
    undo.succeed();
    return is_mended;
  }
  void sort_index() { places_.sort_index(); }

  // Takes the result of a build, instead of inserting each. At first assign_points(); then
  // `mesh` has places for vertices, `hidden` are pairs of a place and a vertex close to it.
  void assign_points(std::span<const Point> points) { places_.assign_points(points); }
  void assign(std::span<const Index> place_of_site, std::span<const Index> representatives) {
    hull_.reset();
    span_.clear();
    places_.assign(place_of_site, representatives);
    sites_.assign(places_.points(), places_.representatives(), center_);
    schedule_.done(places_.num_places());
  }
  void adopt(topology::Mesh mesh, std::span<const std::array<Index, 2>> hidden) {
    hull_.emplace(sites_, std::move(mesh));
    if constexpr (T::hides_sites) {
      for (const auto& [place, close] : hidden) hull_->attach_hidden(place, close);
    }
  }
  void adopt_flat() { rebuild(no_index); }

 private:
  // Between the changes of a range.
  static void report(const Execution& execution, std::size_t num_done, std::size_t num_changes) {
    if (num_done % 1024 != 0) return;
    system::obey_stop();
    system::announce(execution, "change", num_done, num_changes);
  }

  void refresh(Index place) { sites_.set(place, places_.points(), places_.representatives()); }

  // After a failed move: the first sites have left these points.
  void restore(std::span<const Index> sites, std::span<const Point> from) noexcept {
    for (std::size_t i = from.size(); i-- > 0;) places_.set_point(sites[i], from[i]);
    places_.roll_back(sites, true);
  }

  // After all sites have moved from `from`: mends the hull of their places by flips. False if it
  // cannot, or a build would take less time.
  [[nodiscard]] bool mend(std::span<const Point> from, unsigned threads) {
    if (!hull_ || !hull_->kinds().all_solid()) return false;
    // Hidden sites may meet where nothing is looked up.
    if (hull_->num_vertices() != places_.num_places() || !places_.keep_residents()) return false;
    const double square =
        sites_.move_all(places_.points(), places_.representatives(), hull_->corners(), threads);
    const auto late = FlipMender<T>(*hull_, places_, sites_, from).run(square, threads);
    if (!late) return false;
    for (const LateVertex& vertex : *late) {
      if (!put_elsewhere(vertex)) return false;
    }
    return hull_->num_vertices() == places_.num_places();
  }
  [[nodiscard]] bool put_elsewhere(const LateVertex& vertex) {
    if (!hull_->is_vertex(vertex.place)) return false;
    const std::span<const Index> link = hull_->collect_star(vertex.place);
    if (leaves_flat(link)) return false;
    const Index close = link.front();
    hull_->remove_vertex(vertex.place);
    places_.set_point(places_.representatives()[vertex.place], vertex.to);
    refresh(vertex.place);
    return hull_->kinds().all_solid() && hull_->insert_vertex(vertex.place, close);
  }

  // Only between changes: it makes all numbers of places and faces invalid.
  void renumber_if_due() {
    if (!schedule_.is_due(places_.num_places())) return;
    schedule_.done(places_.num_places());
    const Renumbering renumbering(places_.in_order(), places_.place_limit());
    places_.renumber(renumbering);
    sites_.reorder(renumbering.old_place, renumbering.room());
    sites_.rebind(places_.points(), places_.representatives());
    if (hull_) hull_->renumber(renumbering);
    for (Index& place : span_) place = renumbering.new_place[place];
  }

  void arrive(Index site, const Point& p, Index hint) {
    places_.set_point(site, p);
    const Places::Spot spot = places_.look_up(p);
    Index place = spot.place;
    if (place == no_index) {
      const Index close = hint != no_index ? places_.place_of(hint) : spot.close;
      if (hull_) {
        for (const Index other : spot.around) hull_->prefetch(other);
      }
      place = places_.add_place(site, spot);
      refresh(place);
      if (hull_) {
        for (const Index other : spot.around) hull_->prefetch_face(other);
      }
      put_in(place, close);
      return;
    }
    const bool speaks = places_.would_speak(site, place);
    if (speaks) take_out(place);
    places_.join(site, place);
    if (!speaks) return;
    places_.set_representative(place, site);
    refresh(place);
    put_in(place, no_index);
  }

  void depart(Index site) {
    const Index place = places_.place_of(site);
    places_.prefetch(site);
    if (hull_) hull_->prefetch(place);
    const Index next = places_.next_representative(site);
    if (next == no_index) {
      const order::HilbertKey key = places_.key(places_.point(site));
      if (hull_) hull_->prefetch_face(place);
      places_.prefetch(key);
      take_out(place);
      places_.leave(site);
      places_.free_place(place, key);
      return;
    }
    // On one ray, other coordinates mean another rank among ties.
    const bool is_other = places_.point(next) != places_.place_point(place);
    if (is_other) take_out(place);
    places_.leave(site);
    places_.set_representative(place, next);
    refresh(place);
    if (is_other) put_in(place, no_index);
  }

  void put_in(Index place, Index close) {
    if (hull_) {
      hull_->insert(place, close);
      return;
    }
    widen_span(place);
    if (span_.size() == 3) build(places_.in_order());
  }

  bool widen_span(Index place) {
    std::vector<Index> wider = span_;
    wider.push_back(place);
    if (find_span(wider).size() < wider.size()) return false;
    span_ = std::move(wider);
    return true;
  }

  // When a place leaves the span, at most one other can take its part.
  void leave_span(Index place) {
    if (std::erase(span_, place) == 0) return;
    for (const Index other : places_.in_order()) {
      if (other != place && widen_span(other)) return;
    }
  }

  void take_out(Index place) {
    if (!hull_) {
      leave_span(place);
      return;
    }
    if constexpr (T::hides_sites) {
      if (!hull_->is_vertex(place)) {
        hull_->remove_hidden(place);
        return;
      }
    }
    if (!leaves_flat(hull_->collect_star(place))) {
      hull_->remove_vertex(place);
    } else {
      hull_.reset();
      rebuild(place);
    }
  }

  // Whether the vertices but the one with this link lie in one plane with the center: then all are
  // in the link.
  [[nodiscard]] bool leaves_flat(std::span<const Index> link) const {
    if (hull_->num_vertices() == 3) return true;
    return link.size() + 1 == hull_->num_vertices() && find_span(link).size() < 3;
  }

  // From all places but one, or all.
  void rebuild(Index left_out) {
    std::vector<Index> order = places_.in_order();
    std::erase(order, left_out);
    span_ = find_span(order);
    if (span_.size() == 3) build(order);
  }

  void build(const std::vector<Index>& order) {
    hull_.emplace(sites_, std::array{span_[0], span_[1], span_[2]});
    for (const Index rank : kernel::insertion_order(static_cast<Index>(order.size()))) {
      const Index place = order[rank];
      if (std::ranges::find(span_, place) == span_.end()) hull_->insert(place, no_index);
    }
    span_.clear();
  }

  // Places that span the most, as in kernel/great_circle.h.
  [[nodiscard]] std::vector<Index> find_span(std::span<const Index> places) const {
    std::vector<Point> points;
    points.reserve(places.size());
    for (const Index place : places) points.push_back(places_.place_point(place));
    std::vector<Index> span = kernel::find_span(points, center_);
    for (Index& i : span) i = places[i];
    return span;
  }

  Point center_;
  Places places_;
  T sites_;
  std::optional<Hull> hull_;
  std::vector<Index> span_;  // without a hull
  RenumberingSchedule schedule_;
};

}  // namespace rondel::dynamic
