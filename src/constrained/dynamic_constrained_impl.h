// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The state of a DynamicConstrainedTriangulation: dynamic::Editor, whose hull is a ConstrainedHull,
// and the constraints by id.
//
// The hull knows constraints by its edges alone. When the editor makes a hull, since a site has
// left the great circle of all others, all constraints are inserted. Below dimension 2 there is no
// hull, and constrained_delaunay() answers.
//
// in    sites and constraints, and changes of them
// out   what the editor and its hull hold
// index ids of sites and of constraints, which stay when others are removed
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

#include "constrained/constrained_hull.h"
#include "constrained/dynamic_constraints.h"
#include "constrained/place_directions.h"
#include "dynamic/editor.h"
#include "rondel/dynamic_constrained.h"
#include "system/mutex.h"

namespace rondel {

struct DynamicConstrainedTriangulation::Impl {
  using Ends = std::array<Index, 2>;
  using Editor = dynamic::Editor<constrained::PlaceDirections, constrained::ConstrainedHull>;

  explicit Impl(const Sphere& its_sphere)
      : sphere(its_sphere), editor(Model::projected, its_sphere.center) {}

  [[nodiscard]] const dynamic::Places& places() const { return editor.places(); }
  [[nodiscard]] Index place_of(Index site) const { return places().place_of(site); }
  [[nodiscard]] bool has_hull() const { return editor.hull().has_value(); }

  // Returns read(places). After a change has failed the places are written anew under the lock, by
  // functions that are const, so reading takes the lock, too.
  template <class Read>
  auto read_places(const Read& read) const {
    if (!is_in_pieces) return read(places());
    const std::lock_guard guard(mutex);
    return read(places());
  }

  // These throw InvalidInput if there is none with this id.
  void require_site(Index site, std::size_t position = 0) const;
  void require_constraint(Index constraint) const;
  void require_valid(const Point& site) const;

  // Returns the error that two constraints cross, one of which may be new.
  [[nodiscard]] CrossingConstraints crossing(Index one, const Ends& ends, Index other) const;

  // Takes the triangulation of all sites and constraints. Site i of it has the id site_ids[i], and
  // constraint i the id constraint_ids[i].
  void assign(const ConstrainedTriangulation& built, std::span<const Index> site_ids,
              std::span<const Index> constraint_ids, const Execution& execution);
  // Triangulates the sites and constraints that there are.
  [[nodiscard]] ConstrainedSnapshot build(const Execution& execution) const;

  // Returns *this, with places and hull that follow from the sites and the constraints: they are
  // made anew if a change has failed. Several threads may call it.
  Impl& current();

  // Returns change(editor). A change that throws leaves the sites as they were, but places and hull
  // in pieces; current() mends them later.
  template <class Change>
  auto change(const Change& change) {
    try {
      return change(editor);
    } catch (...) {
      is_in_pieces = true;
      throw;
    }
  }
  // Inserts all constraints into a hull that has none, at the end of a change by which a site has
  // come or gone. If that fails, the site is there as it was before.
  void constrain_hull(Index site, bool was_there);

  // Returns the vertices around a great circle, below dimension 2.
  [[nodiscard]] std::vector<Index> flat_ring() const;

  Sphere sphere;
  Editor editor;
  constrained::DynamicConstraints constraints;
  // True after a change has failed, until current() has made places and hull anew.
  std::atomic<bool> is_in_pieces = false;
  mutable system::Mutex mutex;
};

}  // namespace rondel
