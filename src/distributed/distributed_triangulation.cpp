// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// The public functions of rondel/distributed.h: they show a rank its part of the triangulation,
// with sites and faces counted through all ranks, and start the builds.

#include <algorithm>
#include <utility>

#include "distributed/bsp_session.h"
#include "distributed/rank_build.h"
#include "distributed/rank_duals.h"
#include "distributed/rank_result.h"
#include "system/job.h"

namespace rondel {
namespace {

// Collects rows and shows them to the visitor, some at a time.
class RowVisits {
 public:
  explicit RowVisits(const std::function<void(std::span<const GlobalTriple>)>& visit)
      : visit_(visit) {
    rows_.reserve(max_rows);
  }

  void add(const GlobalTriple& row) {
    rows_.push_back(row);
    if (rows_.size() == max_rows) flush();
  }
  // Shows the collected rows.
  void flush() {
    if (!rows_.empty()) visit_(rows_);
    rows_.clear();
  }

 private:
  static constexpr std::size_t max_rows = std::size_t{1} << 13;

  const std::function<void(std::span<const GlobalTriple>)>& visit_;
  std::vector<GlobalTriple> rows_;
};

}  // namespace

DistributedTriangulation::DistributedTriangulation(std::shared_ptr<const Impl> impl) noexcept
    : impl_(std::move(impl)) {}

int DistributedTriangulation::dimension() const noexcept { return impl_->dimension; }
std::uint64_t DistributedTriangulation::num_sites() const noexcept { return impl_->num_sites; }
std::uint64_t DistributedTriangulation::num_vertices() const noexcept {
  return impl_->num_vertices;
}
std::uint64_t DistributedTriangulation::num_faces() const noexcept { return impl_->num_faces; }
std::uint64_t DistributedTriangulation::num_ghost_faces() const noexcept {
  return impl_->num_ghost_faces;
}
std::uint64_t DistributedTriangulation::num_duplicates() const noexcept {
  return impl_->num_duplicates;
}
std::uint64_t DistributedTriangulation::num_hidden() const noexcept { return impl_->num_hidden; }
std::uint64_t DistributedTriangulation::num_open_sites() const noexcept {
  return impl_->num_open_sites;
}
std::uint64_t DistributedTriangulation::first_face() const noexcept { return impl_->first_face; }
std::uint64_t DistributedTriangulation::num_own_faces() const noexcept {
  return impl_->num_own_faces;
}
std::span<const std::uint64_t> DistributedTriangulation::ghost_faces() const noexcept {
  return impl_->ghost_faces;
}
std::span<const std::uint64_t> DistributedTriangulation::owned_sites() const noexcept {
  return impl_->own.sites;
}
std::span<const std::uint64_t> DistributedTriangulation::ring() const noexcept {
  return impl_->ring;
}
std::span<const GlobalDuplicate> DistributedTriangulation::duplicates() const noexcept {
  return impl_->duplicates;
}
std::span<const std::uint64_t> DistributedTriangulation::hidden() const noexcept {
  return impl_->hidden;
}

void DistributedTriangulation::visit_faces(
    const std::function<void(std::span<const GlobalTriple>)>& visit) const {
  RowVisits rows(visit);
  for (std::size_t b = 0; b < impl_->faces.size(); ++b) {
    const auto names = std::span(impl_->own.sites).subspan(impl_->own.first_site[b]);
    const auto name = [&](const distributed::BucketCorner& corner) {
      return corner.is_own ? names[corner.index] : impl_->part.site_indices[corner.index];
    };
    impl_->faces[b].for_each_face(impl_->own.buckets[b].faces, [&](const auto& v) {
      rows.add({name(v[0]), name(v[1]), name(v[2])});
    });
  }
  rows.flush();
}

void DistributedTriangulation::visit_neighbors(
    const std::function<void(std::span<const GlobalTriple>)>& visit) const {
  RowVisits rows(visit);
  for (std::size_t b = 0; b < impl_->faces.size(); ++b) {
    const distributed::JoinedNumbers& numbers = *impl_->numbers;
    impl_->faces[b].for_each_neighbors(impl_->own.buckets[b].neighbors, [&](const auto& n) {
      rows.add({numbers[n[0]], numbers[n[1]], numbers[n[2]]});
    });
  }
  rows.flush();
}

void DistributedTriangulation::visit_circumcenters(
    const std::function<void(std::span<const Point>)>& visit, const Execution& execution) const {
  const system::Call call(execution);
  distributed::visit_circumcenters(*impl_, execution, visit);
}

std::vector<double> areas(Communicator& ranks, const DistributedTriangulation& triangulation,
                          const Execution& execution) {
  const system::Call call(execution);
  distributed::BspSession session(ranks);
  return session.run([&] {
    return distributed::areas_on_ranks(session, DistributedTriangulation::Impl::of(triangulation),
                                       execution);
  });
}

DistributedTriangulation delaunay(Communicator& ranks, std::span<const Point> mine,
                                  const DistributedOptions& distributed, const Options& options,
                                  const Execution& execution) {
  const distributed::RankLimits limits = {
      std::clamp<std::uint64_t>(distributed.max_bucket_sites, 1, max_sites),
      std::clamp<std::uint64_t>(distributed.max_scattered_sites, 1, max_sites), 0,
      distributed.keep_points};
  return DistributedTriangulation(
      distributed::build_on_ranks(ranks, mine, limits, {options, execution}));
}

}  // namespace rondel
