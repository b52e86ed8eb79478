// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// DynamicConstrainedTriangulation: every function validates its arguments, then changes or asks the
// editor and its hull.

#include "rondel/dynamic_constrained.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "api/validation.h"
#include "constrained/constrained_result.h"
#include "constrained/constrained_snapshot.h"
#include "constrained/constraints.h"
#include "constrained/dynamic_constrained_impl.h"
#include "dynamic/snapshot.h"
#include "rondel/error.h"
#include "system/job.h"
#include "system/on_failure.h"

namespace rondel {

void DynamicConstrainedTriangulation::Impl::require_site(Index site, std::size_t position) const {
  if (read_places([site](const auto& all) { return all.is_alive(site); })) return;
  throw InvalidInput("site " + std::to_string(site) + " does not exist", position);
}

void DynamicConstrainedTriangulation::Impl::require_constraint(Index constraint) const {
  if (constraints.contains(constraint)) return;
  throw InvalidInput("constraint " + std::to_string(constraint) + " does not exist", 0);
}

void DynamicConstrainedTriangulation::Impl::require_valid(const Point& site) const {
  const Options options = {Model::projected, sphere};
  api::validate_some({&site, 1}, options, 0);
  api::validate(options, places().num_sites() + 1);
}

CrossingConstraints DynamicConstrainedTriangulation::Impl::crossing(Index one, const Ends& ends,
                                                                    Index other) const {
  const auto points = [this](const Ends& e) {
    return std::array{places().point(e[0]), places().point(e[1])};
  };
  const LonLat place =
      constrained::place_of_crossing(points(constraints.ends(other)), points(ends), sphere);
  return {std::min(one, other), std::max(one, other), place};
}

void DynamicConstrainedTriangulation::Impl::assign(const ConstrainedTriangulation& built,
                                                   std::span<const Index> site_ids,
                                                   std::span<const Index> constraint_ids,
                                                   const Execution& execution) {
  // The build numbers places itself; ids get the places of the sites that they name.
  dynamic::Build build = dynamic::make_build(built.triangulation, execution.threads);
  std::vector<Index> place_of_id(places().site_limit(), no_index);
  for (std::size_t i = 0; i < site_ids.size(); ++i) {
    place_of_id[site_ids[i]] = build.place_of_site[i];
  }
  for (Index& representative : build.representatives) representative = site_ids[representative];
  constrained::ConstrainedHull::Sources sources;
  for (std::size_t e = 0; e < built.edges.size(); ++e) {
    const auto [low, high] = std::minmax(
        {build.place_of_site[built.edges[e][0]], build.place_of_site[built.edges[e][1]]});
    std::vector<Index>& ids = sources[{low, high}];
    for (const Index i : built.sources[e]) ids.push_back(constraint_ids[i]);
  }
  editor.assign(place_of_id, build.representatives);
  if (built.triangulation.dimension() == 2) {
    editor.adopt(std::move(build.mesh), {});
    editor.hull()->adopt_constraints(built.sides, std::move(sources));
  } else {
    editor.adopt_flat();
  }
}

ConstrainedSnapshot DynamicConstrainedTriangulation::Impl::build(const Execution& execution) const {
  ConstrainedSnapshot now;
  now.site_ids = dynamic::live_sites(places());
  now.constraint_ids = constraints.ids();
  std::vector<Point> sites;
  sites.reserve(now.site_ids.size());
  for (const Index id : now.site_ids) sites.push_back(places().point(id));
  const auto position = [&](Index id) {
    const auto found = std::ranges::lower_bound(now.site_ids, id);
    return static_cast<Index>(found - now.site_ids.begin());
  };
  std::vector<Ends> ends;
  ends.reserve(now.constraint_ids.size());
  for (const Index id : now.constraint_ids) {
    const auto [a, b] = constraints.ends(id);
    ends.push_back({position(a), position(b)});
  }
  now.result = constrained_delaunay(std::move(sites), ends, {.sphere = sphere}, execution);
  return now;
}

DynamicConstrainedTriangulation::Impl& DynamicConstrainedTriangulation::Impl::current() {
  if (!is_in_pieces) return *this;
  const std::lock_guard guard(mutex);
  if (is_in_pieces) {
    // Under a lock, which no thread may hold while it waits for others.
    const Execution alone = {.threads = 1};
    const ConstrainedSnapshot now = build(alone);
    assign(now.result, now.site_ids, now.constraint_ids, alone);
    is_in_pieces = false;
  }
  return *this;
}

void DynamicConstrainedTriangulation::Impl::constrain_hull(Index site, bool was_there) {
  if (!has_hull() || editor.hull()->has_constraints()) return;
  system::OnFailure undo([&] { editor.roll_back(site, was_there); });
  for (const Index id : constraints.ids()) {
    const auto [a, b] = constraints.ends(id);
    editor.hull()->insert_constraint(place_of(a), place_of(b), id);
  }
  editor.hull()->adopt_constraints();
  undo.succeed();
}

std::vector<Index> DynamicConstrainedTriangulation::Impl::flat_ring() const {
  const ConstrainedSnapshot now = build({.threads = 1});
  std::vector<Index> ring;
  for (const Index i : now.result.triangulation.ring()) ring.push_back(now.site_ids[i]);
  return ring;
}

DynamicConstrainedTriangulation::DynamicConstrainedTriangulation(const Sphere& sphere) {
  const system::ArithmeticScope arithmetic;
  api::validate({Model::projected, sphere}, 0);
  impl_ = std::make_unique<Impl>(sphere);
}

DynamicConstrainedTriangulation::DynamicConstrainedTriangulation(
    std::span<const Point> sites, std::span<const std::array<Index, 2>> constraints,
    const Sphere& sphere, const Execution& execution) {
  const system::Call call(execution);
  const ConstrainedTriangulation built =
      constrained_delaunay(Sites::view(sites), constraints, {.sphere = sphere}, execution);
  impl_ = std::make_unique<Impl>(sphere);
  impl_->editor.assign_points(sites);
  impl_->constraints.assign(constraints);
  std::vector<Index> ids(std::max(sites.size(), constraints.size()));
  std::iota(ids.begin(), ids.end(), Index{0});
  impl_->assign(built, std::span(ids).first(sites.size()), std::span(ids).first(constraints.size()),
                execution);
}

DynamicConstrainedTriangulation::~DynamicConstrainedTriangulation() = default;
DynamicConstrainedTriangulation::DynamicConstrainedTriangulation(
    DynamicConstrainedTriangulation&&) noexcept = default;
DynamicConstrainedTriangulation& DynamicConstrainedTriangulation::operator=(
    DynamicConstrainedTriangulation&&) noexcept = default;

Index DynamicConstrainedTriangulation::insert(const Point& site) {
  const system::ArithmeticScope arithmetic;
  impl_->require_valid(site);
  impl_->current();
  return impl_->change([&](Impl::Editor& editor) {
    const Index id = editor.insert(site, no_index);
    impl_->constrain_hull(id, false);
    return id;
  });
}

Index DynamicConstrainedTriangulation::insert(const Point& site, Index hint) {
  const system::ArithmeticScope arithmetic;
  impl_->require_valid(site);
  impl_->require_site(hint);
  impl_->current();
  return impl_->change([&](Impl::Editor& editor) {
    const Index id = editor.insert(site, hint);
    impl_->constrain_hull(id, false);
    return id;
  });
}

void DynamicConstrainedTriangulation::remove(Index site) {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(site);
  const constrained::DynamicConstraints& constraints = impl_->constraints;
  if (constraints.num_ends_at(site) > 0) {
    throw InvalidInput("site " + std::to_string(site) + " is an end of constraint " +
                           std::to_string(constraints.first_at(site)),
                       0);
  }
  impl_->current();
  const bool leaves_place = impl_->places().next_representative(site) == no_index;
  if (impl_->has_hull() && leaves_place) {
    const auto crossed = impl_->editor.hull()->crossing_at(impl_->place_of(site));
    if (crossed) {
      throw impl_->crossing((*crossed)[1], constraints.ends((*crossed)[1]), (*crossed)[0]);
    }
  }
  impl_->change([&](Impl::Editor& editor) {
    editor.remove(site);
    impl_->constrain_hull(site, true);
  });
}

Index DynamicConstrainedTriangulation::insert_constraint(Index first, Index second) {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(first, 0);
  impl_->require_site(second, 1);
  constrained::DynamicConstraints& constraints = impl_->constraints;
  const Impl::Ends ends = {first, second};
  constrained::require_arc(impl_->places().points(), ends, impl_->sphere, "the constraint", 0);
  if (constraints.next_id() == no_index) throw InvalidInput("there are too many constraints");
  impl_->current();
  const Index a = impl_->place_of(first);
  const Index b = impl_->place_of(second);
  if (impl_->has_hull()) {
    constrained::ConstrainedHull& hull = *impl_->editor.hull();
    if (const auto crossed = hull.find_crossed(a, b)) {
      const auto [low, high] = std::minmax((*crossed)[0], (*crossed)[1]);
      throw impl_->crossing(constraints.next_id(), ends, hull.sources().at({low, high}).front());
    }
  }
  constraints.make_room(ends);
  const Index id = constraints.insert(ends);
  impl_->change([&](Impl::Editor& editor) {
    system::OnFailure undo([&] { constraints.remove(id); });
    if (editor.hull()) editor.hull()->insert_constraint(a, b, id);
    undo.succeed();
  });
  return id;
}

void DynamicConstrainedTriangulation::remove_constraint(Index constraint) {
  const system::ArithmeticScope arithmetic;
  impl_->require_constraint(constraint);
  impl_->current();
  const auto [a, b] = impl_->constraints.ends(constraint);
  impl_->change([&, first = a, second = b](Impl::Editor& editor) {
    if (!editor.hull()) return;
    editor.hull()->remove_constraint(impl_->place_of(first), impl_->place_of(second), constraint);
  });
  impl_->constraints.remove(constraint);
}

const Sphere& DynamicConstrainedTriangulation::sphere() const noexcept { return impl_->sphere; }

int DynamicConstrainedTriangulation::dimension() const {
  const system::ArithmeticScope arithmetic;
  if (impl_->current().has_hull()) return 2;
  return impl_->build({.threads = 1}).result.triangulation.dimension();
}

std::size_t DynamicConstrainedTriangulation::num_sites() const noexcept {
  return impl_->read_places([](const auto& places) { return places.num_sites(); });
}

std::size_t DynamicConstrainedTriangulation::num_vertices() const {
  const system::ArithmeticScope arithmetic;
  return impl_->current().places().num_places();
}

std::size_t DynamicConstrainedTriangulation::num_faces() const {
  const system::ArithmeticScope arithmetic;
  return impl_->current().has_hull() ? impl_->editor.hull()->mesh().num_faces() : 0;
}

std::size_t DynamicConstrainedTriangulation::num_constraints() const noexcept {
  return impl_->constraints.size();
}

std::vector<Index> DynamicConstrainedTriangulation::site_ids() const {
  return impl_->read_places([](const auto& places) { return dynamic::live_sites(places); });
}

std::vector<Index> DynamicConstrainedTriangulation::constraint_ids() const {
  return impl_->constraints.ids();
}

bool DynamicConstrainedTriangulation::contains(Index site) const noexcept {
  return impl_->read_places([site](const auto& places) { return places.is_alive(site); });
}

bool DynamicConstrainedTriangulation::contains_constraint(Index constraint) const noexcept {
  return impl_->constraints.contains(constraint);
}

Point DynamicConstrainedTriangulation::site(Index site) const {
  impl_->require_site(site);
  return impl_->read_places([site](const auto& places) { return places.point(site); });
}

std::array<Index, 2> DynamicConstrainedTriangulation::constraint(Index constraint) const {
  impl_->require_constraint(constraint);
  return impl_->constraints.ends(constraint);
}

Index DynamicConstrainedTriangulation::representative(Index site) const {
  const system::ArithmeticScope arithmetic;
  impl_->require_site(site);
  const dynamic::Places& places = impl_->current().places();
  return places.names()[places.place_of(site)];
}

std::vector<Index> DynamicConstrainedTriangulation::neighbors(Index site) const {
  const system::ArithmeticScope arithmetic;
  const Index vertex = representative(site);
  std::vector<Index> neighbors;
  if (!impl_->has_hull()) {
    const std::vector<Index> ring = impl_->flat_ring();
    const auto i = static_cast<std::size_t>(std::ranges::find(ring, vertex) - ring.begin());
    for (const std::size_t step : {std::size_t{1}, ring.size() - 1}) {
      neighbors.push_back(ring[(i + step) % ring.size()]);
    }
    std::ranges::sort(neighbors);
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    std::erase(neighbors, vertex);
    return neighbors;
  }
  const constrained::ConstrainedHull& hull = *impl_->editor.hull();
  neighbors = hull.neighbors(impl_->place_of(vertex));
  for (Index& v : neighbors) v = impl_->places().names()[v];
  if (!hull.is_on_border(impl_->place_of(vertex))) {
    std::rotate(neighbors.begin(), std::ranges::min_element(neighbors), neighbors.end());
  }
  return neighbors;
}

std::vector<Index> DynamicConstrainedTriangulation::chain(Index constraint) const {
  const system::ArithmeticScope arithmetic;
  impl_->require_constraint(constraint);
  const auto [a, b] = impl_->constraints.ends(constraint);
  if (!impl_->current().has_hull()) {
    return constrained::flat_chain(impl_->build({.threads = 1}), constraint, representative(a),
                                   representative(b));
  }
  std::vector<Index> vertices = impl_->editor.hull()->chain(impl_->place_of(a), impl_->place_of(b));
  for (Index& v : vertices) v = impl_->places().names()[v];
  return vertices;
}

ConstrainedSnapshot DynamicConstrainedTriangulation::snapshot() const {
  const system::ArithmeticScope arithmetic;
  impl_->current();
  if (!impl_->has_hull()) return impl_->build({.threads = 1});
  return constrained::make_snapshot(impl_->places(), *impl_->editor.hull(), impl_->constraints,
                                    impl_->sphere);
}

}  // namespace rondel
