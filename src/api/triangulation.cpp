// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

#include "rondel/triangulation.h"

#include <algorithm>
#include <utility>

#include "api/triangulation_impl.h"

namespace rondel {
namespace {

const std::shared_ptr<const Triangulation::Impl>& without_sites() {
  static const auto impl = std::make_shared<const Triangulation::Impl>();
  return impl;
}

}  // namespace

Triangulation api::make_triangulation(Sites sites, TriangulationArrays arrays,
                                      const Options& options, const BuildReport& report) {
  return Triangulation(std::make_shared<const Triangulation::Impl>(
      Triangulation::Impl{std::move(sites), std::move(arrays), options, report}));
}

Triangulation::Triangulation() : impl_(without_sites()) {}
Triangulation::Triangulation(std::shared_ptr<const Impl> impl) noexcept : impl_(std::move(impl)) {}

int Triangulation::dimension() const noexcept { return impl_->arrays.dimension; }
Model Triangulation::model() const noexcept { return impl_->options.model; }
const Sphere& Triangulation::sphere() const noexcept { return impl_->options.sphere; }

const Sites& Triangulation::sites() const noexcept { return impl_->sites; }
std::size_t Triangulation::num_sites() const noexcept { return impl_->arrays.num_sites; }
std::size_t Triangulation::num_vertices() const noexcept {
  const TriangulationArrays& arrays = impl_->arrays;
  return arrays.num_sites - arrays.duplicates.size() - arrays.hidden.size();
}
std::size_t Triangulation::num_faces() const noexcept { return impl_->arrays.faces.size(); }
std::size_t Triangulation::num_ghost_faces() const noexcept {
  return impl_->arrays.ghost_faces.size();
}

std::span<const Triple> Triangulation::faces() const noexcept { return impl_->arrays.faces; }
std::span<const Triple> Triangulation::neighbors() const noexcept {
  return impl_->arrays.neighbors;
}
std::span<const Index> Triangulation::ghost_faces() const noexcept {
  return impl_->arrays.ghost_faces;
}
bool Triangulation::is_ghost(Index face) const noexcept {
  return std::ranges::binary_search(impl_->arrays.ghost_faces, face);
}

std::span<const Index> Triangulation::ring() const noexcept { return impl_->arrays.ring; }
std::span<const Duplicate> Triangulation::duplicates() const noexcept {
  return impl_->arrays.duplicates;
}
std::span<const Hidden> Triangulation::hidden() const noexcept { return impl_->arrays.hidden; }

const BuildReport& Triangulation::report() const noexcept { return impl_->report; }

}  // namespace rondel
