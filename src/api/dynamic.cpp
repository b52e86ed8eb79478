// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// DynamicTriangulation: every function validates its arguments, then changes or asks the editor of
// the model. A range of changes that is long compared with the sites is made by a new build.

#include "rondel/dynamic.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "api/dynamic_impl.h"
#include "api/triangulation_impl.h"
#include "api/validation.h"
#include "dynamic/snapshot.h"
#include "query/engine.h"
#include "rondel/delaunay.h"
#include "rondel/error.h"
#include "system/job.h"

namespace rondel {
namespace {

// The time of one change in a range, in units of the time that a build takes for a site
// (docs/guide/editing.md).
constexpr double builds_of_insertion = 1.75;
constexpr double builds_of_removal = 1.5;
constexpr double builds_of_move = 4;

// True if a range of changes takes longer than a build of the `num_sites` sites that are there
// afterwards.
bool is_build_faster(std::size_t num_changes, double builds_of_change, std::size_t num_sites) {
  return builds_of_change * static_cast<double>(num_changes) > static_cast<double>(num_sites);
}

}  // namespace

DynamicTriangulation::Impl::Impl(const Options& wanted)
    : options(wanted), editor(std::in_place_index<0>, Model::projected, options.sphere.center) {
  if (options.model == Model::weighted) {
    editor.emplace<1>(Model::weighted, options.sphere.center);
  }
}

void DynamicTriangulation::Impl::require_site(Index id, std::size_t position) const {
  if (is_alive(id)) return;
  throw InvalidInput("site " + std::to_string(id) + " does not exist", position);
}

void DynamicTriangulation::Impl::require_distinct_sites(std::span<const Index> ids) const {
  // Ids are sorted up to the first that no site has, with their positions: a repeated id before it
  // is the earlier flaw, and is named.
  std::vector<std::pair<Index, std::size_t>> sorted;
  sorted.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size() && places().is_alive(ids[i]); ++i) {
    sorted.emplace_back(ids[i], i);
  }
  const std::size_t first_missing = sorted.size();
  std::ranges::sort(sorted);
  std::size_t first_repeated = ids.size();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    first_repeated = std::min(first_repeated, sorted[i].second);
  }
  if (first_repeated < ids.size()) {
    throw InvalidInput("site " + std::to_string(ids[first_repeated]) + " appears twice",
                       first_repeated);
  }
  if (first_missing < ids.size()) require_site(ids[first_missing], first_missing);
}

void DynamicTriangulation::Impl::require_room(std::size_t more) const {
  if (more <= max_sites - places().num_sites()) return;
  throw InvalidInput(std::to_string(places().num_sites() + more) + " sites are more than the " +
                         std::to_string(max_sites) + " that one triangulation can hold",
                     max_sites - places().num_sites());
}

void DynamicTriangulation::Impl::assign(const Triangulation& triangulation,
                                        std::span<const Index> ids, const Execution& execution) {
  has_old_index = false;  // what follows makes it anew, or fails
  // The build numbers places itself; ids get the places of the sites that they name.
  dynamic::Build build = dynamic::make_build(triangulation, execution.threads);
  std::vector<Index> place_of_id(places().site_limit(), no_index);
  for (std::size_t i = 0; i < ids.size(); ++i) place_of_id[ids[i]] = build.place_of_site[i];
  for (Index& representative : build.representatives) representative = ids[representative];
  visit([&](auto& e) {
    e.assign(place_of_id, build.representatives);
    if (triangulation.dimension() == 2) {
      e.adopt(std::move(build.mesh), build.hidden);
    } else {
      e.adopt_flat();
    }
  });
}

void DynamicTriangulation::Impl::rebuild(const Execution& execution) {
  const std::vector<Index> ids = dynamic::live_sites(places());
  assign(delaunay(sites_of(ids), options, execution), ids, execution);
}

DynamicTriangulation::Impl& DynamicTriangulation::Impl::current() {
  if (!is_in_pieces) return *this;
  const std::lock_guard guard(mutex);
  if (is_in_pieces) {
    rebuild({.threads = 1});  // under a lock, which no thread may hold while it waits for others
    is_in_pieces = false;
  }
  return *this;
}

DynamicTriangulation::Impl& DynamicTriangulation::Impl::indexed() {
  current();
  if (!has_old_index) return *this;
  const std::lock_guard guard(mutex);
  if (has_old_index) {
    try {
      visit([](auto& e) { e.sort_index(); });
    } catch (...) {
      is_in_pieces = true;
      throw;
    }
    has_old_index = false;
  }
  return *this;
}

Sites DynamicTriangulation::Impl::sites_of(std::span<const Index> ids) const {
  std::vector<Point> sites;
  sites.reserve(ids.size());
  for (const Index id : ids) sites.push_back(places().point(id));
  return {std::move(sites)};
}

const Snapshot& DynamicTriangulation::Impl::flat_snapshot() const {
  const std::lock_guard guard(mutex);
  if (!flat) {
    Snapshot now;
    now.ids = dynamic::live_sites(places());
    now.triangulation = delaunay(sites_of(now.ids), options, {.threads = 1});
    flat = std::move(now);
  }
  return *flat;
}

std::vector<Index> DynamicTriangulation::Impl::flat_ring() const {
  // The ring has positions in the snapshot; its users ask for ids.
  const Snapshot& now = flat_snapshot();
  std::vector<Index> ring;
  for (const Index i : now.triangulation.ring()) ring.push_back(now.ids[i]);
  return ring;
}

DynamicTriangulation::DynamicTriangulation(const Options& options) {
  const system::ArithmeticScope arithmetic;
  api::validate({}, options);
  impl_ = std::make_unique<Impl>(options);
}

DynamicTriangulation::DynamicTriangulation(std::span<const Point> sites, const Options& options,
                                           const Execution& execution)
    : DynamicTriangulation(delaunay(Sites::view(sites), options, execution), execution) {}

DynamicTriangulation::DynamicTriangulation(const Triangulation& triangulation,
                                           const Execution& execution) {
  const system::Call call(execution);
  api::require_delaunay(triangulation, execution);
  const auto sites = triangulation.sites().points();
  impl_ = std::make_unique<Impl>(Options{triangulation.model(), triangulation.sphere()});
  impl_->visit([&](auto& e) { e.assign_points(sites); });
  std::vector<Index> ids(sites.size());
  std::iota(ids.begin(), ids.end(), Index{0});
  impl_->assign(triangulation, ids, execution);
}

DynamicTriangulation::~DynamicTriangulation() = default;
DynamicTriangulation::DynamicTriangulation(DynamicTriangulation&&) noexcept = default;
DynamicTriangulation& DynamicTriangulation::operator=(DynamicTriangulation&&) noexcept = default;

Index DynamicTriangulation::insert(const Point& site) {
  const system::ArithmeticScope arithmetic;
  api::validate({&site, 1}, impl_->options);
  impl_->require_room(1);
  return impl_->change([&](auto& e) { return e.insert(site, no_index); });
}

Index DynamicTriangulation::insert(const Point& site, Index hint) {
  const system::ArithmeticScope arithmetic;
  api::validate({&site, 1}, impl_->options);
  impl_->require_site(hint, 0);
  impl_->require_room(1);
  return impl_->change([&](auto& e) { return e.insert(site, hint); });
}

std::vector<Index> DynamicTriangulation::insert(std::span<const Point> sites,
                                                const Execution& execution) {
  const system::Call call(execution);
  api::validate(sites, impl_->options);
  impl_->require_room(sites.size());
  const bool is_rebuilt =
      is_build_faster(sites.size(), builds_of_insertion, num_sites() + sites.size());
  return impl_->change([&](auto& e) {
    return is_rebuilt ? e.insert(sites, [&] { impl_->rebuild(execution); })
                      : e.insert(sites, execution);
  });
}

void DynamicTriangulation::remove(Index id) {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(id, 0);
  impl_->change([&](auto& e) { e.remove(id); });
}

void DynamicTriangulation::remove(std::span<const Index> ids, const Execution& execution) {
  const system::Call call(execution);
  impl_->require_distinct_sites(ids);
  const bool is_rebuilt = is_build_faster(ids.size(), builds_of_removal, num_sites() - ids.size());
  impl_->change([&](auto& e) {
    is_rebuilt ? e.remove(ids, [&] { impl_->rebuild(execution); }) : e.remove(ids, execution);
  });
}

void DynamicTriangulation::move(Index id, const Point& to) {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(id, 0);
  api::validate({&to, 1}, impl_->options);
  impl_->change([&](auto& e) { e.move({&id, 1}, {&to, 1}, {}); });
}

void DynamicTriangulation::move(std::span<const Index> ids, std::span<const Point> to,
                                const Execution& execution) {
  const system::Call call(execution);
  if (ids.size() != to.size()) {
    throw InvalidInput("there are " + std::to_string(to.size()) + " points for " +
                           std::to_string(ids.size()) + " sites to move",
                       std::min(ids.size(), to.size()));
  }
  // An id may be repeated here: its site moves several times.
  for (std::size_t i = 0; i < ids.size(); ++i) impl_->require_site(ids[i], i);
  api::validate(to, impl_->options);
  const bool is_rebuilt = is_build_faster(ids.size(), builds_of_move, num_sites());
  impl_->change([&](auto& e) {
    is_rebuilt ? e.move(ids, to, [&] { impl_->rebuild(execution); }) : e.move(ids, to, execution);
  });
}

void DynamicTriangulation::move_all(std::span<const Point> to, const Execution& execution) {
  const system::Call call(execution);
  if (to.size() != num_sites()) {
    throw InvalidInput("there are " + std::to_string(to.size()) + " points for " +
                           std::to_string(num_sites()) + " sites to move",
                       std::min(num_sites(), to.size()));
  }
  api::validate(to, impl_->options);
  impl_->change_all([&](auto& e) {
    const std::vector<Index> sites = dynamic::live_sites(e.places());
    const bool is_mended =
        e.move_all(sites, to, execution.threads, [&] { impl_->rebuild(execution); });
    impl_->has_old_index = is_mended;
  });
}

Model DynamicTriangulation::model() const noexcept { return impl_->options.model; }
const Sphere& DynamicTriangulation::sphere() const noexcept { return impl_->options.sphere; }

int DynamicTriangulation::dimension() const {
  const system::ArithmeticScope arithmetic;
  return impl_->current().has_hull() ? 2 : impl_->flat_snapshot().triangulation.dimension();
}

std::size_t DynamicTriangulation::num_sites() const noexcept {
  return impl_->read_places([](const auto& places) { return places.num_sites(); });
}

std::size_t DynamicTriangulation::num_vertices() const {
  const system::ArithmeticScope arithmetic;
  if (!impl_->current().has_hull()) return impl_->flat_snapshot().triangulation.num_vertices();
  return impl_->visit([](const auto& e) { return e.hull()->num_vertices(); });
}

std::size_t DynamicTriangulation::num_faces() const {
  const system::ArithmeticScope arithmetic;
  return impl_->current().visit(
      [](const auto& e) -> std::size_t { return e.hull() ? e.hull()->mesh().num_faces() : 0; });
}

std::vector<Index> DynamicTriangulation::ids() const {
  return impl_->read_places([](const auto& places) { return dynamic::live_sites(places); });
}

bool DynamicTriangulation::contains(Index id) const noexcept { return impl_->is_alive(id); }

Point DynamicTriangulation::site(Index id) const {
  impl_->require_site(id, 0);
  return impl_->read_places([id](const auto& places) { return places.point(id); });
}

Index DynamicTriangulation::representative(Index id) const {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(id, 0);
  const dynamic::Places& places = impl_->current().places();
  return places.names()[places.place_of(id)];
}

bool DynamicTriangulation::is_vertex(Index id) const {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(id, 0);
  if (!impl_->current().has_hull()) {
    const auto ring = impl_->flat_ring();
    return std::ranges::find(ring, representative(id)) != ring.end();
  }
  return impl_->visit([id](const auto& e) { return e.hull()->is_vertex(e.places().place_of(id)); });
}

std::vector<Index> DynamicTriangulation::neighbors(Index id) const {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(id, 0);
  if (!impl_->current().has_hull()) {
    const auto ring = impl_->flat_ring();
    // Neighbors on a great circle are the vertices before and after; with two vertices these are
    // one.
    const auto at = std::ranges::find(ring, representative(id));
    if (at == ring.end() || ring.size() == 1) return {};
    const auto i = static_cast<std::size_t>(at - ring.begin());
    const Index next = ring[(i + 1) % ring.size()];
    if (ring.size() == 2) return {next};
    const Index before = ring[(i + ring.size() - 1) % ring.size()];
    return {std::min(next, before), std::max(next, before)};
  }
  return impl_->visit([id](const auto& e) {
    const Index place = e.places().place_of(id);
    if (!e.hull()->is_vertex(place)) return std::vector<Index>();
    return query::Engine(e.graph()).neighbors(place);
  });
}

Triple DynamicTriangulation::face(Index face) const {
  const system::ArithmeticScope arithmetic;
  return impl_->current().visit([face](const auto& e) {
    if (!e.hull() || face >= e.hull()->mesh().num_slots() || !e.hull()->mesh().is_alive(face)) {
      throw InvalidInput("face " + std::to_string(face) + " does not exist", 0);
    }
    // The mesh has numbers of places; outside, the lowest id of a place names the vertex.
    Triple corners = e.hull()->mesh()[face].vertex;
    for (Index& v : corners) v = e.places().names()[v];
    return corners;
  });
}

Snapshot DynamicTriangulation::snapshot() const {
  const system::ArithmeticScope arithmetic;
  if (!impl_->current().has_hull()) return impl_->flat_snapshot();
  return impl_->visit([this](const auto& e) {
    Snapshot now;
    now.ids = dynamic::live_sites(e.places());
    Sites sites = impl_->sites_of(now.ids);
    auto arrays = dynamic::make_arrays(e.places(), now.ids, sites.points(), e.hull()->mesh(),
                                       e.hull()->kinds(), e.hull()->hidden(), impl_->options.model,
                                       impl_->options.sphere.center);
    now.triangulation =
        api::make_triangulation(std::move(sites), std::move(arrays), impl_->options, {});
    return now;
  });
}

}  // namespace rondel
