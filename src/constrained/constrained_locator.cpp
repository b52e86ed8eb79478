// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0

// ConstrainedLocator: the vertices and faces are prepared as for a Locator (query::Built); the walk
// is another one (face_finder.h).

#include "rondel/constrained_locator.h"

#include <cstdint>

#include "api/validation.h"
#include "constrained/face_finder.h"
#include "query/batch.h"
#include "query/built.h"
#include "system/job.h"

namespace rondel {

struct ConstrainedLocator::Impl {
  explicit Impl(const ConstrainedTriangulation& result)
      : sphere(result.triangulation.sphere()),
        sides(result.sides),
        built(result.triangulation, {}),
        finder(built.graph(), sides, sphere) {}

  [[nodiscard]] bool is_empty() const { return built.num_vertices() == 0; }

  Sphere sphere;
  std::vector<std::uint8_t> sides;
  query::Built built;
  constrained::ConstrainedFaceFinder finder;
};

ConstrainedLocator::ConstrainedLocator(const ConstrainedTriangulation& result) {
  const system::ArithmeticScope arithmetic;
  constrained::require_sides(result.sides.size(), result.triangulation.num_faces());
  impl_ = std::make_unique<const Impl>(result);
}

ConstrainedLocator::~ConstrainedLocator() = default;
ConstrainedLocator::ConstrainedLocator(ConstrainedLocator&&) noexcept = default;
ConstrainedLocator& ConstrainedLocator::operator=(ConstrainedLocator&&) noexcept = default;

Location ConstrainedLocator::locate(const Point& query) const {
  const system::ArithmeticScope arithmetic;
  api::validate_queries({&query, 1}, impl_->sphere.center);
  if (impl_->is_empty()) return {};
  query::Cursor cursor;
  cursor.vertex = impl_->built.near(query);
  return impl_->finder.locate(query, cursor);
}

std::vector<Location> ConstrainedLocator::locate(std::span<const Point> queries,
                                                 const Execution& execution) const {
  const system::Call call(execution);
  api::validate_queries(queries, impl_->sphere.center);
  std::vector<Location> found(queries.size());
  if (impl_->is_empty()) return found;
  query::for_each_range(
      queries, Model::projected, impl_->sphere.center, execution.threads,
      [this](const Point& p) { return impl_->built.near(p); },
      [&](std::span<const Index> range, query::Cursor& cursor) {
        query::for_each_query(range, queries, cursor, [&](Index i, query::Cursor& at) {
          found[i] = impl_->finder.locate(queries[i], at);
        });
      });
  return found;
}

}  // namespace rondel
