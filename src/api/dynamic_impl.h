// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The state of a DynamicTriangulation: the editor of its model, and what is needed when a change
// fails or all sites are on one great circle.
//
// in    sites, and changes of them
// out   what the editor holds: places, and in dimension 2 their hull
// index ids of sites, which stay when other sites are removed
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "dynamic/editor.h"
#include "models/projected_points.h"
#include "models/weighted_points.h"
#include "rondel/dynamic.h"
#include "system/mutex.h"

namespace rondel {

// A function that needs the hull calls current() first; one that needs the sites alone calls
// read_places(), which is enough after a failed change.
struct DynamicTriangulation::Impl {
  // Starts without sites. Precondition: the options were validated.
  explicit Impl(const Options& wanted);

  // Returns function(editor), for the editor of the model.
  template <class Function>
  decltype(auto) visit(Function&& function) {
    return std::visit(std::forward<Function>(function), editor);
  }
  template <class Function>
  decltype(auto) visit(Function&& function) const {
    return std::visit(std::forward<Function>(function), editor);
  }

  // Returns the places of the sites: their points, and which ids share a place.
  [[nodiscard]] const dynamic::Places& places() const {
    return visit([](const auto& e) -> const dynamic::Places& { return e.places(); });
  }

  // Returns read(places). After a change has failed the places are written anew under the lock, by
  // functions that are const, so reading takes the lock, too.
  template <class Read>
  auto read_places(const Read& read) const {
    if (!is_in_pieces) return read(places());
    const std::lock_guard guard(mutex);
    return read(places());
  }

  // True if a site has this id: it was inserted and not removed.
  [[nodiscard]] bool is_alive(Index id) const {
    return read_places([id](const auto& places) { return places.is_alive(id); });
  }

  // Each of these three throws InvalidInput, which names the position in the argument: if no site
  // has the id; if an id is repeated or no site has it; if there would be more than max_sites.
  void require_site(Index id, std::size_t position) const;
  void require_distinct_sites(std::span<const Index> ids) const;
  void require_room(std::size_t more) const;

  // Replaces places and hull by those of a build. Site i of the triangulation has the id ids[i],
  // and `ids` has all sites that there are.
  void assign(const Triangulation& triangulation, std::span<const Index> ids,
              const Execution& execution);

  // Triangulates the sites that there are, and replaces places and hull by the result.
  void rebuild(const Execution& execution);

  // Returns *this, with places and hull that follow from the sites: they are made anew if a change
  // has failed. Several threads may call it.
  Impl& current();

  // Returns current(), with an index of places that is that of the present points, which searches and
  // changes of some sites need. Several threads may call it.
  Impl& indexed();

  // Returns change(editor). A change that throws leaves the sites as they were, but places and hull
  // in pieces; current() mends them later.
  template <class Change>
  decltype(auto) change(const Change& change) {
    indexed();
    return change_all(change);
  }
  // Does so for a change that looks up no place.
  template <class Change>
  decltype(auto) change_all(const Change& change) {
    current();
    flat.reset();
    ++num_changes;
    try {
      return visit(change);
    } catch (...) {
      is_in_pieces = true;
      throw;
    }
  }

  // Returns copies of the points of the sites with these ids.
  [[nodiscard]] Sites sites_of(std::span<const Index> ids) const;

  // True in dimension 2. Below it there is no hull to ask, and flat_snapshot() answers.
  [[nodiscard]] bool has_hull() const {
    return visit([](const auto& e) { return e.hull().has_value(); });
  }
  // Returns the triangulation below dimension 2, made when first needed and kept until the next
  // change; flat_ring() returns the ids of its vertices around the great circle.
  [[nodiscard]] const Snapshot& flat_snapshot() const;
  [[nodiscard]] std::vector<Index> flat_ring() const;

  Options options;
  // The alternative is that of options.model, from the constructor on.
  std::variant<dynamic::Editor<models::ProjectedPoints>, dynamic::Editor<models::WeightedPoints>>
      editor;
  // True after a change has failed, until current() has made places and hull anew.
  std::atomic<bool> is_in_pieces = false;
  // True after all sites have moved, until indexed() has sorted the index of their places.
  std::atomic<bool> has_old_index = false;
  mutable system::Mutex mutex;
  // The result of flat_snapshot(); without a value if it was not asked for since the last change.
  mutable std::optional<Snapshot> flat;
  std::uint64_t num_changes = 0;  // those that failed, too
};

}  // namespace rondel
