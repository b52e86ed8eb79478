// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// What a DynamicTriangulation holds: the editor of its model.
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

struct DynamicTriangulation::Impl {
  explicit Impl(const Options& wanted);

  template <class Function>
  decltype(auto) visit(Function&& function) {
    return std::visit(std::forward<Function>(function), editor);
  }
  template <class Function>
  decltype(auto) visit(Function&& function) const {
    return std::visit(std::forward<Function>(function), editor);
  }

  [[nodiscard]] const dynamic::Places& places() const {
    return visit([](const auto& e) -> const dynamic::Places& { return e.places(); });
  }

  // read(places), which are written anew under the lock after a change has failed: functions that
  // are const may be called meanwhile.
  template <class Read>
  auto read_places(const Read& read) const {
    if (!is_in_pieces) return read(places());
    const std::lock_guard guard(mutex);
    return read(places());
  }

  [[nodiscard]] bool is_alive(Index id) const {
    return read_places([id](const auto& places) { return places.is_alive(id); });
  }

  // Each throws InvalidInput, which names the position in the argument.
  void require_site(Index id, std::size_t position) const;
  void require_distinct_sites(std::span<const Index> ids) const;
  void require_room(std::size_t more) const;

  // Takes a build of sites; `ids` are theirs, of all that are there.
  void assign(const Triangulation& triangulation, std::span<const Index> ids,
              const Execution& execution);

  // Makes all that follows from the sites anew.
  void rebuild(const Execution& execution);

  // Returns *this, after what follows from the sites was made anew if a change has failed. Several
  // threads may ask.
  Impl& current();

  // A change that throws leaves the sites as they were.
  template <class Change>
  decltype(auto) change(const Change& change) {
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

  // The sites with these ids.
  [[nodiscard]] Sites sites_of(std::span<const Index> ids) const;

  // Below dimension 2 there is no hull to ask. A snapshot answers, made when first needed.
  [[nodiscard]] bool has_hull() const {
    return visit([](const auto& e) { return e.hull().has_value(); });
  }
  [[nodiscard]] const Snapshot& flat_snapshot() const;
  [[nodiscard]] std::vector<Index> flat_ring() const;

  Options options;
  std::variant<dynamic::Editor<models::ProjectedPoints>, dynamic::Editor<models::WeightedPoints>>
      editor;
  std::atomic<bool> is_in_pieces = false;
  mutable system::Mutex mutex;
  mutable std::optional<Snapshot> flat;
  std::uint64_t num_changes = 0;  // those that failed, too
};

}  // namespace rondel
