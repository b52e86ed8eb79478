// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The members of Triangulation: each returns a part of the shared state, which never changes. One
// that was moved from has no state, and answers as the triangulation of no sites.

#include "rondel/triangulation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "api/triangulation_impl.h"
#include "system/message_text.h"

namespace rondel {
namespace {

const Triangulation::Impl without_sites;

}  // namespace

std::string_view name_of(Model model) noexcept {
  return system::name_in({"projected", "weighted"}, model);
}

const char* name_of(Builder builder) noexcept {
  constexpr std::array names = {"given", "ring", "incremental", "sphere", "blocks"};
  return names[static_cast<std::size_t>(builder)];
}

Triangulation api::make_triangulation(Sites sites, TriangulationArrays arrays,
                                      const Options& options, const BuildReport& report) {
  return Triangulation(std::make_shared<const Triangulation::Impl>(
      std::move(sites), std::move(arrays), options, report));
}

// Two threads may both run the proof; the result is the same, and the proof is dropped once.
void api::require_delaunay(const Triangulation& triangulation, const Execution& execution) {
  const Triangulation::Impl& impl = Triangulation::Impl::of(triangulation);
  const auto proof = impl.proof.load(std::memory_order_relaxed);
  if (proof == nullptr) return;
  proof(triangulation, execution);
  impl.proof.store(nullptr, std::memory_order_relaxed);
}

void api::require_unchanged_faces(const Triangulation& triangulation, const Execution& execution) {
  if (Triangulation::Impl::of(triangulation).has_constraints) {
    require_delaunay(triangulation, execution);
  }
}

Triangulation::Triangulation(std::shared_ptr<const Impl> impl) noexcept : impl_(std::move(impl)) {}

const Triangulation::Impl& Triangulation::impl() const noexcept {
  return impl_ ? *impl_ : without_sites;
}

int Triangulation::dimension() const noexcept { return impl().arrays.dimension; }
Model Triangulation::model() const noexcept { return impl().options.model; }
const Sphere& Triangulation::sphere() const noexcept { return impl().options.sphere; }

const Sites& Triangulation::sites() const noexcept { return impl().sites; }
std::size_t Triangulation::num_sites() const noexcept { return impl().arrays.num_sites; }
std::size_t Triangulation::num_vertices() const noexcept {
  const TriangulationArrays& arrays = impl().arrays;
  return arrays.num_sites - arrays.duplicates.size() - arrays.hidden.size();
}
std::size_t Triangulation::num_faces() const noexcept { return impl().arrays.faces.size(); }
std::size_t Triangulation::num_ghost_faces() const noexcept {
  return impl().arrays.ghost_faces.size();
}

std::span<const Triple> Triangulation::faces() const noexcept { return impl().arrays.faces; }
std::span<const Triple> Triangulation::neighbors() const noexcept {
  return impl().arrays.neighbors;
}
std::span<const Index> Triangulation::ghost_faces() const noexcept {
  return impl().arrays.ghost_faces;
}
bool Triangulation::is_ghost(Index face) const noexcept {
  return std::ranges::binary_search(impl().arrays.ghost_faces, face);
}

std::span<const Index> Triangulation::ring() const noexcept { return impl().arrays.ring; }
std::span<const Duplicate> Triangulation::duplicates() const noexcept {
  return impl().arrays.duplicates;
}
std::span<const Hidden> Triangulation::hidden() const noexcept { return impl().arrays.hidden; }

const BuildReport& Triangulation::report() const noexcept { return impl().report; }

}  // namespace rondel
